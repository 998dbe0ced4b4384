// The stroke of least energy for a given displacement (Alouges, DeSimone & Lefebvre 2008): among
// the loops through a given shape with this displacement, the one with the least energy in a given
// period. Its power is constant. Lengths, masses and times are in the units of the fit. The
// commands `swimmer` and `sweep` use it; energies must stay those of docs/swimmer.md.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/swimmer/polynomial_loop.hpp"

namespace viscontact::swimmer {

/// The conditions for the optimal stroke.
struct OptimalStrokeRequest {
  double displacement = 0;        ///< [L], not 0
  Eigen::VectorXd through;        ///< the shape at which the stroke begins and ends [L]
  Eigen::Index polynomials = 20;  ///< of each arm (PolynomialLoop), at least kFewestPolynomials
};

/// The fewest polynomials of an arm, with which the search for the optimal stroke begins.
inline constexpr Eigen::Index kFewestPolynomials = 4;

/// A result with some number of polynomials, from which the convergence can be judged.
struct OptimalStrokeStep {
  Eigen::Index polynomials = 0;        ///< of each arm
  double energy = 0;                   ///< at a period of 1 [M L^2/T^2]
  double euler_lagrange_residual = 0;  ///< [1], polynomial_loop.hpp
};

/// The loop of least energy for a displacement, and how it was found.
struct OptimalStroke {
  /// The shapes of the stroke.
  PolynomialLoop loop;
  /// Derivative of the least energy by the displacement at a period of 1 [M L/T^2].
  double multiplier = 0;
  /// The results with rising numbers of polynomials; the last one is that of `loop`.
  std::vector<OptimalStrokeStep> convergence;
};

/// Finds a loop of least energy. Newton's method on the conditions of Karush, Kuhn and Tucker
/// starts from small loops in four directions, whose displacement then grows to the wanted one; of
/// the four results the one with the least energy is returned. Throws Error(kBadInput) if every
/// such loop leaves the table, Error(kNotConverged) if Newton's method fails, and
/// Error(kInterrupted) if `stop` requests a stop.
OptimalStroke find_optimal_stroke(const Swimmer& swimmer, const OptimalStrokeRequest& request,
                                  const StopToken& stop);

}  // namespace viscontact::swimmer
