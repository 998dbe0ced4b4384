// Submits a tabulation to the workload manager Slurm as one array job (docs/cluster.md). The
// command `tabulate --launcher slurm` calls it.
#pragma once

#include <vector>

#include "viscontact/pipeline/array_job.hpp"
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"

namespace viscontact::pipeline {

/// Submits the tasks that have rows to compute and prints the number of the job to standard output.
/// If no row is missing, no job is submitted and no number is printed. Throws Error(kBadInput)
/// if an earlier job for the same output is still pending or running, and Error(kExternalProgram)
/// with the message of Slurm if Slurm is missing or refuses the job. `options` are further words of
/// the command, which the tasks and the command that gathers need.
void submit_to_slurm(const std::vector<CaseTable>& tables, const ArrayRequest& request,
                     const std::vector<std::string>& options = {});

}  // namespace viscontact::pipeline
