// The stage simulate: runs the models of motion on a case with a fit of the drag, and writes
// trajectories and the record of failed models into a run's folder. Lengths, masses and times are
// in the units of the case. The commands `run`, `simulate` and `sweep`, and python/, call it. A
// change must keep that trajectories are written after the copies of the inputs and
// uncertainty.json, because `run` takes a trajectory as the sign that those are written. Functions
// that make or write outputs throw Error(kWrongUsage) if the variable SOURCE_DATE_EPOCH is no time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/results/failed_models.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::pipeline {

/// A fit file.
struct FitFile {
  std::filesystem::path path;  ///< path of the file, for messages
  std::string text;            ///< content of the file
};

/// The case file, and after it the files of sampled external forces that its motion reads.
std::vector<std::filesystem::path> files_of_motion(const case_file::Case& c);

/// Names of the models to run, at least one: `asked` or, if this is empty, those that the case
/// names or, if the case names none, reduced_model::default_models(). The names are not checked.
std::vector<std::string> models_to_run(const case_file::Case& c,
                                       std::vector<std::string> asked = {});

/// The results of a simulation, before they are written.
struct Simulated {
  std::string fit_text;   ///< text of the fit file
  CsvComments made_from;  ///< comments that identify case, fit and version (run_inputs.hpp)
  std::vector<reduced_model::Trajectory> trajectories;  ///< of models that did not fail, >= 1
  std::vector<results::FailedModel> failed;  ///< models without a trajectory; may be empty
  /// Effect of the fit's errors on the motion without inertia (reduced_model/fit_uncertainty.hpp),
  /// as JSON; empty if the fit is exact or the effect cannot be computed.
  std::string uncertainty;
};

/// Runs the models (see models_to_run), in this order, and writes no file. `outside` is the drag
/// outside the fit's interval. A model that fails, because it leaves that interval or does not
/// converge, does not stop the others. Throws Error(kBadInput), which names the case or the fit, if
/// the case has no [motion], if the text of the fit is not one, if its resistance is not positive,
/// if it cannot be scaled to the case (case_file::fit_for), if a model is unknown or if a parameter
/// of a model is wrong. Throws the error of the first model if all models fail, and
/// Error(kInterrupted) if `stop` requests a stop.
Simulated simulate_case(const case_file::Case& c, const FitFile& fit_file,
                        const std::vector<std::string>& models,
                        const lubrication::OutsideInterval& outside, const StopToken& stop);

/// Writes the trajectories, the record of failed models, uncertainty.json and the copies of case
/// and fit. An earlier trajectory of a model that failed is removed, because it was made from other
/// inputs. Throws Error(kBadInput) if a file cannot be written.
void write_simulated(const results::RunFolder& run, const case_file::Case& c,
                     const Simulated& simulated, const results::Provenance& provenance);

/// The fit file fit.json of the run's folder for the exact drag near a plane, with radius and
/// viscosity of the case; it is not written here. If the file in the folder differs only in the
/// record of how it was made, its text is returned unchanged, so that the file keeps its time of
/// making.
FitFile exact_fit_file(const case_file::Case& c, const results::RunFolder& run,
                       const results::Provenance& provenance);

/// The inputs of a simulation besides the case.
struct SimulateRequest {
  /// Path of the fit. If it is empty, the fit is the one that the case names, or the exact drag if
  /// the case asks for it, or fit.json in `folder`.
  std::string fit;
  std::filesystem::path folder;          ///< the run's folder
  std::vector<std::string> models;       ///< names of models; empty: see models_to_run
  lubrication::OutsideInterval outside;  ///< drag outside the interval of the fit
  StopToken stop{};                      ///< a stop throws Error(kInterrupted)
  std::string remedy{};  ///< end of the message if there is no fit: what the user can do
};

/// Runs the models and writes their trajectories and the copies of case and fit into the run's
/// folder. Before anything is written, throws the errors of simulate_case(), Error(kWrongUsage) if
/// there is no fit, and Error(kBadInput) if a file of the user would be replaced. If some models
/// failed, the results of the others are written; then the error that results::error_of() makes is
/// thrown.
void simulate_stage(const case_file::Case& c, const SimulateRequest& request);

}  // namespace viscontact::pipeline
