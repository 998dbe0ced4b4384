// Computes the rows of a tabulation with several FreeFEM processes at once, for the stage
// `tabulate`. Times are in seconds. A change must keep that each finished row is on disk before its
// process starts the next one.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/row_record.hpp"

namespace viscontact::freefem_axi {

/// How far a tabulation is.
struct TabulateProgress {
  std::size_t rows_done = 0;  ///< rows that were there before, or are computed or failed
  std::size_t rows = 0;       ///< rows that were asked for
  double seconds_left = 0;    ///< [s], estimated from the finished rows; 0 before the first
};

/// The function that is called with the progress.
using TabulateReport = std::function<void(const TabulateProgress&)>;

/// One of the processes that compute rows.
struct RowWorker {
  FreeFem freefem;  ///< how FreeFEM is run
  int jobs = 1;     ///< number of FreeFEM processes at once
  /// Writer of the worker's journal (row_journal.hpp); empty for the journal of this machine.
  std::string name;
};

/// Computes those of `points` that neither this worker nor another one has finished; this is
/// checked again before each row. Each finished row, and the reason of each failed one, is written
/// at once to the worker's journal beside `table_path`. `report` is called after each row, never
/// twice at once. A row that fails does not stop the others, and its failure is not thrown:
/// RowRecord::failed contains it. Throws Error(kExternalProgram) if FreeFEM cannot be run at all,
/// and Error(kInterrupted) if worker.freefem.stop requests a stop. The caller removes the journals
/// after it has written the table.
void compute_rows(const RowWorker& worker, const TablePlan& plan,
                  const std::vector<RowPoint>& points, const std::filesystem::path& table_path,
                  const TabulateReport& report);

}  // namespace viscontact::freefem_axi
