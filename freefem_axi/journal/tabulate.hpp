// Computes the rows of a table with several FreeFEM processes at once.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/row_record.hpp"

namespace viscontact::freefem_axi {

/// The progress of compute_rows().
struct TabulateProgress {
  /// Rows that are finished or have failed, by this call or an earlier one; at most `rows`.
  std::size_t rows_done = 0;
  std::size_t rows = 0;     ///< all rows that the call of compute_rows() asks for
  double seconds_left = 0;  ///< estimated time for the other rows [s], >= 0
};

/// The function that compute_rows() calls with its progress; not empty.
using TabulateReport = std::function<void(const TabulateProgress&)>;

/// How this process computes rows.
struct RowWorker {
  FreeFem freefem;  ///< how FreeFEM is run
  int jobs = 1;     ///< number of FreeFEM processes that run at once, >= 1
  /// On a cluster: the name of this process that writer_name() makes (row_journal.hpp).
  std::string name;
};

/// Computes the rows at `points`, some of plan.points, that are not finished, also those that
/// failed before. Before a thread computes a row, it reads the table at `table_path` and the
/// journals beside it again, because another process may have finished the row meanwhile. Each
/// finished row, and the reason of each failed one, is on disk in the journal of the worker
/// (row_journal.hpp) before its thread starts the next row. `report` is called after each row, by
/// one thread at a time. If no row is missing, neither `report` nor FreeFEM is called. A row that
/// fails does not stop the others and is not thrown; read_row_record() returns its reason. Throws
/// Error(kExternalProgram) if FreeFEM cannot be run at all, Error(kBadInput) if a journal cannot be
/// written or read or if another process has locked it, Error(kInterrupted) at a stop, and any
/// other error of TablePlan::solve. This function does not write the table: the caller does, and
/// then removes the journals.
void compute_rows(const RowWorker& worker, const TablePlan& plan,
                  const std::vector<RowPoint>& points, const std::filesystem::path& table_path,
                  const TabulateReport& report);

}  // namespace viscontact::freefem_axi
