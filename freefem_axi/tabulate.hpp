// The driver: a tabulation's rows over several FreeFEM processes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/row_record.hpp"

namespace viscontact {

struct TabulateProgress {
  std::size_t rows_done = 0, rows = 0;
  double seconds_left = 0;  ///< estimated from the rows done so far; 0 until there is one
};

using TabulateReport = std::function<void(const TabulateProgress&)>;

/// Who computes rows.
struct RowWorker {
  FreeFem freefem;
  int jobs = 1;      ///< FreeFEM processes at once
  std::string name;  ///< the writer of its journal (row_journal.hpp); empty: this machine's own
};

/// Computes those of `points` that are not finished, by this worker or any other: asked again
/// before each row. Finished rows, and why others failed, go to the worker's journal beside
/// `table_path` at once. `report` is called after each row, one call at a time.
///
/// A row that fails does not stop the others: Error(kExternalProgram) at the end names each. Throws
/// Error(kInterrupted) on Ctrl-C.
void compute_rows(const RowWorker& worker, const Tabulation& tabulation,
                  const std::vector<GridPoint>& points, const std::filesystem::path& table_path,
                  const TabulateReport& report);

/// Computes all rows and returns the whole table, as compute_rows does. The journals are left in
/// place, to be removed when the table is written.
ForceTable tabulate(const FreeFem& freefem, const Tabulation& tabulation, int jobs,
                    const std::filesystem::path& table_path, const TabulateReport& report);

}  // namespace viscontact
