// Tabulates cases in one process, computes the rows of one task of a job on a cluster, or gathers
// the rows of all tasks. Rows that fail do not stop the others; at the end an error names the rows
// that are missing: Error(kExternalProgram) if some of them failed, else Error(kNotConverged). A
// file that cannot be read or written is an Error(kBadInput), a wrong VISCONTACT_FREEFEM_TIME_LIMIT
// an Error(kWrongUsage), a stop an Error(kInterrupted). Gaps [L], > 0, and velocities [L/T] of rows
// are in the units of their case; `jobs` is at least 1 (not checked). The Share of a task are the
// rows whose number modulo Share::count is Share::number. A companion of a table is a file with the
// same rows and other columns. A change must keep that journals, files beside a table to which each
// finished row is added, are removed only after the table is written. app/, pipeline/, python/,
// rolling/ and swimmer/ use this file.
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"

#include <fmt/format.h>

#include <algorithm>

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

/// Warns on the terminal of each finished row whose relative error estimate [1] exceeds the
/// accuracy that the case asks for.
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

/// True if the table of this case exists and has all rows. Then a message says so, and journals
/// that another process wrote after the table was finished are removed.
bool is_up_to_date(const CaseTable& one) {
  if (!freefem_axi::missing_points(one.plan.read(one.table), one.plan.points).empty()) return false;
  terminal::say("tabulate: {} is up to date", one.table.string());
  freefem_axi::remove_journals(one.table, one.plan.hash);
  warn_of_unmet_accuracy(one.plan, freefem_axi::read_row_record(one.table, one.plan));
  return true;
}

/// Writes the table and its companions from `record`, which must have all rows except those that
/// failed (not checked). Returns the error that names the failed rows, or nothing if no row failed.
/// The message ends with `remedy`, which says what the user can do. Throws such an error, and
/// writes nothing, if all rows failed or if the table needs all its rows.
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

/// Shows the number of finished rows and the remaining time [s] on the terminal.
void show_rows(const freefem_axi::TabulateProgress& progress) {
  terminal::show_progress(fmt::format("tabulate: {}/{} rows, {:.0f} s left", progress.rows_done,
                                      progress.rows, progress.seconds_left));
}

/// Says in words how many `points` (rows) there are, and how many of them are finished already.
std::string rows_in_words(const CaseTable& one, const std::vector<freefem_axi::RowPoint>& points) {
  const auto missing =
      freefem_axi::missing_points(freefem_axi::read_row_record(one.table, one.plan), points);
  const auto kept = points.size() - missing.size();
  return fmt::format("{} rows{}", points.size(),
                     kept > 0 ? fmt::format(" ({} of them already computed)", kept) : "");
}

/// Computes the missing rows of a table, at most `jobs` >= 1 at once, and writes the table. Returns
/// and throws what finish_table() does; also throws Error(kExternalProgram) if FreeFEM cannot be
/// run, and Error(kInterrupted) at a stop.
RowFailure tabulate_one(const CaseTable& one, int jobs, const StopToken& stop) {
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

/// Throws the error that says that the rows `missing`, at least one, are missing. It is an
/// Error(kExternalProgram) if one of these rows has failed, else an Error(kNotConverged).
/// `slurm_folder` is the folder of the logs of the job, which need not exist.
[[noreturn]] void throw_missing(const CaseTable& one, const freefem_axi::RowRecord& record,
                                const std::vector<freefem_axi::RowPoint>& missing,
                                const fs::path& slurm_folder) {
  constexpr std::size_t kNamed = 3;  // rows that the message names, a free choice
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

/// Writes a table from the rows that the tasks of a job have computed. Returns and throws what
/// finish_table() does, and throws the error of throw_missing() if a row was not tried yet.
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

/// Calls `work` with the index of each table, from 0. An error of kind kExternalProgram or
/// kNotConverged, which says that rows failed or are missing, does not stop the other tables. At
/// the end one error states all these errors. If `work` returned all of them, every table is
/// written, and this function returns the one error. If `work` threw one of them, this function
/// throws the one error. An error of any other kind is passed on at once. A single table is not
/// treated in this way: what `work` returns or throws is passed on. Throws Error(kInterrupted)
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

/// The table, at the path `table`, of the force on a sphere that approaches. Nothing is computed.
/// Throws Error(kBadInput) if the case has no tabulation or asks for another motion.
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

/// The tables of all motions of the tabulation. `path_of` gives the path of the table of a motion.
/// Nothing is computed.
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

/// For each table the points of its rows that belong to the share. The rows of all tables are
/// numbered in one sequence from 0; share.count is >= 1 (not checked).
std::vector<std::vector<freefem_axi::RowPoint>> points_of(const std::vector<CaseTable>& tables,
                                                          const Share& share) {
  std::vector<std::vector<freefem_axi::RowPoint>> points;
  std::size_t row = 0;
  for (const auto& one : tables) {
    points.emplace_back();
    for (const auto& point : one.plan.points)
      if (row++ % share.count == share.number) points.back().push_back(point);
  }
  return points;
}

/// Computes the missing rows of all tables and writes the tables. Returns the error that names the
/// rows that failed, if every table is written nevertheless.
RowFailure tabulate_stage(const std::vector<CaseTable>& tables, int jobs, const StopToken& stop) {
  return for_each_table(tables, stop,
                        [&](std::size_t i) { return tabulate_one(tables[i], jobs, stop); });
}

/// Computes the missing rows of a share and adds them to the journals of this task. Writes no
/// table. Throws Error(kExternalProgram) at the end if rows failed.
void share_stage(const std::vector<CaseTable>& tables, const Share& share, int jobs,
                 const StopToken& stop) {
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

/// Writes the tables from finished rows, and computes nothing.
RowFailure gather_stage(const std::vector<CaseTable>& tables, const fs::path& slurm_folder,
                        const StopToken& stop) {
  return for_each_table(tables, stop,
                        [&](std::size_t i) { return gather_one(tables[i], slurm_folder); });
}

namespace {

/// The numbers of those of `count` >= 1 tasks that have rows to compute, from 0 and increasing.
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

/// Submits the tasks that have rows to compute. `options` are further arguments of the command
/// `tabulate` that each task runs.
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
