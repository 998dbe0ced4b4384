// The stage tabulate, which makes the tables of forces of cases: in this process, or from the rows
// that the tasks of a job on a cluster compute.
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
  std::filesystem::path case_path;
  std::string case_text;
  std::filesystem::path table;  ///< path of the table (CSV), which need not exist
  freefem_axi::TablePlan plan;  ///< the rows, and how they are computed, written and read
  /// Gaps, velocities and geometry from which the table is made; nothing for a swimmer.
  std::optional<freefem_axi::Tabulation> tabulation;
  /// The motions in the table and in its companion (a file with the same rows and other columns),
  /// with their files; none for a swimmer.
  std::vector<std::pair<lubrication::MotionKind, std::filesystem::path>> motions{};
};

/// The table of the approach. Throws Error(kBadInput) if the case has no section [tabulation], or
/// if this section asks for another motion.
CaseTable case_table(const case_file::Case& c, const std::filesystem::path& table);

/// The tables of all motions of a tabulation, in the order of freefem_axi::MotionGroup; nothing is
/// computed yet. Sliding and rolling are one table and its companion, because each solution gives
/// rows of both.
std::vector<CaseTable> case_tables(const std::filesystem::path& case_path,
                                   const std::string& case_text,
                                   const freefem_axi::Tabulation& tabulation,
                                   const freefem_axi::TablePath& path_of);

/// The points of each table that belong to the share. The rows of all tables are numbered in one
/// sequence from 0.
std::vector<std::vector<freefem_axi::RowPoint>> points_of(const std::vector<CaseTable>& tables,
                                                          const Share& share);

/// The error, of kind kExternalProgram, that names the rows that failed, if any. A function returns
/// it if every table is written, without these rows; the caller throws it at the end.
using RowFailure = std::optional<Error>;

/// Calls `call`. If it throws an Error and `failure` is not empty, an Error of the kind of
/// `failure` is thrown that has both messages, because the failed rows may be the cause.
/// Error(kInterrupted) is thrown unchanged.
template <class Call>
void with_failure(const RowFailure& failure, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    if (!failure || error.kind() == ErrorKind::kInterrupted) throw;
    throw Error(failure->kind(), std::string(failure->what()) + "; " + error.what(), failure->at());
  }
}

/// Computes the missing rows, `jobs` >= 1 at once, and writes the tables, one after the other. A
/// table that was already made from the same inputs is left as it is. A row that fails stops
/// neither the other rows nor the other tables; its table is written without it, and the error that
/// names it is returned. If all rows of a table failed, or if the table needs all rows (TablePlan),
/// it is not written, and Error(kExternalProgram) is thrown at the end, as if FreeFEM cannot be
/// run. Rows that failed in an earlier call are computed again. Throws Error(kBadInput) if a file
/// cannot be read or written, Error(kWrongUsage) if VISCONTACT_FREEFEM_TIME_LIMIT is not a whole
/// number of seconds, and Error(kInterrupted) at a stop; finished rows are kept.
[[nodiscard]] RowFailure tabulate_stage(const std::vector<CaseTable>& tables, int jobs,
                                        const StopToken& stop);

/// Computes the missing rows of a share, `jobs` >= 1 at once, and adds them to the journals of this
/// task, files beside a table that keep finished rows until the table is written; writes no table.
/// Throws Error(kExternalProgram) at the end if rows failed, and the other errors of
/// tabulate_stage().
void share_stage(const std::vector<CaseTable>& tables, const Share& share, int jobs,
                 const StopToken& stop);

/// Writes the tables from finished rows and computes no row. A table whose missing rows have all
/// been tried and failed is treated as in tabulate_stage(). If a table lacks a row that was not
/// tried, it is not written, and at the end an error is thrown that names missing rows:
/// Error(kExternalProgram) if some of them failed, else Error(kNotConverged). It mentions
/// `slurm_folder`, which need not exist. Throws Error(kBadInput) if a file cannot be read or
/// written, and Error(kInterrupted) between two tables at a stop.
[[nodiscard]] RowFailure gather_stage(const std::vector<CaseTable>& tables,
                                      const std::filesystem::path& slurm_folder,
                                      const StopToken& stop);

/// Submits the tasks that have rows to compute, which run the command `tabulate` with the further
/// arguments `options`. Throws the errors of refuse_second_job() and submit(), and Error(kBadInput)
/// if a file cannot be read or written.
void submit_to_slurm(const std::vector<CaseTable>& tables, const ArrayRequest& request,
                     const std::vector<std::string>& options = {});

}  // namespace viscontact::pipeline
