// Declares the stage tabulate, which makes the tables of forces of one or several cases. A row of a
// table belongs to one gap of a sphere, or to one shape of a swimmer. Either this process computes
// the rows, or each task of a job on a cluster computes a share of them and gather_stage() puts
// them together. Gaps [L], > 0, velocities [L/T] and forces are in the units of each case. app/,
// python/, rolling/job and swimmer/job call these functions. A change must not lose finished rows,
// because a table can take hours. Each function throws Error(kBadInput) if a file cannot be read or
// written; tabulate_stage() and share_stage() throw Error(kWrongUsage) if the environment variable
// VISCONTACT_FREEFEM_TIME_LIMIT is not a whole number of seconds.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/stop_token.hpp"
#include "viscontact/freefem_axi/motion_table_plan.hpp"
#include "viscontact/pipeline/slurm/array_job.hpp"

namespace viscontact::pipeline {

/// A case, the file for its table, and how the table is computed.
struct CaseTable {
  std::filesystem::path case_path;  ///< the case file
  std::string case_text;            ///< content of the case file
  std::filesystem::path table;      ///< path of the table (CSV), which need not exist
  freefem_axi::TablePlan plan;      ///< the rows, and how they are computed, written and read
  /// Gaps, velocities and geometry from which the table is made; nothing for a swimmer.
  std::optional<freefem_axi::Tabulation> tabulation;
  /// The motions of the sphere in the table and in its companion (a file with the same rows and
  /// other columns), with their files; none for a swimmer.
  std::vector<std::pair<lubrication::MotionKind, std::filesystem::path>> motions{};
};

/// The table, in the file `table`, of the force on a sphere that approaches its neighbour. Nothing
/// is computed yet. Throws Error(kBadInput) if the case has no section [tabulation], or if this
/// section asks for another motion than "approach".
CaseTable case_table(const case_file::Case& c, const std::filesystem::path& table);

/// The tables of all motions of a tabulation, whose case is the file `case_path` with the content
/// `case_text`. `path_of` returns the path of the table of a motion. Nothing is computed yet. If
/// both sliding and rolling are asked for, they are one table and its companion, because each
/// solution gives rows of both. The tables are in the order of freefem_axi::MotionGroup.
std::vector<CaseTable> case_tables(const std::filesystem::path& case_path,
                                   const std::string& case_text,
                                   const freefem_axi::Tabulation& tabulation,
                                   const freefem_axi::TablePath& path_of);

/// The points of each table's grid that belong to the share, one list for each of `tables`, in
/// their order; a list may be empty. The point of a row is its gap [L] and velocity [L/T], or its
/// gap alone, or the gaps between the spheres of a swimmer [L]. The rows of all tables are numbered
/// in one sequence from 0. `share.count` must be >= 1 (not checked).
std::vector<std::vector<freefem_axi::RowPoint>> points_of(const std::vector<CaseTable>& tables,
                                                          const Share& share);

/// The error, of kind kExternalProgram, that names the rows that failed; nothing if no row failed.
/// A function returns it if every table is written, without these rows. The caller throws the error
/// after it has made everything that the other rows allow.
using RowFailure = std::optional<Error>;

/// Calls `call`. If `call` throws an Error and `failure` is not empty, an Error is thrown that has
/// the kind of `failure`, and whose message is the message of `failure` followed by that of the
/// Error, because the failed rows may be the cause. Error(kInterrupted) is thrown unchanged.
template <class Call>
void with_failure(const RowFailure& failure, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    if (!failure || error.kind() == ErrorKind::kInterrupted) throw;
    throw Error(failure->kind(), std::string(failure->what()) + "; " + error.what());
  }
}

/// Computes the missing rows, one table after the other, `jobs` >= 1 (not checked) rows at once,
/// and writes the tables. A table that was already made from the same inputs is left as it is. A
/// row that fails stops neither the other rows nor the other tables. Its table is written without
/// the row, and the error that names the row is returned. If all rows of a table failed, or if the
/// table needs all rows (TablePlan), the table is not written, and Error(kExternalProgram), which
/// names the rows, is thrown at the end. The same error is thrown if FreeFEM cannot be run. Rows
/// that failed in an earlier call are computed again. Throws Error(kInterrupted) if `stop` requests
/// a stop; finished rows are kept.
[[nodiscard]] RowFailure tabulate_stage(const std::vector<CaseTable>& tables, int jobs,
                                        const StopToken& stop);

/// Computes the missing rows of a share, `jobs` >= 1 (not checked) at once, and adds them to the
/// journals of this task, but writes no table. A journal is a file beside a table that keeps
/// finished rows until the table is written. Throws Error(kExternalProgram) at the end if rows
/// failed or FreeFEM cannot be run, and Error(kInterrupted) if `stop` requests a stop; finished
/// rows are kept.
void share_stage(const std::vector<CaseTable>& tables, const Share& share, int jobs,
                 const StopToken& stop);

/// Writes the tables from finished rows and computes no row. A table whose missing rows have all
/// been tried and failed is treated as in tabulate_stage(). If a table lacks a row that was not
/// tried, the table is not written, and at the end an error is thrown that names missing rows:
/// Error(kExternalProgram) if some of them failed, else Error(kNotConverged). `slurm_folder` is the
/// folder of logs and submitted cases (array_job.hpp), which the message mentions; it need not
/// exist. A table that cannot be written does not stop the others. Throws Error(kInterrupted)
/// between two tables if `stop` requests a stop.
[[nodiscard]] RowFailure gather_stage(const std::vector<CaseTable>& tables,
                                      const std::filesystem::path& slurm_folder,
                                      const StopToken& stop);

/// Submits the tasks that have rows to compute and prints the number of the job to standard output.
/// If no row is missing, no job is submitted and no number is printed. Throws Error(kBadInput) if
/// an earlier job for the same output is not over or a file cannot be read or written,
/// Error(kExternalProgram) if Slurm is missing or refuses the job, Error(kWrongUsage) if a
/// quotation mark in `request.options` is not closed, and Error(kInterrupted) if `request.stop`
/// requests a stop. `options` are further arguments of the command `tabulate` that each task runs,
/// and of the command that gathers the rows later.
void submit_to_slurm(const std::vector<CaseTable>& tables, const ArrayRequest& request,
                     const std::vector<std::string>& options = {});

}  // namespace viscontact::pipeline
