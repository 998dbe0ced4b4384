// What is known of a tabulation's rows, from the table and from the journals of all processes that
// work on it.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal_line.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact {

struct RowRecord {
  std::map<GridPoint, FinishedRow> finished;
  std::map<GridPoint, std::string> failed;  ///< why; a row that was finished later is here no more
};

/// The points of a tabulation in the order of its table: gaps in the given order, for each velocity.
std::vector<GridPoint> grid_of(const Tabulation& tabulation);

/// The table in that file if there is one and it is of that tabulation.
std::optional<ForceTable> find_table(const std::filesystem::path& table_path,
                                     const std::string& tabulation_hash);

/// All that the journals and the table hold of that tabulation.
RowRecord read_row_record(const std::filesystem::path& table_path,
                          const std::string& tabulation_hash);

/// The points of `points` that are not finished.
std::vector<GridPoint> missing_points(const RowRecord& record,
                                      const std::vector<GridPoint>& points);

/// The table, once no point is missing.
ForceTable assemble_table(const Tabulation& tabulation, const RowRecord& record);

/// Takes the rows of a table that is written out of its journals, and removes those that then hold none: rows of
/// another tabulation, which are in no table yet, stay. A journal that another process holds is left as it is.
/// Throws Error(kBadInput) where a journal cannot be replaced.
void remove_journals(const std::filesystem::path& table_path, const std::string& tabulation_hash);

}  // namespace viscontact
