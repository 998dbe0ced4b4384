// Newton's method on the set of active contacts, for the dual problem (5.4) of docs/physics.md,
// scaled as in contact_graph.hpp.
#pragma once

#include "viscontact/particles/projection/contact_graph.hpp"
#include "viscontact/particles/projection/projection.hpp"

namespace viscontact::particles {

/// The primal-dual active set method (Hintermueller, Ito & Kunisch 2003, "The primal-dual active
/// set strategy as a semismooth Newton method"). With g the gradient, each iteration takes the
/// contacts with z - g >= bound into a set, and also those that miss this condition by no more than
/// their allowed residual. In the paper these contacts are called active, because their gaps are 0;
/// their z is free. A factor of W gives the impulses at which g = 0 in this set; the other contacts
/// stay at their bounds. The method ends when all residuals are allowed. A chain of any length
/// takes a few iterations.
///
/// The method converges fast near the solution and may cycle far from it. It stops after
/// `max_iterations` factorisations. If it has not converged then, or if W is singular or has no
/// cheap factor, graph.z is what it was before the call, and the residual returned is infinite.
template <int D>
SolverResult active_set_newton(ContactGraph<D>& graph, int max_iterations);

}  // namespace viscontact::particles
