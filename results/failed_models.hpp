// failed_models.json in the folder of a run: the models that failed, with reasons.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::results {

struct FailedModel {
  std::string model;                      ///< name, as in MODEL.csv
  std::string reason;                     ///< message of the Error, without the name of the model
  ErrorKind kind = ErrorKind::kBadInput;  ///< of the Error
  /// The lines "# key: value" with which a trajectory of this model would name its case, its fit
  /// and the version of the program.
  CsvComments made_from;
};

/// Reads the record, {"failed_models": {MODEL: {"reason", "exit_code", "made_from"}}}, in the order
/// of the file; empty if there is no file at `path`. Throws Error(kBadInput) if the file cannot be
/// read or is not such a record. Functions with paths throw std::filesystem::filesystem_error, too,
/// if the system refuses a path.
std::vector<FailedModel> read_failed_models(const std::filesystem::path& path);

/// The entries in the record of a run's folder whose FailedModel::made_from equals `made_from`;
/// none if the record is missing or damaged.
std::vector<FailedModel> recorded_failures(const RunFolder& run, const CsvComments& made_from);

/// The text of the record. If a model has two entries, the last one counts.
std::string write_failed_models(const std::vector<FailedModel>& failed);

/// The error that ends a simulation in which the models of `failed` (at least one) failed and
/// `computed` other models were computed. It names the file `case_path` and has the kind and the
/// reason of the first model that failed.
Error error_of(const std::vector<FailedModel>& failed, std::size_t computed,
               const std::filesystem::path& case_path);

/// The models in the record of the folder of which `trajectories` has no trajectory. Throws as
/// read_failed_models() does.
std::vector<reduced_model::ModelWithoutTrajectory> failures_without(
    const std::vector<reduced_model::Trajectory>& trajectories, const RunFolder& run);

/// The model with which `run` compares the others, chosen among those of `models` that are not in
/// `failed`: the usual reference (reduced_model::usual_reference()) if it is among them, otherwise
/// the first of them. If none is left, it is the usual reference.
std::string reference_without(const std::vector<std::string>& models,
                              const std::vector<FailedModel>& failed);

/// The model with which `compare` compares the others: `asked`, or the usual reference if `asked`
/// is empty. If `asked` is empty and the usual reference failed, it is the model of the first
/// trajectory, which must exist. Throws Error(kBadInput) with the recorded reason if the model
/// `asked` failed. The chosen model need not have a trajectory.
std::string reference_among(const std::vector<reduced_model::Trajectory>& trajectories,
                            const std::vector<reduced_model::ModelWithoutTrajectory>& failed,
                            const std::string& asked);

}  // namespace viscontact::results
