// Finds the tasks of a tabulation that have rows to compute (tabulate_job.hpp).
#include "viscontact/pipeline/tabulate/tabulate_job.hpp"

#include <algorithm>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"

namespace viscontact::pipeline {
namespace {

/// The numbers of the tasks that have rows to compute.
std::vector<std::size_t> tasks_with_rows(const std::vector<CaseTable>& tables, std::size_t count) {
  std::vector<freefem_axi::RowRecord> records;
  records.reserve(tables.size());
  for (const auto& one : tables)
    records.push_back(freefem_axi::read_row_record(one.table, one.plan));
  std::vector<std::size_t> tasks;
  for (std::size_t task = 0; task < count; ++task) {
    const auto points = points_of(tables, {task, count});
    for (std::size_t i = 0; i < tables.size(); ++i)
      if (!freefem_axi::missing_points(records[i], points[i]).empty()) {
        tasks.push_back(task);
        break;
      }
  }
  return tasks;
}

}  // namespace

void submit_to_slurm(const std::vector<CaseTable>& tables, const ArrayRequest& request,
                     const std::vector<std::string>& options) {
  std::size_t rows = 0;
  ArrayJob job;
  job.command = "tabulate";
  job.is_running = "is being tabulated";
  job.results = "the tables";
  for (const auto& one : tables) {
    check_output_file(one.table);
    rows += one.plan.points.size();
    // A case of several motions has several tables.
    if (std::ranges::find(job.cases, one.case_path.string()) != job.cases.end()) continue;
    job.cases.push_back(one.case_path.string());
    job.copies.emplace_back(one.case_path.filename().string(), one.case_text);
  }
  job.options = options;
  job.count = task_count(request, rows);
  (void)split_words(request.options);  // throws if they are wrong, before Slurm is asked
  refuse_second_job(job, request);
  job.tasks = tasks_with_rows(tables, job.count);
  submit(job, request);
}

}  // namespace viscontact::pipeline
