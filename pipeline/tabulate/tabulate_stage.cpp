// Computes rows and keeps those that succeed: journals are removed only after the table is written.
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/on_one_line.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/freefem_axi/journal/row_journal.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"
#include "viscontact/freefem_axi/journal/tabulate.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;

/// Warns of each finished row whose error estimate exceeds the accuracy that the case asks for.
void warn_of_unmet_accuracy(const freefem_axi::TablePlan& plan,
                            const freefem_axi::RowRecord& record) {
  for (const auto& point : plan.points) {
    const auto row = record.finished.find(point);
    if (row == record.finished.end()) continue;
    if (const double estimate = plan.estimate_of(row->second); estimate > plan.relative_accuracy)
      terminal::warn("viscontact: warning: {}: relative error estimate {:.2g}, {:.2g} was asked",
                     plan.name_of(point), estimate, plan.relative_accuracy);
  }
}

/// True if the table has all rows. Then journals that another process wrote after the table was
/// finished are removed.
bool is_up_to_date(const CaseTable& one) {
  if (!freefem_axi::missing_points(one.plan.read(one.table), one.plan.points).empty()) return false;
  terminal::say("tabulate: {} is up to date", one.table.string());
  freefem_axi::remove_journals(one.table, one.plan.hash);
  warn_of_unmet_accuracy(one.plan, freefem_axi::read_row_record(one.table, one.plan));
  return true;
}

/// Writes the table and its companions from `record`, which must have all rows except those that
/// failed. Returns the error that names the failed rows, or nothing if no row failed; its message
/// ends with `remedy`. Throws such an error, and writes nothing, if all rows failed or if the table
/// needs all its rows.
RowFailure finish_table(const CaseTable& one, const freefem_axi::RowRecord& record,
                        const results::Provenance& provenance, const std::string& remedy) {
  const auto failures = freefem_axi::failures_of(record, one.plan.points);
  const auto why = [&](const std::string& result) {
    return Error(ErrorKind::kExternalProgram, "{} of {} rows failed, {}:\n{}", failures.size(),
                 one.plan.points.size(), result, fmt::join(failures, "; "));
  };
  if (failures.size() == one.plan.points.size()) throw why("so that there is no table");
  if (!failures.empty() && one.plan.needs_all_rows)
    throw why(
        "the others are kept; this table needs all its rows, because its fit is a polynomial "
        "through them");
  const freefem_axi::Versions versions = {{"Viscontact", VISCONTACT_VERSION}};
  const auto write = [&](const fs::path& path, const std::string& text) {
    if (!results::has_content(path, text))
      results::write_output(path, TextKind::kHashComment, text, provenance);
  };
  write(one.table, one.plan.write(record, versions));
  for (const auto& other : one.plan.companions) write(other.path, other.write(record, versions));
  freefem_axi::remove_journals(one.table, one.plan.hash);
  warn_of_unmet_accuracy(one.plan, record);
  if (failures.empty()) return {};
  return why(
      fmt::format("{} has the others and names the failed ones; {}", one.table.string(), remedy));
}

void show_rows(const freefem_axi::TabulateProgress& progress) {
  terminal::show_progress(fmt::format("tabulate: {}/{} rows, {:.0f} s left", progress.rows_done,
                                      progress.rows, progress.seconds_left));
}

std::string rows_in_words(const CaseTable& one, const std::vector<freefem_axi::RowPoint>& points) {
  const auto missing =
      freefem_axi::missing_points(freefem_axi::read_row_record(one.table, one.plan), points);
  const auto kept = points.size() - missing.size();
  return fmt::format("{} rows{}", points.size(),
                     kept > 0 ? fmt::format(" ({} of them already computed)", kept) : "");
}

