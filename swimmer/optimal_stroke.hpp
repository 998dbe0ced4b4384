// The stroke of least energy for a given displacement (Alouges, DeSimone & Lefebvre 2008,
// docs/physics.md (7.7)).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/swimmer/polynomial_loop.hpp"

namespace viscontact::swimmer {

/// The conditions for the optimal stroke, which is the closed loop of least energy in a given
/// period among those through a given shape with a given displacement. Its power is constant.
struct OptimalStrokeRequest {
  double displacement = 0;  ///< displacement in a period [L], not 0; > 0 towards the last sphere
  /// The shape at which the stroke begins and ends [L], a number for each arm, at least two.
  Eigen::VectorXd through;
  /// Number of polynomials of each arm (PolynomialLoop), at least kFewestPolynomials. The more
  /// there are, the closer the loop is to the optimal one, and the longer the search takes.
  Eigen::Index polynomials = 20;
};

/// The smallest number of polynomials of an arm; the search for the optimal stroke begins with it.
inline constexpr Eigen::Index kFewestPolynomials = 4;

/// The result of the search with one number of polynomials.
struct OptimalStrokeStep {
  Eigen::Index polynomials = 0;
  double energy = 0;                   ///< energy in a period of 1 [M L^2/T^2], > 0
  double euler_lagrange_residual = 0;  ///< result of euler_lagrange_residual() [1], >= 0
};

/// The loop of least energy for a displacement, and how it was found.
struct OptimalStroke {
  PolynomialLoop loop;
  /// Derivative of the least energy by the displacement, in a period of 1 [M L/T^2], of any sign.
  double multiplier = 0;
  /// The results with rising numbers of polynomials, up to OptimalStrokeRequest::polynomials,
  /// without those for which Newton's method failed. The last one is that of `loop`.
  std::vector<OptimalStrokeStep> convergence;
};

/// Finds a loop of least energy. Newton's method solves the conditions of Karush, Kuhn and Tucker.
/// It starts from four small loops, which lie in four directions from the given shape. The
/// displacement of each loop is then raised step by step to the wanted one. The loop with the least
/// energy of the four is improved with more polynomials. Throws Error(kBadInput) if the table does
/// not contain the given shape or if none of the four loops reaches the displacement within the
/// table, Error(kNotConverged) if Newton's method fails with `request.polynomials`, and
/// Error(kInterrupted) if `stop` requests a stop.
OptimalStroke find_optimal_stroke(const Swimmer& swimmer, const OptimalStrokeRequest& request,
                                  const StopToken& stop);

}  // namespace viscontact::swimmer
