// Force and torque on a sphere at one gap that slides, rolls or spins, by FreeFEM (docs/physics.md
// (2.6) to (2.8)). Numbers are in the units of the case.
#pragma once

#include <vector>

#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::freefem_axi {

/// The motions whose flows have the same matrix and are solved together: the approach along the
/// axis (kAlong), sliding and rolling (kAcross), or spinning (kAround). Each has a strain besides
/// (pair_loads.hpp), but spinning, and kTwofold has a strain only. The numbers are the values of
/// the argument -motion of scripts/row.idp.
enum class MotionGroup { kAlong = 0, kAcross = 1, kAround = 2, kTwofold = 3 };

/// The motions of the group without strains, in the order in which scripts/row.idp numbers its
/// solutions.
std::vector<lubrication::MotionKind> motions_of(MotionGroup group);

/// True if the neighbour, the body beside the sphere, is a sphere outside it; force and torque on
/// the neighbour are computed then, too. Throws Error(kBadInput) for an unknown geometry.
bool neighbour_is_sphere(const Tabulation& tabulation);

/// Solves the motions of kAcross or kAround at the gap `gap` [L] > 0 and the velocity 1 [L/T] or
/// angular velocity 1 [1/T] in a FreeFEM process. Returns a row for each motion, in the order of
/// motions_of(), with forces [M L/T^2] and torques [M L^2/T^2]. `further_arguments` are added to
/// the command line of FreeFEM. If `output` is not null, it is set to everything that FreeFEM
/// printed. Throws Error(kExternalProgram) if FreeFEM fails, also because its scripts refuse a
/// number, or exceeds its time limit, and if the torque of sliding and the force of rolling differ
/// by more than their error estimates, because they must agree by the reciprocal theorem (Lorentz
/// 1896). Throws Error(kBadInput) for an unknown geometry, std::out_of_range if geometry_parameters
/// are missing, and Error(kInterrupted) at a stop.
std::vector<lubrication::MotionRow> solve_motions(
    const FreeFem& freefem, const Tabulation& tabulation, MotionGroup group, double gap,
    const std::vector<std::string>& further_arguments = {}, std::string* output = nullptr);

}  // namespace viscontact::freefem_axi