/// Returns and throws what finish_table() does; also throws Error(kExternalProgram) if FreeFEM
/// cannot be run, and Error(kInterrupted) at a stop.
RowFailure tabulate_one(const CaseTable& one, int jobs, const StopToken& stop) {
  assert(jobs >= 1);
  if (is_up_to_date(one)) return {};
  check_output_file(one.table);
  terminal::say("tabulate: {} on {} processes", rows_in_words(one, one.plan.points), jobs);
  const auto provenance = results::provenance_of({{one.case_path}, {}});
  freefem_axi::compute_rows({freefem_axi::default_freefem(stop), jobs, ""}, one.plan,
                            one.plan.points, one.table, show_rows);
  terminal::clear_progress();
  return finish_table(one, freefem_axi::read_row_record(one.table, one.plan), provenance,
                      "the same command tries them again");
}

/// Throws Error(kExternalProgram) if one of the rows `missing` has failed, else
/// Error(kNotConverged).
[[noreturn]] void throw_missing(const CaseTable& one, const freefem_axi::RowRecord& record,
                                const std::vector<freefem_axi::RowPoint>& missing,
                                const fs::path& slurm_folder) {
  assert(!missing.empty());
  constexpr std::size_t kNamed = 3;  // rows that the message names
  std::vector<std::string> named;
  for (std::size_t i = 0; i < std::min(missing.size(), kNamed); ++i)
    named.push_back(one.plan.name_of(missing[i]));
  if (missing.size() > kNamed) named.emplace_back("...");
  const auto reasons = freefem_axi::failures_of(record, missing);
  std::string text = fmt::format("{} of {} rows are missing ({}); the finished ones are kept",
                                 missing.size(), one.plan.points.size(), fmt::join(named, "; "));
  if (fs::exists(slurm_folder)) text += fmt::format("; logs are in {}", slurm_folder.string());
  if (const auto submitted = slurm_folder / one.case_path.filename();
      fs::exists(submitted) && read_file(submitted) != one.case_text)
    text += fmt::format("; the case was edited since {} was submitted", submitted.string());
  if (reasons.empty()) throw Error(ErrorKind::kNotConverged, text);
  throw Error(ErrorKind::kExternalProgram, "{}:\n{} failed: {}", text, reasons.size(),
              fmt::join(reasons, "; "));
}

/// Returns and throws what finish_table() does, and throws the error of throw_missing() if a row
/// was not tried yet.
RowFailure gather_one(const CaseTable& one, const fs::path& slurm_folder) {
  if (is_up_to_date(one)) return {};
  const auto record = freefem_axi::read_row_record(one.table, one.plan);
  const auto missing = freefem_axi::missing_points(record, one.plan.points);
  // A row that is missing and has not failed may still be computed by a task, so the table must
  // wait.
  if (freefem_axi::failures_of(record, missing).size() < missing.size())
    throw_missing(one, record, missing, slurm_folder);
  auto failure = finish_table(one, record, results::provenance_of({{one.case_path}, {}}),
                              "the same command without --gather tries them again");
  terminal::say("tabulate: {} is gathered", one.table.string());
  return failure;
}

/// Calls `work` with the index of each table. An error of kind kExternalProgram or kNotConverged,
/// which says that rows failed or are missing, does not stop the other tables. At the end one error
/// states all these errors: it is returned if `work` returned all of them, so that every table is
/// written, and thrown if `work` threw one of them. An error of any other kind is passed on at
/// once, and so is what `work` returns or throws for a single table. Throws Error(kInterrupted)
/// between two tables at a stop.
template <class Work>
RowFailure for_each_table(const std::vector<CaseTable>& tables, const StopToken& stop,
                          const Work& work) {
  if (tables.size() == 1) return work(0);
  // If both kinds occur, the error has the kind kExternalProgram, because it is more serious.
  auto kind = ErrorKind::kNotConverged;
  bool all_written = true;
  std::vector<std::string> failures;
  const auto add = [&](std::size_t i, const Error& error) {
    if (error.kind() == ErrorKind::kExternalProgram) kind = error.kind();
    failures.push_back(fmt::format("{}: {}", tables[i].table.string(), on_one_line(error.what())));
  };
  for (std::size_t i = 0; i < tables.size(); ++i) {
    stop.throw_if_stop_requested();
    try {
      if (const auto failure = work(i)) add(i, *failure);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kExternalProgram && error.kind() != ErrorKind::kNotConverged)
        throw;
      terminal::clear_progress();
      add(i, error);
      all_written = false;
    }
  }
  if (failures.empty()) return {};
  Error all(kind, fmt::format("{} of {} tables are not finished:\n{}", failures.size(),
                              tables.size(), fmt::join(failures, "; ")));
  if (!all_written) throw all;
  return all;
}

}  // namespace

