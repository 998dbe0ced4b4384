// Forces, torques and stresslets on a sphere and its neighbour at one gap, for all their motions
// and for strains, by FreeFEM (docs/physics.md (2.14) to (2.16)), in the units of the case.
#pragma once

#include <cstddef>
#include <vector>

#include "viscontact/freefem_axi/motion_row.hpp"

namespace viscontact::freefem_axi {

/// Loads of the fluid on the bodies. Body 0 is the sphere, 1 its neighbour, which is left out if it
/// is a plane. A source is a body that moves or turns at 1, the other one being at rest, or a
/// strain E that one body alone feels: its surface has the velocity -E.(x - centre), the other one
/// is at rest. Its own stresslet is Batchelor's, (20/3) pi mu r^3 E of a sphere alone. A uniform
/// strain is the sum for both bodies, if both move with the undisturbed flow at their centres
/// without turning.
///
/// z is the axis from the neighbour to the sphere, x across it. F, T and S are the force, the
/// torque about the centre, and the stresslet. The groups have
///   kAlong    F_z, S_zz and the trace, for U_z and the strain E = zz - 1/3
///   kAcross   F_x, T_y, S_xz, for U_x, W_y and E = xz + zx
///   kAround   T_z, for W_z
///   kTwofold  S_xx = -S_yy, for E = xx - yy
struct PairLoads {
  MotionGroup group = MotionGroup::kAlong;
  std::size_t bodies = 1;
  /// 3 and 2, 3 and 3, 1 and 1, 1 and 1.
  std::size_t loads_of_body = 1, sources_of_body = 1;
  /// Indexed by place(). Errors are estimates in the unit of the load; two loads that are equal by the
  /// reciprocal theorem have the larger one of their estimates. The trace of the traction's
  /// moment is NaN in a container, where the pressure has an arbitrary constant.
  std::vector<double> loads, errors;
  /// Of each source (of_body * sources_of_body + source): the order of convergence of its own load,
  /// 0 if it was not observed.
  std::vector<double> observed_orders;
  /// The largest error over the size sqrt(R_ii R_jj) that solve_pair_loads() names.
  double largest_relative_error = 0;
  /// The largest |R_ij - R_ji| over sqrt(R_ii R_jj), which is part of `errors`.
  double asymmetry = 0;
  /// The largest difference over sqrt(R_ii R_jj) between a load, but for the traces, and the
  /// boundary integral of the traction, both on the finest mesh.
  double traction_mismatch = 0;
  double degrees_of_freedom = 0, seconds = 0;

  std::size_t place(std::size_t body, std::size_t load, std::size_t of_body,
                    std::size_t source) const;
};

/// Solves the group at the gap `gap` [L] > 0 in a FreeFEM process. The geometry must be one that
/// has strains; velocity_ratio and rotation_ratio are not used. Errors are at most
/// relative_accuracy times sqrt(R_ii R_jj), where R_ii is the load i by the source i of the same
/// body (for the strains without the ambient stress), unless FreeFEM cannot reach that. Throws
/// Error(kBadInput) if the geometry has no strains, Error(kExternalProgram) if FreeFEM fails or if
/// loads contradict the reciprocal theorem by more than rounding, and Error(kInterrupted) at a
/// stop.
///
/// The discrete flows obey the theorem up to rounding, because loads are residuals of a symmetric
/// matrix: the asymmetry tells the error of the solver, and nothing of the meshes. The boundary
/// integral of the traction obeys the theorem only as far as the meshes are right: the load i by
/// source j from the traction must be the load j by source i from the residual. FreeFEM fails if
/// they differ by more than row.idp allows.
PairLoads solve_pair_loads(const FreeFem& freefem, const Tabulation& tabulation, MotionGroup group,
                           double gap);

/// The motions of a group that has strains, in the order of the sources of a body.
std::vector<lubrication::MotionKind> motions_with_strains(MotionGroup group);

/// A row with stresslets at velocity 1 or rate 1 for each motion of motions_with_strains(): the sum
/// of the loads by the sphere's motion and by that of the neighbour, times neighbour_ratio(). A
/// strain is felt by the sphere alone.
std::vector<lubrication::MotionRow> rows_of(const Tabulation& tabulation, const PairLoads& loads,
                                            double gap);

}  // namespace viscontact::freefem_axi
