// The stroke of least energy of a swimmer for a given displacement (Alouges, DeSimone & Lefebvre
// 2008). A swimmer is a line of spheres; its shape is the list of its arms, the distances between
// the centres of neighbours; a stroke is a closed loop of shapes. Among the loops through a given
// shape with this displacement, the optimal one has the least energy in a given period. Its power
// is constant. Lengths, masses and times are in the units of the swimmer's fit. swimmer/case and
// swimmer/job use it. A search that leaves the table throws Error(kBadInput), one that does not
// converge Error(kNotConverged), a stop Error(kInterrupted). A change must keep energies to the
// digits of docs/swimmer.md.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/swimmer/polynomial_loop.hpp"

namespace viscontact::swimmer {

/// The conditions for the optimal stroke.
struct OptimalStrokeRequest {
  double displacement = 0;  ///< displacement in a period [L], not 0; > 0 towards the last sphere
  /// The shape at which the stroke begins and ends [L], a number for each arm, at least two.
  Eigen::VectorXd through;
  /// Number of polynomials of each arm (PolynomialLoop), at least kFewestPolynomials.
  Eigen::Index polynomials = 20;
};

/// The smallest number of polynomials of an arm; the search for the optimal stroke begins with it.
inline constexpr Eigen::Index kFewestPolynomials = 4;

/// The result of the search with some number of polynomials, from which the convergence can be
/// judged.
struct OptimalStrokeStep {
  Eigen::Index polynomials = 0;        ///< number of polynomials of each arm
  double energy = 0;                   ///< energy in a period of 1 [M L^2/T^2], > 0
  double euler_lagrange_residual = 0;  ///< [1], >= 0; euler_lagrange_residual()
};

/// The loop of least energy for a displacement, and how it was found.
struct OptimalStroke {
  /// The shapes of the stroke.
  PolynomialLoop loop;
  /// Derivative of the least energy by the displacement, in a period of 1 [M L/T^2], of any sign.
  double multiplier = 0;
  /// The results with rising numbers of polynomials, without those for which Newton's method
  /// failed; the last one is that of `loop`.
  std::vector<OptimalStrokeStep> convergence;
};

/// Finds a loop of least energy. Newton's method solves the conditions of Karush, Kuhn and Tucker.
/// The method starts from four small loops, which lie in four directions from the given shape. The
/// displacement of each loop is then raised step by step to the wanted one. The loop with the least
/// energy of the four is improved with more polynomials. Throws Error(kBadInput) if all four loops
/// leave the table, Error(kNotConverged) if Newton's method fails with `request.polynomials`, and
/// Error(kInterrupted) if `stop` requests a stop. The members of `request` are not checked.
OptimalStroke find_optimal_stroke(const Swimmer& swimmer, const OptimalStrokeRequest& request,
                                  const StopToken& stop);

}  // namespace viscontact::swimmer
