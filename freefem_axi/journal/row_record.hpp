// The finished and failed rows of a table, collected from the table and from the journals of all
// processes that work on it. A change must keep that the journals are read before the table,
// because the process that writes the table then removes the journals. Units: those of the plan.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/table_plan.hpp"

namespace viscontact::freefem_axi {

/// All rows of the plan in the journals and in the table.
RowRecord read_row_record(const std::filesystem::path& table_path, const TablePlan& plan);

/// Those of `points` that are not finished, in their order.
std::vector<RowPoint> missing_points(const RowRecord& record, const std::vector<RowPoint>& points);

/// The reasons of those of `points` that failed.
std::vector<std::string> failures_of(const RowRecord& record, const std::vector<RowPoint>& points);

/// Removes the rows of the table with this hash from its journals, once the table has been written.
/// Rows of other tables stay, because no file contains them yet; a journal without such rows is
/// deleted. A journal that another process has locked is not changed. Throws Error(kBadInput) if a
/// journal cannot be replaced.
void remove_journals(const std::filesystem::path& table_path, const std::string& hash);

}  // namespace viscontact::freefem_axi
