// The method that solves the projection of a time step.
#pragma once

#include "viscontact/particles/projection/active_set_factor.hpp"
#include "viscontact/particles/projection/contact_graph.hpp"

namespace viscontact::particles {

/// What the method reached.
struct SolverResult {
  int iterations = 0;
  double residual = 0;  ///< largest ContactGraph::residual; the contacts have converged if <= 1
};

/// Projected conjugate gradients (MPRGP: Dostal & Schoeberl 2005, "Minimizing quadratic functions
/// subject to bound constraints with the rate of convergence and finite termination"): conjugate
/// gradients, preconditioned by symmetric Gauss-Seidel, while the set of active contacts stays, and
/// projected steps where it changes. If that does not converge soon and a sparse factor of W is
/// cheap, active_set_newton.hpp finishes it.
///
/// Improves graph.z from its guess until each contact's residual is at most what is allowed of it, or
/// the iterations are used up. Impulses of redundant contacts, of which the velocities determine only
/// sums, depend on the guess. `factor` is that of earlier solves on the same graph, perhaps with fewer
/// contacts; it is used and replaced.
template <int D>
SolverResult conjugate_gradients(ContactGraph<D>& graph, int max_iterations,
                                 ActiveSetFactor<D>& factor);

}  // namespace viscontact::particles
