// The tables of sliding, rolling and spinning as TablePlans (journal/table_plan.hpp), for the stage
// `tabulate`. A row's point is { gap [L] }, because forces and torques are proportional to
// viscosity and velocity. Lengths, masses and times are in the units of the case. A change must
// keep journals of interrupted tabulations readable.
#pragma once

#include <filesystem>
#include <vector>

#include "viscontact/freefem_axi/journal/table_plan.hpp"
#include "viscontact/freefem_axi/motion_row.hpp"

namespace viscontact::motions {

/// The groups that contain one of the tabulation's motions.
std::vector<freefem_axi::MotionGroup> motion_groups(const freefem_axi::Tabulation& tabulation);

/// The file of the table of a motion.
using TablePath = std::function<std::filesystem::path(lubrication::MotionKind)>;

/// The plan of the group's tables, and their files. The first motion of the tabulation that is in
/// the group is in the file `path_of(motion)` that callers give to the plan, and the other one, if
/// it is asked for, in the plan's companion. Both motions are solved in any case, so that the rows
/// do not depend on which of them is asked for.
freefem_axi::TablePlan motion_table_plan(const freefem_axi::Tabulation& tabulation,
                                         freefem_axi::MotionGroup group, const TablePath& path_of);

/// The group's motions that the tabulation asks for.
std::vector<lubrication::MotionKind> asked_motions(const freefem_axi::Tabulation& tabulation,
                                                   freefem_axi::MotionGroup group);

}  // namespace viscontact::motions
