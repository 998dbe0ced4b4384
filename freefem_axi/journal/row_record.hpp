// The finished and failed rows of a tabulation, collected from the table and from the journals of
// all processes that work on it. Numbers are in the units of the case. The journals must be read
// before the table, or rows may be missed.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/journal_line.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {

/// The rows by gap and velocity.
struct RowRecord {
  std::map<GridPoint, FinishedRow> finished;
  /// The reasons of failed rows. A row that was finished later is not among them.
  std::map<GridPoint, std::string> failed;
};

/// The points of a tabulation in the order of its table: for each velocity, the gaps in the given
/// order.
std::vector<GridPoint> grid_of(const Tabulation& tabulation);

/// The table in the file, or nothing if there is none or if it belongs to another tabulation.
std::optional<lubrication::ForceTable> find_table(const std::filesystem::path& table_path,
                                                  const std::string& tabulation_hash);

/// All rows of the tabulation in the journals and in the table.
RowRecord read_row_record(const std::filesystem::path& table_path,
                          const std::string& tabulation_hash);

/// Those of `points` that are not finished.
std::vector<GridPoint> missing_points(const RowRecord& record,
                                      const std::vector<GridPoint>& points);

/// The table of all rows. No point may be missing.
lubrication::ForceTable assemble_table(const Tabulation& tabulation, const RowRecord& record);

/// Removes the rows of a tabulation from its journals, once its table has been written. Rows of
/// other tabulations stay, because no table contains them yet; a journal without such rows is
/// deleted. A journal that another process has locked is not changed. Throws Error(kBadInput) if a
/// journal cannot be replaced.
void remove_journals(const std::filesystem::path& table_path, const std::string& tabulation_hash);

}  // namespace viscontact::freefem_axi
