// The method that solves the projection (5.4) of a time step. Impulses and residuals are scaled as
// contact_graph.hpp says.
#pragma once

#include "viscontact/particles/projection/active_set_factor.hpp"
#include "viscontact/particles/projection/contact_graph.hpp"

namespace viscontact::particles {

/// What the method returns.
struct SolverResult {
  int iterations = 0;
  /// Largest ContactGraph::residual. All contacts have converged if it is at most 1.
  double residual = 0;
};

/// Modified proportioning with reduced gradient projections, MPRGP (Dostal & Schoeberl 2005,
/// "Minimizing quadratic functions subject to bound constraints with the rate of convergence and
/// finite termination"). While the set of active contacts stays the same, it makes conjugate
/// gradient steps, preconditioned by symmetric Gauss-Seidel; where the set changes, projected
/// gradient steps. If these do not converge soon and a sparse factor of W is cheap, the factor
/// becomes the preconditioner (active_set_factor.hpp). Newton's method (active_set_newton.hpp)
/// solves chains of contacts and helps if all else takes long.
///
/// Improves graph.z, which begins as a guess, until all residuals are at most 1 or `max_iterations`
/// are done. Redundant contacts have impulses of which the velocities determine only sums; their
/// values depend on the guess. `factor` belongs to earlier solves of the same step, whose graph may
/// have had fewer contacts. It is used and replaced.
template <int D>
SolverResult conjugate_gradients(ContactGraph<D>& graph, int max_iterations,
                                 ActiveSetFactor<D>& factor);

}  // namespace viscontact::particles
