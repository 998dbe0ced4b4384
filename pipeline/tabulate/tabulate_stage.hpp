// The stage tabulate: makes the tables of forces of one or several cases; a row is one gap, or one
// shape of a swimmer. This process computes the rows, or each task of a job on a cluster computes a
// share of them, and gather_stage() puts them together. Numbers are in the units of each case. Used
// by app/, python/, rolling/job and swimmer/job. A change must not lose finished rows, because a
// table can take hours. A file that cannot be read or written is an Error(kBadInput), an
// environment variable VISCONTACT_FREEFEM_TIME_LIMIT that is not a whole number of seconds an
// Error(kWrongUsage) of the functions that compute rows.
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
  std::filesystem::path table;      ///< the file for the table
  freefem_axi::TablePlan plan;      ///< the rows, and how they are computed, written and read
  /// What the table is made from; nothing for a swimmer.
  std::optional<freefem_axi::Tabulation> tabulation;
  /// The motions of the sphere in the table and in its companion (a file with the same rows and
  /// other columns), with their files; none for a swimmer.
  std::vector<std::pair<lubrication::MotionKind, std::filesystem::path>> motions{};
};

/// The table, in the file `table`, of the force on a sphere that approaches its neighbour. Throws
/// Error(kBadInput) if the case has no section [tabulation], or one with other motions.
CaseTable case_table(const case_file::Case& c, const std::filesystem::path& table);

/// The tables of all motions of a tabulation, whose case is the file `case_path` with the content
/// `case_text`. `path_of` gives the file of the table of a motion. If both sliding and rolling are
/// asked for, they are one table and its companion, because each solution gives rows of both. The
/// tables are in the order of freefem_axi::MotionGroup.
std::vector<CaseTable> case_tables(const std::filesystem::path& case_path,
                                   const std::string& case_text,
                                   const freefem_axi::Tabulation& tabulation,
                                   const freefem_axi::TablePath& path_of);

/// The points of each table's grid that belong to the share, one list for each of `tables`, in
/// their order; a list may be empty. A point is the gap [L] and velocity [L/T] of a row, its gap
/// alone, or the gaps between the spheres of a swimmer [L]. The rows of all tables are numbered in
/// one sequence from 0.
std::vector<std::vector<freefem_axi::RowPoint>> points_of(const std::vector<CaseTable>& tables,
                                                          const Share& share);

/// The error, of kind kExternalProgram, that names the rows that failed, if any did, when every
/// table is written without them; nothing if no row failed. The caller throws it after it has made
/// everything that the other rows allow.
using RowFailure = std::optional<Error>;

/// Calls `call`. If it throws an Error and `failure` is not empty, the Error gets the kind of
/// `failure` and its message first, because the failed rows may be the cause. Error(kInterrupted)
/// is thrown unchanged.
template <class Call>
void with_failure(const RowFailure& failure, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    if (!failure || error.kind() == ErrorKind::kInterrupted) throw;
    throw Error(failure->kind(), std::string(failure->what()) + "; " + error.what());
  }
}

/// Computes the missing rows, one table after the other, `jobs` >= 1 rows at once, and writes the
/// tables. A table that was already made from the same inputs is left as it is. A row that fails
/// stops neither the other rows nor the other tables. Its table is written without it, and the
/// error that names it is returned. If no row is left, or if the table needs all of them
/// (TablePlan), the table is not written, and Error(kExternalProgram) that names the rows is thrown
/// at the end, as it is if FreeFEM cannot be run. Rows that failed in an earlier call are computed
/// again. Throws Error(kInterrupted) if `stop` requests a stop; finished rows are kept.
[[nodiscard]] RowFailure tabulate_stage(const std::vector<CaseTable>& tables, int jobs,
                                        const StopToken& stop);

/// Computes the missing rows of a share, `jobs` >= 1 at once, and adds them to journals of this
/// task (a journal keeps finished rows until their table is written), but writes no table. Throws
/// Error(kExternalProgram) at the end if rows failed or FreeFEM cannot be run, and
/// Error(kInterrupted) if `stop` requests a stop; finished rows are kept.
void share_stage(const std::vector<CaseTable>& tables, const Share& share, int jobs,
                 const StopToken& stop);

/// Writes the tables from finished rows and computes none. A table of which the only missing rows
/// failed is treated as in tabulate_stage(). If further rows are missing, throws at the end an
/// error that names them: Error(kExternalProgram) if some of them failed, else
/// Error(kNotConverged). `slurm_folder` contains logs and submitted cases (array_job.hpp), which
/// that error mentions; it need not exist. Of several tables, each is tried. Throws
/// Error(kInterrupted) between two tables if `stop` requests a stop.
[[nodiscard]] RowFailure gather_stage(const std::vector<CaseTable>& tables,
                                      const std::filesystem::path& slurm_folder,
                                      const StopToken& stop);

/// Submits the tasks that have rows to compute and prints the number of the job to standard output.
/// If no row is missing, no job is submitted and no number is printed. Throws Error(kBadInput) if
/// an earlier job for the same output is not over, and the other errors of submit() in
/// array_job.hpp, such as Error(kExternalProgram) if Slurm is missing or refuses the job. `options`
/// are further arguments for the command of the tasks and for the one that gathers.
void submit_to_slurm(const std::vector<CaseTable>& tables, const ArrayRequest& request,
                     const std::vector<std::string>& options = {});

}  // namespace viscontact::pipeline
