// The tables of the motions of one sphere as TablePlans. A row's point is { gap [L], velocity [L/T]
// } in the approach and { gap } in the other motions, whose forces and torques are taken as
// proportional to viscosity and velocity. Numbers are in the units of the case. The stage
// `tabulate` uses it.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "viscontact/freefem_axi/journal/table_plan.hpp"
#include "viscontact/freefem_axi/motion_row.hpp"

namespace viscontact::freefem_axi {

/// The groups that contain one of the tabulation's motions.
std::vector<MotionGroup> motion_groups(const Tabulation& tabulation);

/// The group's motions that the tabulation asks for.
std::vector<lubrication::MotionKind> asked_motions(const Tabulation& tabulation, MotionGroup group);

/// The file of the table of a motion.
using TablePath = std::function<std::filesystem::path(lubrication::MotionKind)>;

/// The plan of the group's tables, and their files. The first motion of the tabulation that is in
/// the group is in the file that callers give to the plan, and the other one, if it is asked for,
/// in the plan's companion `path_of(motion)`. Both motions are solved in any case, so that the rows
/// do not depend on which of them is asked for. The rows are in the order of the table: for each
/// velocity, the gaps in the given order.
TablePlan motion_table_plan(const Tabulation& tabulation, MotionGroup group,
                            const TablePath& path_of);

}  // namespace viscontact::freefem_axi
