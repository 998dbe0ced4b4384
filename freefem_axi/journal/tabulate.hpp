// Computes the rows of a table with several FreeFEM processes at once. Times are in seconds; other
// numbers have the units of the table. A row that FreeFEM cannot compute is recorded and not
// thrown. Error(kExternalProgram) says that FreeFEM cannot be run, Error(kBadInput) that the
// journal cannot be written, Error(kInterrupted) that a stop was requested. Used by
// pipeline/tabulate/. A change must keep that each finished row is on disk before the thread that
// computed it starts the next one.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/row_record.hpp"

namespace viscontact::freefem_axi {

/// How many rows are computed.
struct TabulateProgress {
  std::size_t rows_done = 0;  ///< finished, by this call or before it, or failed; <= `rows`
  std::size_t rows = 0;       ///< all rows that the call of compute_rows() asks for
  double seconds_left = 0;    ///< estimated time for the other rows [s], >= 0
};

/// A function that compute_rows() calls with its progress.
using TabulateReport = std::function<void(const TabulateProgress&)>;

/// How this process computes rows. On a cluster several such processes work on one table.
struct RowWorker {
  FreeFem freefem;  ///< how FreeFEM is run
  int jobs = 1;     ///< number of FreeFEM processes that run at once, >= 1 (not checked)
  /// writer_name() of the process on a cluster (row_journal.hpp); empty on a single machine.
  std::string name;
};

/// Computes the rows at `points` that are not finished. Before each row the files are read again,
/// because another process may have finished it meanwhile. Each finished row, and the reason of
/// each failed one, is written at once to the worker's journal (row_journal.hpp) beside
/// `table_path`. `report` is called after each row, by one thread at a time; if no row is missing,
/// neither `report` nor FreeFEM is called. A row that fails does not stop the others and is not
/// thrown; read_row_record() returns it. Throws Error(kExternalProgram) if FreeFEM cannot be run at
/// all, Error(kBadInput) if the journal cannot be written, and Error(kInterrupted) if
/// worker.freefem.stop requests a stop. The caller writes the table and removes the journals.
void compute_rows(const RowWorker& worker, const TablePlan& plan,
                  const std::vector<RowPoint>& points, const std::filesystem::path& table_path,
                  const TabulateReport& report);

}  // namespace viscontact::freefem_axi
