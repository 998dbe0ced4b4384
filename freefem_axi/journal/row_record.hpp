// The finished and failed rows of a table, collected from its file and from its journals, the files
// in which processes store the rows that they have finished (row_journal.hpp). Numbers have the
// units of the table. A journal that cannot be read or removed throws Error(kBadInput); damaged
// lines count as no rows. Used by tabulate.cpp, pipeline/ and the Python module. A change must keep
// that the journals are read before the table: another process may write the table and then remove
// the journals, and rows that are in neither at the time of reading would be lost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/journal/table_plan.hpp"

namespace viscontact::freefem_axi {

/// The finished and failed rows of the planned table at `table_path`, from its journals and the
/// table. A table of other inputs and damaged lines count as no rows, and so do files that do not
/// exist. Among several failures at a point the last one read counts. Throws Error(kBadInput) if a
/// journal exists but cannot be read.
RowRecord read_row_record(const std::filesystem::path& table_path, const TablePlan& plan);

/// The entries of `points` whose rows are not finished (failed ones included), in the order of
/// `points`.
std::vector<RowPoint> missing_points(const RowRecord& record, const std::vector<RowPoint>& points);

/// The reasons why rows at `points` failed, in the order of `points`; points without a failed row
/// are left out.
std::vector<std::string> failures_of(const RowRecord& record, const std::vector<RowPoint>& points);

/// Removes the rows of the table with TablePlan::hash `hash` from the journals beside `table_path`.
/// The caller has written the table before. Rows with another hash, of a case that was edited
/// meanwhile, stay, because only the journal contains them; a journal without such rows is deleted.
/// A journal that another process has locked, or that cannot be opened for writing, is not changed.
/// Throws Error(kBadInput) if a journal cannot be read, replaced or removed.
void remove_journals(const std::filesystem::path& table_path, const std::string& hash);

}  // namespace viscontact::freefem_axi
