// Computes force and torque on a sphere at one gap by FreeFEM (docs/physics.md, section 2). The
// sphere slides or rolls across its axis of symmetry, or spins about it. Lengths [L], masses [M]
// and times [T] are in the units of the case. Error(kExternalProgram) says that FreeFEM failed,
// also because its scripts refuse a gap or length. motion_table_plan.hpp, row_picture.cpp and
// bench/ use this file. A change must agree with scripts/row.idp, which solves the row: in the
// numbers of MotionGroup and the order of motions_of().
#pragma once

#include <vector>

#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::freefem_axi {

/// The motions whose flows have the same matrix and are solved together: the approach along the
/// axis (kAlong), sliding and rolling (kAcross), or spinning (kAround). The numbers are the values
/// of the scripts' argument -motion.
enum class MotionGroup { kAlong = 0, kAcross = 1, kAround = 2 };

/// The motions of the group, one or two, in the order in which scripts/row.idp numbers its
/// solutions.
std::vector<lubrication::MotionKind> motions_of(MotionGroup group);

/// True if the neighbour, the body beside the sphere, is a sphere outside it; force and torque on
/// the neighbour are computed then, too. Throws Error(kBadInput) if there is no geometry with the
/// name tabulation.geometry. That tabulation.geometry_parameters are complete is not checked.
bool neighbour_is_sphere(const Tabulation& tabulation);

/// Solves the motions of a group, kAcross or kAround (not checked), at the gap `gap` [L] > 0 and
/// the velocity 1 [L/T] or angular velocity 1 [1/T] in a FreeFEM process. Returns a row for each
/// motion, in the order of motions_of(), with forces [M L/T^2] and torques [M L^2/T^2].
/// `further_arguments` are added to the command line of FreeFEM. If `output` is not null, it is set
/// to everything that FreeFEM printed. Throws Error(kExternalProgram) if FreeFEM fails or exceeds
/// its time limit. It throws this error also if the torque of sliding and the force of rolling
/// differ by more than their error estimates, because they must agree by the reciprocal theorem
/// (Lorentz 1896). Throws Error(kBadInput) for an unknown geometry, std::out_of_range if
/// geometry_parameters are missing, and Error(kInterrupted) if freefem.stop requests a stop.
std::vector<lubrication::MotionRow> solve_motions(
    const FreeFem& freefem, const Tabulation& tabulation, MotionGroup group, double gap,
    const std::vector<std::string>& further_arguments = {}, std::string* output = nullptr);

}  // namespace viscontact::freefem_axi
