// Two independent methods for rigid discs in plane Stokes flow, which give the exact values of
// data/reference/discs_*.csv: collocation with Goursat's functions, and a boundary integral.
#pragma once

#include <complex>
#include <vector>

namespace viscontact {

/// What encloses the discs, with its centre at 0. The fluid does not slip.
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
  /// The walls, or the cell in the mean, move at strain conj(z) + i rotation z. (i/2, -1/2) is the
  /// shear flow (y, 0), (1, 0) the strain (x, -y).
  std::complex<double> strain = 0;
  double rotation = 0;
};

struct DiscAnswer {
  std::vector<std::complex<double>> velocities;
  std::vector<double> spins;  ///< angular velocities, counter-clockwise > 0
  /// Dissipation over that of the fluid alone, if there is a strain, less 1. Discs must be free of
  /// forces and torques. Else 0.
  double added_dissipation = 0;
  double residual = 0;  ///< of collocation: largest error of the velocity at a boundary
};

/// Sums of poles within each disc (and its periodic images) and of functions that are regular in
/// the domain; their coefficients are fitted by least squares to the velocities on all boundaries,
/// in a square cell also to the periodicity of velocity and traction. `poles` is the highest power
/// of each disc, `regular` that of the domain.
///
/// In a channel no fluid passes through in the mean. In a cell the mean velocity of fluid and discs
/// is 0, and a uniform pressure gradient balances the force.
DiscAnswer discs_by_collocation(const DiscProblem& problem, int poles, int regular);

/// Completed double layer (Power & Miranda 1987, SIAM J. Appl. Math. 47, 689) with the trapezoidal
/// rule, `nodes` of them on each disc and `wall_nodes` on the container or each wall. The kernels
/// are summed over all periodic images. Same meaning of the answer as above; shares no code with
/// it.
DiscAnswer discs_by_boundary_integral(const DiscProblem& problem, int nodes, int wall_nodes);

}  // namespace viscontact
