// The models that a simulation could not compute, while others could: recorded in a run's folder,
// so that `compare` and `report` can say why these have no trajectory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/csv.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact {

struct FailedModel {
  std::string model;   ///< its name, with suffixes
  std::string reason;  ///< the message of its Error, without the name of the model
  ErrorKind kind = ErrorKind::kBadInput;
  CsvComments made_from;  ///< what identifies case, fit and version, as in a trajectory file
};

/// Reads the record (JSON). Returns an empty list if there is no such file.
/// Throws Error(kBadInput) if the file is something else.
std::vector<FailedModel> read_failed_models(const std::filesystem::path& path);

/// The entries of a run's folder that were made from these inputs (FailedModel::made_from). A damaged
/// record counts as none.
std::vector<FailedModel> recorded_failures(const RunFolder& run, const CsvComments& made_from);

/// The text of the record.
std::string write_failed_models(const std::vector<FailedModel>& failed);

/// The one error of a simulation in which these models (at least one) failed and `computed` others
/// (which may be 0) did not. It names the case, carries the reason of the first and has the exit code of the first.
Error error_of(const std::vector<FailedModel>& failed, std::size_t computed,
               const std::filesystem::path& case_path);

/// The models of the folder's record that failed and have none of these trajectories.
std::vector<ModelWithoutTrajectory> failures_without(const std::vector<Trajectory>& trajectories,
                                                     const RunFolder& run);

/// The model that `run` compares these models with: `inertial`, or the first if there is no
/// `inertial`; a model that failed does not count. `models` is not empty.
std::string reference_without(const std::vector<std::string>& models,
                              const std::vector<FailedModel>& failed);

/// The model that `compare` compares with: the one that was asked for. If none was (`asked` is
/// empty), it is `inertial`, or the first that has a trajectory if `inertial` failed.
/// Throws Error(kBadInput) with the reason if the one that was asked for is one that failed.
std::string reference_among(const std::vector<Trajectory>& trajectories,
                            const std::vector<ModelWithoutTrajectory>& failed,
                            const std::string& asked);

}  // namespace viscontact
