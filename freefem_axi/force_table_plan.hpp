// The table of the lubrication force on one sphere as a TablePlan (journal/table_plan.hpp), for the
// stage `tabulate`. A row's point is { gap [L], velocity [L/T] }. Lengths, masses and times are in
// the units of the case. A change must keep journals of interrupted tabulations readable.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "viscontact/freefem_axi/journal/table_plan.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {

/// The rows are in the order of the table: for each velocity, the gaps in the given order.
TablePlan force_table_plan(const Tabulation& tabulation);

/// A row of the table as the journal stores it.
FinishedRow finished_row(const lubrication::ForceTableRow& row, const std::string& freefem_version);
/// The row of the table that the journal has stored: the inverse of finished_row().
lubrication::ForceTableRow force_row(const FinishedRow& finished);

/// The table of the finished rows. It names the failed ones.
lubrication::ForceTable assemble_table(const Tabulation& tabulation, const RowRecord& record);

}  // namespace viscontact::freefem_axi
