// The driver: a tabulation's rows over several FreeFEM processes.
#pragma once

#include <filesystem>
#include <functional>

#include "freefem_axi/tabulation.hpp"

namespace viscontact {

struct TabulateProgress {
  std::size_t rows_done = 0, rows = 0;
  double seconds_left = 0;  ///< estimated from the rows done so far; 0 until there is one
};

/// Computes every row that `journal_path` does not hold yet, over `jobs` processes at once, and
/// returns the whole table: gaps in the given order, for each velocity. Finished rows go to the
/// journal at once; it is left in place, to be removed when the table is written. `report` is
/// called after each row, one call at a time.
///
/// A row that fails does not stop the others: Error(kExternalProgram) at the end names each. Throws
/// Error(kInterrupted) on Ctrl-C.
ForceTable tabulate(const FreeFem& freefem, const Tabulation& tabulation, int jobs,
                    const std::filesystem::path& journal_path,
                    const std::function<void(const TabulateProgress&)>& report);

}  // namespace viscontact
