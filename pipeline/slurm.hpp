// A tabulation as one array job of Slurm.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/pipeline/tabulate_stage.hpp"

namespace viscontact {

struct SlurmRequest {
  std::filesystem::path output;      ///< of `viscontact tabulate`, for all tables
  std::optional<std::size_t> tasks;  ///< of the array; default: a task a row, 1000 at most
  std::optional<int> jobs;           ///< FreeFEM processes at once in a task; default: one
  std::string options;               ///< more words for sbatch, quoted as in a shell
};

/// OUTPUT.slurm: the cases as submitted, the script of a task, the tasks' logs.
std::filesystem::path slurm_folder(const std::filesystem::path& output);

/// Submits the tasks that have rows to compute. The job's number goes to standard output; it is empty if
/// no row is missing. Throws Error(kBadInput) if an earlier job for the same output is not over,
/// Error(kExternalProgram) with what Slurm says if it does not take the job.
void submit_to_slurm(const std::vector<CaseTable>& tables, const SlurmRequest& request);

}  // namespace viscontact
