// Newton's method on the set of active contacts of a projection.
#pragma once

#include "viscontact/particles/projection/contact_graph.hpp"
#include "viscontact/particles/projection/projection.hpp"

namespace viscontact::particles {

/// The primal-dual active set method (Hintermueller, Ito & Kunisch 2003, "The primal-dual active set
/// strategy as a semismooth Newton method"): the contacts with z - g >= bound, g the gradient, are
/// taken for active, and those that miss this by no more than the residual that is allowed of them; a factor of W gives their impulses with g = 0, the others stay at their bounds;
/// repeated until the set is the same. A chain of any length takes a few iterations.
///
/// It converges fast near the solution and may cycle far from it: stops after `max_iterations`
/// factorisations, and then, or if W is singular or cannot be factorised cheaply, leaves graph.z as
/// it was. The residual returned is that of graph.z if it converged, above 1 otherwise.
template <int D>
SolverResult active_set_newton(ContactGraph<D>& graph, int max_iterations);

}  // namespace viscontact::particles
