// Declares the stage simulate, which runs the models of motion on a case with a fit of the drag,
// and writes trajectories (gap [L], velocity [L/T] and forces [M L/T^2] over the time [T]) and the
// record of failed models into a run's folder. Lengths, masses and times are in the units of the
// case. The commands `run`, `simulate` and `sweep`, and python/, call these functions. A change
// must keep that trajectories are written after the copies of the inputs and uncertainty.json,
// because `run` takes a trajectory as the sign that those files are written. write_simulated(),
// exact_fit_file() and simulate_stage() throw Error(kWrongUsage) if the environment variable
// SOURCE_DATE_EPOCH is set and is not a time.
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

/// A fit of the drag that has been read but not parsed.
struct FitFile {
  std::filesystem::path path;  ///< path of the file, for messages
  std::string text;            ///< content of the file (JSON)
};

/// The case file, and after it the files of sampled external forces that its motion reads.
std::vector<std::filesystem::path> files_of_motion(const case_file::Case& c);

/// Names of the models to run, at least one: `asked` or, if this is empty, those that the case
/// names or, if the case names none, reduced_model::default_models(). Unknown names are not refused
/// here.
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

/// Runs the models that models_to_run(c, models) returns, in the order of that list, and writes no
/// file. `outside` is the choice of the drag outside the fit's interval of gaps. A model that
/// fails, because the gap leaves that interval or the model does not converge, does not stop the
/// others. Throws Error(kBadInput), which names the case or the fit, if the case has no [motion],
/// if the text of the fit is not that of a fit, if the resistance of the fit is not positive, if
/// the fit cannot be scaled to the case (case_file::fit_for), if a model is unknown or if a
/// parameter of a model is wrong. Throws the error of the first model if all models fail, and
/// Error(kInterrupted) if `stop` requests a stop.
Simulated simulate_case(const case_file::Case& c, const FitFile& fit_file,
                        const std::vector<std::string>& models,
                        const lubrication::OutsideInterval& outside, const StopToken& stop);

/// Writes the trajectories, the record of failed models, uncertainty.json and the copies of case
/// and fit, with the record `provenance` of how they were made. An earlier trajectory of a model
/// that failed is removed, because it was made from other inputs. Files of the user are not looked
/// for: simulate_stage() and run_stages() do this before. Throws Error(kBadInput) if a file cannot
/// be read, written or removed.
void write_simulated(const results::RunFolder& run, const case_file::Case& c,
                     const Simulated& simulated, const results::Provenance& provenance);

/// Path and text of the file fit.json in the run's folder that stands for the exact drag near a
/// plane, with radius and viscosity of the case. The file is not written here. If a file fit.json
/// in the folder differs from the new text only in the record of how it was made, the text of that
/// file is returned, so that it keeps the time at which it was made. Throws Error(kBadInput) if
/// that file cannot be read.
FitFile exact_fit_file(const case_file::Case& c, const results::RunFolder& run,
                       const results::Provenance& provenance);

/// The inputs of a simulation besides the case.
struct SimulateRequest {
  /// Path of the fit. If it is empty, the fit is the one that the case names, or the exact drag if
  /// the case asks for it, or fit.json in `folder`.
  std::string fit;
  std::filesystem::path folder;          ///< the run's folder
  std::vector<std::string> models;       ///< names of models; if empty, models_to_run() chooses
  lubrication::OutsideInterval outside;  ///< choice of the drag outside the interval of the fit
  StopToken stop{};                      ///< a requested stop throws Error(kInterrupted)
  std::string remedy{};  ///< what the user can do if there is no fit, as the end of the message
};

/// Runs the models and writes their trajectories and the copies of case and fit into the run's
/// folder. Before anything is written, throws the errors of simulate_case(), Error(kWrongUsage) if
/// there is no fit, and Error(kBadInput) if a file of the user would be replaced. If some models
/// fail, the results of the others are written, and then an error is thrown that has the kind and
/// the reason of the first model that failed (results::error_of()).
void simulate_stage(const case_file::Case& c, const SimulateRequest& request);

}  // namespace viscontact::pipeline
