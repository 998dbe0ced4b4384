// The resistances of two spheres, or of a sphere beside a plane, in unbounded Stokes flow to all
// motions and strains, for any gap (docs/physics.md (2.14) to (2.16)).
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace viscontact::lubrication {

/// The components of a sphere, in this order, in axes x, y, z of which z goes from sphere 1 to
/// sphere 2: the velocity (3), the angular velocity (3), each less that of the undisturbed flow at
/// the centre, and the strain rate E of this flow (5), which has no trace:
///   E = e_1 (zz - 1/3) sqrt(3/2)
///     + (e_2 (xz + zx) + e_3 (yz + zy) + e_4 (xx - yy) + e_5 (xy + yx))/sqrt(2),
/// so that E:E is the sum of the squares. Loads have the same order: the force and the torque about
/// the centre of the sphere on the fluid, and Batchelor's stresslet S in the same basis.
inline constexpr std::size_t kSphereComponents = 11, kPairComponents = 2 * kSphereComponents;

/// Row-major, symmetric: loads = matrix * components, the rows and columns of sphere 1 first.
using PairMatrix = std::array<double, kPairComponents * kPairComponents>;

/// Of the radii of two spheres.
inline constexpr double kLargestRadiusRatio = 1e9;

enum class PairForm {
  kComplete,  ///< the matrix K of all loads; positive definite, but for a plane's rows of 0
  /// K - K N (N^T K N)^-1 N^T K, where N are the six rigid motions of the pair: a rigid motion has
  /// no loads, and the forces of the pair and their torques, F_1 + F_2 and T_1 + T_2 + (x_2 - x_1)
  /// x F_2, add up to 0, both to rounding errors. These are the loads of a pair on which no net
  /// force and torque act. Positive semi-definite; the null space are the rigid motions. Of a sphere
  /// and a plane it is K.
  kBalanced,
};

/// What is left after the terms 1/q, ln q and q ln q of lubrication theory, whose coefficients are
/// known for every ratio of the radii (Jeffrey & Onishi 1984; Jeffrey 1992), is interpolated by
/// Chebyshev polynomials between exact solutions, up to the ratio 100 of the radii. A smaller sphere
/// has the loads of a linear flow, which is that of the larger one alone. Largest errors at any gap:
///
///   ratio of the radii     up to 10   up to 100   above     plane
///   entries of one sphere  3e-6       3e-5        5e-4      4e-6
///   entries of both        3e-6       5e-4        2e-3
///
/// Those of an entry R_ij of one sphere are over sqrt(R_ii R_jj). Those of a component i of the
/// smaller sphere, of radius r, and j of the larger one are over sqrt(6 pi mu r R_ii) v, where v is
/// the velocity of the larger sphere's surface: 1 for a velocity, and its radius for a turn or a
/// strain. Far away these entries are small: for ratios from 10 to 100, at gaps of ten times the
/// larger radius, the force on the small sphere by a turn of the large one is wrong by up to 2 %.
///
/// One radius may be infinite, which is a plane at rest, whose rows and columns are 0.
///
/// Lengths are in one unit [L], the viscosity in [M/(L T)]. Exchanged spheres give the same numbers
/// in exchanged places. Throws Error(kBadInput) unless radii, gap and viscosity are positive and
/// finite, but for one radius, and the radii are within kLargestRadiusRatio.
PairMatrix pair_resistance(double radius1, double radius2, double gap, double viscosity,
                           PairForm form = PairForm::kComplete);

/// For each pair i of spheres with the radii radius1[i] and radius2[i]; `matrices` has room for as
/// many matrices, one after the other. All spans must have equally many pairs.
void pair_resistances(std::span<const double> radius1, std::span<const double> radius2,
                      std::span<const double> gap, double viscosity, std::span<double> matrices,
                      PairForm form = PairForm::kComplete);

}  // namespace viscontact::lubrication