CaseTable case_table(const case_file::Case& c, const fs::path& table) {
  const auto& tabulation = case_file::required_tabulation(c);
  if (tabulation.motions != std::vector{lubrication::MotionKind::kApproach})
    throw Error(
        ErrorKind::kBadInput,
        "{}: tabulation.motion must be \"approach\" or be left out here, because the sphere moves "
        "along the axis; `viscontact tabulate` makes tables of the other motions",
        c.path.string());
  return case_tables(c.path, c.text, tabulation, [&](auto) { return table; }).front();
}

std::vector<CaseTable> case_tables(const fs::path& case_path, const std::string& case_text,
                                   const freefem_axi::Tabulation& tabulation,
                                   const freefem_axi::TablePath& path_of) {
  std::vector<CaseTable> tables;
  for (const auto group : freefem_axi::motion_groups(tabulation)) {
    auto& one =
        tables.emplace_back(CaseTable{case_path,
                                      case_text,
                                      {},
                                      freefem_axi::motion_table_plan(tabulation, group, path_of),
                                      tabulation});
    for (const auto motion : freefem_axi::asked_motions(tabulation, group))
      one.motions.emplace_back(motion, path_of(motion));
    one.table = one.motions.front().second;
  }
  return tables;
}

std::vector<std::vector<freefem_axi::RowPoint>> points_of(const std::vector<CaseTable>& tables,
                                                          const Share& share) {
  assert(share.number < share.count);
  std::vector<std::vector<freefem_axi::RowPoint>> points;
  std::size_t row = 0;
  for (const auto& one : tables) {
    points.emplace_back();
    for (const auto& point : one.plan.points)
      if (row++ % share.count == share.number) points.back().push_back(point);
  }
  return points;
}

RowFailure tabulate_stage(const std::vector<CaseTable>& tables, int jobs, const StopToken& stop) {
  return for_each_table(tables, stop,
                        [&](std::size_t i) { return tabulate_one(tables[i], jobs, stop); });
}

void share_stage(const std::vector<CaseTable>& tables, const Share& share, int jobs,
                 const StopToken& stop) {
  assert(jobs >= 1);
  const freefem_axi::RowWorker worker = {freefem_axi::default_freefem(stop), jobs,
                                         freefem_axi::writer_name(share.number, share.count)};
  const auto points = points_of(tables, share);
  const auto failure = for_each_table(tables, stop, [&](std::size_t i) -> RowFailure {
    if (points[i].empty()) return {};
    terminal::say("tabulate: {} of {}", rows_in_words(tables[i], points[i]),
                  tables[i].table.string());
    freefem_axi::compute_rows(worker, tables[i].plan, points[i], tables[i].table, show_rows);
    const auto failures = freefem_axi::failures_of(
        freefem_axi::read_row_record(tables[i].table, tables[i].plan), points[i]);
    if (failures.empty()) return {};
    return Error(ErrorKind::kExternalProgram, "{} of {} rows failed, the others are kept:\n{}",
                 failures.size(), points[i].size(), fmt::join(failures, "; "));
  });
  if (failure) throw Error(*failure);
}

RowFailure gather_stage(const std::vector<CaseTable>& tables, const fs::path& slurm_folder,
                        const StopToken& stop) {
  return for_each_table(tables, stop,
                        [&](std::size_t i) { return gather_one(tables[i], slurm_folder); });
}

namespace {

/// The numbers of those tasks that have rows to compute, increasing.
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
    // A case of several motions has several tables, but is named once.
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
