// Plans of the tables of force and torque on one sphere that approaches its neighbour, slides,
// rolls or spins. A row of the approach is computed for each gap [L] and velocity [L/T]; a row of
// another motion for each gap only, because force and torque are proportional to the velocity.
// Numbers are in the units of the case. An unknown geometry throws Error(kBadInput). Gaps and
// velocities are not checked here. Used by pipeline/tabulate/. A change must keep the order of the
// rows and that the numbers in a table do not depend on which other tables are made with it.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "viscontact/freefem_axi/journal/table_plan.hpp"
#include "viscontact/freefem_axi/motion_row.hpp"

namespace viscontact::freefem_axi {

/// The groups that contain at least one of tabulation.motions, in the order of MotionGroup.
std::vector<MotionGroup> motion_groups(const Tabulation& tabulation);

/// The motions of the group that are among tabulation.motions, in the order of motions_of().
std::vector<lubrication::MotionKind> asked_motions(const Tabulation& tabulation, MotionGroup group);

/// A function that returns the path of the table of a motion.
using TablePath = std::function<std::filesystem::path(lubrication::MotionKind)>;

/// The plan of the tables of a group that has at least one of tabulation.motions. Slide and roll
/// form one group and are both solved, even if one table only is asked for. The plan itself writes
/// the table of the first asked motion, to the path that the caller passes on; the other table, if
/// asked for, is its companion at `path_of(motion)`. A table has for each velocity all gaps, both
/// in the given order. Throws Error(kBadInput) for an unknown geometry. TablePlan::solve throws the
/// errors of solve_row() or solve_motions(). That a motion of the group is asked for is not
/// checked.
TablePlan motion_table_plan(const Tabulation& tabulation, MotionGroup group,
                            const TablePath& path_of);

}  // namespace viscontact::freefem_axi
