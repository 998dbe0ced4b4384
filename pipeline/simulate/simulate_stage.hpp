// The stage simulate: runs the models of motion on a case with a fit, and writes trajectories and
// the record of failed models into a run's folder. Lengths, masses and times are in the units of
// the case. The main job and the commands `simulate` and `sweep` call it. A change must keep that
// trajectories are written after the copies and uncertainty.json, because `run` takes a trajectory
// as the sign that those are written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"
#include "viscontact/pipeline/simulate/run_inputs.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/results/failed_models.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::pipeline {

/// A fit file: its path for messages, and its text.
struct FitFile {
  std::filesystem::path path;  ///< of the file
  std::string text;            ///< content of the file
};

/// The case file and the files of sampled forces that its motion reads.
std::vector<std::filesystem::path> files_of_motion(const case_file::Case& c);

/// The models of a run: `asked`, or if this is empty those that the case names, or if the case
/// names none, the default models of the registry.
std::vector<std::string> models_to_run(const case_file::Case& c,
                                       std::vector<std::string> asked = {});

/// The results of a simulation, before they are written.
struct Simulated {
  std::string fit_text;   ///< text of the fit file
  CsvComments made_from;  ///< comments that identify case, fit and version (run_inputs.hpp)
  std::vector<reduced_model::Trajectory> trajectories;  ///< of the models that did not fail
  std::vector<results::FailedModel> failed;             ///< models without a trajectory
  /// Effect of the fit's errors on the motion without inertia (JSON); empty if the fit is exact or
  /// the effect cannot be computed.
  std::string uncertainty;
};

/// Runs the models and writes no file. A model that fails, because it leaves the fit's interval or
/// does not converge, does not stop the others. Throws Error(kBadInput), which names the case or
/// the fit, if the fit cannot be scaled to the case (case_file::fit_for), or if a parameter of a
/// model is wrong. Throws the error of the first model if all models fail, and Error(kInterrupted)
/// if `stop` requests a stop.
Simulated simulate_case(const case_file::Case& c, const FitFile& fit_file,
                        const std::vector<std::string>& models,
                        const lubrication::OutsideInterval& outside, const StopToken& stop);

/// Writes the trajectories, the record of failed models, uncertainty.json and the copies of case
/// and fit. An earlier trajectory of a model that failed is removed, because it was made from other
/// inputs.
void write_simulated(const results::RunFolder& run, const case_file::Case& c,
                     const Simulated& simulated, const results::Provenance& provenance);

/// The fit file for the exact drag of the case in the run's folder. If the file there differs in
/// its provenance only, its text is returned unchanged, so that it is not written with a new time.
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
  std::string remedy{};  ///< what the user can do if there is no fit, for the message
};

/// Runs the models and writes their trajectories and the copies of case and fit into the run's
/// folder. Before anything is written, throws the errors of simulate_case(), Error(kWrongUsage) if
/// there is no fit, and Error(kBadInput) if a file must not be replaced. If some models failed, the
/// results of the others are written; then the error that results::error_of() makes is thrown.
void simulate_stage(const case_file::Case& c, const SimulateRequest& request);

}  // namespace viscontact::pipeline
