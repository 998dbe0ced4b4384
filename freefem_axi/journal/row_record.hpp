// The finished and failed rows of a table, collected from its file and from its journals.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/table_plan.hpp"

namespace viscontact::freefem_axi {

/// The finished and failed rows of the planned table at `table_path`, from its journals and from
/// the table itself. Damaged lines, rows with another hash than plan.hash, a table that was
/// computed with other inputs, and files that do not exist give no rows. Among several failures at
/// a point, the last one in the journals (read in alphabetical order) counts, and a failure in the
/// table counts only if no journal has one. A point with a finished row has no failure. Throws
/// Error(kBadInput) if a journal exists but cannot be read.
RowRecord read_row_record(const std::filesystem::path& table_path, const TablePlan& plan);

/// Those of `points` that have no finished row, in their order; failed rows are among them.
std::vector<RowPoint> missing_points(const RowRecord& record, const std::vector<RowPoint>& points);

/// The reasons why rows at `points` failed, in their order; other points are left out.
std::vector<std::string> failures_of(const RowRecord& record, const std::vector<RowPoint>& points);

/// Removes the rows of the table whose TablePlan::hash is `hash` from the journals beside
/// `table_path`. The caller must have written the table before. Rows with another hash, which
/// belong to another version of the case, are kept, because only the journal contains them. A
/// journal without such rows is deleted. A journal that another process has locked, or that cannot
/// be opened for writing, is not changed. Throws Error(kBadInput) if a journal cannot be read,
/// replaced or removed.
void remove_journals(const std::filesystem::path& table_path, const std::string& hash);

}  // namespace viscontact::freefem_axi
