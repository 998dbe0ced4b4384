// Plans of the tables of one sphere that approaches its neighbour, slides, rolls, spins or feels a
// strain. The numbers of a table depend on which others are made with it by their errors only.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "viscontact/freefem_axi/journal/table_plan.hpp"
#include "viscontact/freefem_axi/motion_row.hpp"

namespace viscontact::freefem_axi {

/// Time of a row of this relative accuracy over that of a row for which the coarsest meshes
/// suffice; infinite for 0.
double time_factor(double relative_accuracy);

/// The groups with at least one of tabulation.motions, in the order of MotionGroup.
std::vector<MotionGroup> motion_groups(const Tabulation& tabulation);

/// The motions of the group that are among tabulation.motions, in the order of MotionKind.
std::vector<lubrication::MotionKind> asked_motions(const Tabulation& tabulation, MotionGroup group);

/// The path of the table of a motion.
using TablePath = std::function<std::filesystem::path(lubrication::MotionKind)>;

/// The plan of the tables of a group that has at least one of tabulation.motions. Slide and roll
/// form one group and are both solved, even if only one of their tables is asked for. If a strain
/// is asked for, solve_pair_loads() makes all tables, and they have stresslets. The plan itself
/// writes the table of the first asked motion, to the path that its caller gives. If tables of
/// other motions are asked for, they are companions of the plan, with the paths `path_of(motion)`.
/// A table has for each velocity all gaps, both in the order of `tabulation`. A point is a gap and
/// a velocity for the approach without strains; otherwise it is a gap alone, because loads are
/// proportional to the velocity. Throws Error(kBadInput) for an unknown
/// geometry, and std::out_of_range if geometry_parameters are missing. TablePlan::solve throws
/// Error(kExternalProgram) if FreeFEM fails, Error(kBadInput) if a double cannot hold the force of
/// an approach without strains, and Error(kInterrupted) at a stop.
TablePlan motion_table_plan(const Tabulation& tabulation, MotionGroup group,
                            const TablePath& path_of);

}  // namespace viscontact::freefem_axi
