// Newton's method on the set of active contacts, for the dual problem (5.4) of docs/physics.md,
// scaled as in contact_graph.hpp.
#pragma once

#include "viscontact/particles/dual_problem/contact_graph.hpp"
#include "viscontact/particles/dual_problem/dual_solver.hpp"

namespace viscontact::particles {

/// The primal-dual active set method (Hintermueller, Ito & Kunisch 2003, "The primal-dual active
/// set strategy as a semismooth Newton method"). With g the gradient, each iteration takes the
/// contacts with z - g < bound as active, except those that meet this condition by no more than
/// their allowed residual. Active contacts are set to their bounds. A factor of W gives the
/// impulses at which g = 0 at all others, the free contacts. The method ends when all residuals are
/// allowed. A chain of any length takes a few iterations.
///
/// The method converges fast near the solution and may cycle far from it. It stops after
/// `max_iterations` factorisations. If it has not converged then, or if W is singular or has no
/// cheap factor, graph.z is what it was before the call, and the returned residual is infinite.
template <int D>
SolverResult active_set_newton(ContactGraph<D>& graph, int max_iterations);

}  // namespace viscontact::particles
