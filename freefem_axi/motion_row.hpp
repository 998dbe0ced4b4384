// One row of the motions across the axis or around it, solved by FreeFEM (physics.md, section 2),
// for motion_table_plan.hpp and row_picture.hpp. Lengths, masses and times are in the units of the
// case. A change must agree with scripts/row.idp.
#pragma once

#include <vector>

#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::freefem_axi {

/// The motions that are solved together, because they share a matrix: the approach, sliding and
/// rolling, which is azimuthal mode 1, or spinning, which is swirl.
enum class MotionGroup { kAlong = 0, kAcross = 1, kAround = 2 };

/// The motions of the group, in the order of the solutions of scripts/row.idp.
std::vector<lubrication::MotionKind> motions_of(MotionGroup group);

/// True if the neighbour is a sphere, on which there are force and torque, too.
bool neighbour_is_sphere(const Tabulation& tabulation);

/// Solves the motions of a group, kAcross or kAround, at one gap and the velocity 1 in a FreeFEM
/// process. The rows are in the order of motions_of(). Throws Error(kExternalProgram) with the last
/// lines of FreeFEM if it fails or exceeds its time limit, or if the torque of sliding and the
/// force of rolling differ by more than their error estimates allow: the resistance matrix is
/// symmetric (Lorentz 1896), also if the neighbour moves in proportion to the sphere.
/// `further_arguments` are added to the command line of FreeFEM. If `output` is not null, it is set
/// to everything that FreeFEM printed.
std::vector<lubrication::MotionRow> solve_motions(
    const FreeFem& freefem, const Tabulation& tabulation, MotionGroup group, double gap,
    const std::vector<std::string>& further_arguments = {}, std::string* output = nullptr);

}  // namespace viscontact::freefem_axi
