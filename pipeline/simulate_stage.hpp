// The models of motion run on a case with a fit, and what of it goes into a run's folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/results/failed_models.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact {

/// Where the fit says nothing.
struct OutsideFit {
  BelowInterval below = BelowInterval::kError;
  AboveInterval above = AboveInterval::kError;
};

/// A fit file: its name for messages, and its text.
struct FitFile {
  std::filesystem::path path;
  std::string text;
};

/// The models of a run: those asked for, else those that the case names, else all that run by default.
std::vector<std::string> models_to_run(const Case& c, std::vector<std::string> asked = {});

struct Simulated {
  std::string fit_text;   ///< of the file
  CsvComments made_from;  ///< what identifies case, fit and version in the files that are written
  std::vector<Trajectory> trajectories;
  std::vector<FailedModel> failed;  ///< models without a trajectory
  std::string
      uncertainty;  ///< what the fit's errors do to the motion without inertia (JSON); empty if there is nothing to say
};

/// Runs the models; writes nothing. A model that fails (because it leaves the fit's interval, or does
/// not converge) does not stop the others. Throws Error(kBadInput) that names the case or the fit if
/// the fit is of another viscosity or radius than the case, or if a parameter of a model is wrong;
/// and the first model's Error if no model can be computed.
Simulated simulate_case(const Case& c, const FitFile& fit_file,
                        const std::vector<std::string>& models, const OutsideFit& outside);

/// Writes the trajectories, the models that failed, what the fit's errors do, and copies of case and
/// fit. An earlier trajectory of a model that failed is removed: it is of other inputs.
void write_simulated(const RunFolder& run, const Case& c, const Simulated& simulated,
                     const Provenance& provenance);

/// True if the folder has the model's trajectory, made from this case and this fit (its text), by the present models.
bool is_simulated(const RunFolder& run, const std::string& model, const Case& c,
                  const std::string& fit_text, const OutsideFit& outside);

/// The models of these that failed when they were run with this case and this fit (its text), as the
/// folder records it.
std::vector<FailedModel> recorded_failures(const RunFolder& run,
                                           const std::vector<std::string>& models, const Case& c,
                                           const std::string& fit_text, const OutsideFit& outside);

/// What a simulation is run with, apart from the case.
struct SimulateRequest {
  std::string
      fit;  ///< fit file; empty: that of the case, the exact drag of the case, or DIR/fit.json
  std::filesystem::path folder;     ///< DIR, a run's folder
  std::vector<std::string> models;  ///< names; none: those that the case names, or all
  OutsideFit outside;
};

/// Runs models into the run folder's trajectories; copies case and fit beside them. Throws as
/// simulate_case, or Error(kWrongUsage) if there is no fit at all, having written nothing; and
/// error_of() the models that failed, having written what the others computed.
void simulate_stage(const Case& c, const SimulateRequest& request);

}  // namespace viscontact
