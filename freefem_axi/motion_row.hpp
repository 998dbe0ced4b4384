// Force and torque on a sphere that slides or rolls across its axis of symmetry, or spins about it,
// at one gap, by FreeFEM (docs/physics.md, section 2). Lengths, masses and times are in the units
// of the case. If FreeFEM fails, Error(kExternalProgram) is thrown, also for a gap or length that
// its scripts refuse. Used by motion_table_plan.hpp, row_picture.cpp and bench/. A change must
// agree with scripts/row.idp, which solves the row.
#pragma once

#include <vector>

#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::freefem_axi {

/// The motions whose flows have the same matrix and are solved together: the approach along the
/// axis (kAlong), sliding and rolling (kAcross), or spinning (kAround). The numbers are the values
/// of the scripts' argument -motion.
enum class MotionGroup { kAlong = 0, kAcross = 1, kAround = 2 };

/// The motions of the group, in the order in which scripts/row.idp numbers its solutions.
std::vector<lubrication::MotionKind> motions_of(MotionGroup group);

/// True if the neighbour is a sphere outside the other one; its force and torque are computed, too.
/// Throws Error(kBadInput) if there is no geometry with the name tabulation.geometry.
bool neighbour_is_sphere(const Tabulation& tabulation);

/// Solves the motions of a group, kAcross or kAround (not checked), at the gap `gap` [L] > 0 and
/// the velocity 1 [L/T] or angular velocity 1 [1/T] in a FreeFEM process. The rows are in the order
/// of motions_of(). `further_arguments` are added to the command line of FreeFEM. If `output` is
/// not null, it is set to everything that FreeFEM printed. Throws Error(kExternalProgram) if
/// FreeFEM fails or exceeds its time limit, or if the torque of sliding and the force of rolling,
/// which must agree by the reciprocal theorem (Lorentz 1896), differ by more than their error
/// estimates; Error(kBadInput) for an unknown geometry; Error(kInterrupted) if freefem.stop
/// requests a stop.
std::vector<lubrication::MotionRow> solve_motions(
    const FreeFem& freefem, const Tabulation& tabulation, MotionGroup group, double gap,
    const std::vector<std::string>& further_arguments = {}, std::string* output = nullptr);

}  // namespace viscontact::freefem_axi
