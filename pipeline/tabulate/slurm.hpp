// Submits a tabulation to the workload manager Slurm as one array job (docs/cluster.md).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"

namespace viscontact::pipeline {

/// The options of a tabulation by Slurm.
struct SlurmRequest {
  std::filesystem::path output;      ///< output of `viscontact tabulate`, for all tables
  std::optional<std::size_t> tasks;  ///< size of the array; default: one task a row, at most 1000
  std::optional<int> jobs;           ///< FreeFEM processes at once in a task; default: 1
  std::string options;               ///< further words for sbatch, quoted as in a shell
  StopToken stop{};                  ///< a stop ends the wait for Slurm (kInterrupted)
};

/// The folder OUTPUT.slurm, which has copies of the submitted cases, the script of a task and the
/// logs of the tasks.
std::filesystem::path slurm_folder(const std::filesystem::path& output);

/// Submits the tasks that have rows to compute and prints the number of the job to standard output.
/// If no row is missing, no job is submitted and no number is printed. Throws Error(kBadInput)
/// if an earlier job for the same output is still pending or running, and Error(kExternalProgram)
/// with the message of Slurm if Slurm is missing or refuses the job.
void submit_to_slurm(const std::vector<CaseTable>& tables, const SlurmRequest& request);

}  // namespace viscontact::pipeline
