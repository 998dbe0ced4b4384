// The stage simulate: runs the models of motion on a case with a fit of the drag, and writes
// trajectories and the record of failed models. Numbers are in the units of the case.
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
  std::filesystem::path path;
  std::string text;
};

/// The case file, then the files of sampled external forces that its motion reads.
std::vector<std::filesystem::path> files_of_motion(const case_file::Case& c);

/// `asked` or, if this is empty, the models that the case names or, if it names none,
/// reduced_model::default_models(). Unknown names are not refused here.
std::vector<std::string> models_to_run(const case_file::Case& c,
                                       std::vector<std::string> asked = {});

/// The results of a simulation, before they are written.
struct Simulated {
  std::string fit_text;
  CsvComments made_from;  ///< comments that identify the inputs (run_inputs.hpp)
  std::vector<reduced_model::Trajectory> trajectories;  ///< of models that did not fail, >= 1
  std::vector<results::FailedModel> failed;             ///< models without a trajectory
  /// The file uncertainty.json; empty if the fit is exact or the effect cannot be computed.
  std::string uncertainty;
};

/// Runs models_to_run(c, models) in this order, and writes no file. A model that fails, because the
/// gap leaves the interval of the fit or the model does not converge, does not stop the others.
/// Throws Error(kBadInput), which names the case or the fit, if the case has no [motion], if the
/// text is not that of a fit, if its resistance is not positive, if it cannot be scaled to the
/// case, if a model is unknown or if a parameter of a model is wrong. Throws the error of the first
/// model if all models fail, and Error(kInterrupted) at a stop.
Simulated simulate_case(const case_file::Case& c, const FitFile& fit_file,
                        const std::vector<std::string>& models,
                        const lubrication::OutsideInterval& outside, const StopToken& stop);

/// Writes the trajectories, the record of failed models, uncertainty.json and the copies of case
/// and fit. An earlier trajectory of a model that failed is removed, because it was made from other
/// inputs. Files of the user are replaced, too. Throws Error(kBadInput) if a file cannot be read,
/// written or removed, and Error(kWrongUsage) if SOURCE_DATE_EPOCH is not a time.
void write_simulated(const results::RunFolder& run, const case_file::Case& c,
                     const Simulated& simulated, const results::Provenance& provenance);

/// The file fit.json in the run's folder that stands for the exact drag near a plane; it is not
/// written here. If the file in the folder differs only in the record of how it was made, its text
/// is returned, so that it keeps the time at which it was made. Throws Error(kBadInput) if that
/// file cannot be read, and Error(kWrongUsage) if SOURCE_DATE_EPOCH is not a time.
FitFile exact_fit_file(const case_file::Case& c, const results::RunFolder& run,
                       const results::Provenance& provenance);

/// The inputs of a simulation besides the case.
struct SimulateRequest {
  /// Path of the fit. If it is empty, the fit is the one that the case names, or the exact drag if
  /// the case asks for it, or fit.json in `folder`.
  std::string fit;
  std::filesystem::path folder;     ///< the run's folder
  std::vector<std::string> models;  ///< names of models; if empty, models_to_run() chooses
  lubrication::OutsideInterval outside;
  StopToken stop{};
  std::string remedy{};  ///< what the user can do if there is no fit, as the end of the message
};

/// Runs the models and writes their trajectories and the copies of case and fit into the run's
/// folder. Before anything is written, throws the errors of simulate_case(), Error(kWrongUsage) if
/// there is no fit or SOURCE_DATE_EPOCH is not a time, and Error(kBadInput) if a file of the user
/// would be replaced. If some models fail, the results of the others are written, and then an error
/// is thrown that has the kind and the reason of the first of them (results::error_of()).
void simulate_stage(const case_file::Case& c, const SimulateRequest& request);

}  // namespace viscontact::pipeline
