// Two independent methods for rigid discs in plane Stokes flow, which give the exact values of
// data/reference/discs_*.csv: collocation with Goursat's functions, and a boundary integral.
#pragma once

#include <complex>
#include <vector>

namespace viscontact {

/// What encloses the discs, with its centre at 0. The fluid does not slip on walls.
enum class DiscDomain2d {
  kRoundContainer,  ///< |z| < size
  kChannel,         ///< walls at y = +-size/2, periodic along x with the period `length`
  kSquareCell,      ///< periodic both ways with the period `size`; one disc at 0
};

/// A point or vector (x, y) is the complex number x + i y. The viscosity is 1; forces and torques
/// are per unit length. Length, force and time are in any units.
struct DiscProblem {
  struct Disc {
    std::complex<double> centre;
    double radius = 1;
    std::complex<double> force;
    double torque = 0;  ///< counter-clockwise > 0
  };
  DiscDomain2d domain = DiscDomain2d::kRoundContainer;
  double size = 1;    ///< > 0
  double length = 0;  ///< > 0 in a channel; not used elsewhere
  std::vector<Disc> discs;
  /// The velocity at the place z of the walls, or the mean velocity of a cell, is
  /// strain conj(z) + i rotation z. With strain = i/2 and rotation = -1/2 this is the shear flow
  /// (y, 0), with 1 and 0 the strain (x, -y).
  std::complex<double> strain = 0;
  double rotation = 0;
};

struct DiscAnswer {
  std::vector<std::complex<double>> velocities;
  std::vector<double> spins;  ///< angular velocities, counter-clockwise > 0
  /// If there is a strain, and the discs are free of forces and torques: the dissipation divided by
  /// that of the fluid without discs, minus 1. Otherwise 0.
  double added_dissipation = 0;
  double residual = 0;  ///< of collocation: largest error of the velocity at a boundary
};

/// The velocity is a sum of poles within each disc (and its periodic images) and of functions that
/// are regular in the domain. Their coefficients are fitted by least squares to the velocities on
/// all boundaries, in a square cell also to the periodicity of velocity and traction. `poles` is
/// the highest power of the poles of each disc, `regular` that of the regular functions.
///
/// In a channel the mean flow along it is 0. In a cell the mean velocity of fluid and discs is 0,
/// and a uniform pressure gradient balances the force.
DiscAnswer discs_by_collocation(const DiscProblem& problem, int poles, int regular);

/// Completed double layer (Power & Miranda 1987, SIAM J. Appl. Math. 47, 689) with the trapezoidal
/// rule, with `nodes` nodes on each disc and `wall_nodes` on the container or on each wall. The
/// kernels are summed over all periodic images. The answer has the same meaning as that of
/// discs_by_collocation(), with which this function shares no code.
DiscAnswer discs_by_boundary_integral(const DiscProblem& problem, int nodes, int wall_nodes);

}  // namespace viscontact
