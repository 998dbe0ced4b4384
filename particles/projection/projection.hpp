// The methods that solve the projection of a time step.
#pragma once

#include <array>
#include <string_view>

#include "viscontact/particles/projection/active_set_factor.hpp"
#include "viscontact/particles/projection/contact_graph.hpp"

namespace viscontact::particles {

struct SolverSettings {
  double tolerance = 1e-6;  ///< of the gaps, over the mean radius; > 0
  /// Of each contact's impulse, over the impulses at work on its particles in the step; > 0.
  double impulse_tolerance = 1e-10;
  int max_iterations = 10000;  ///< of a step, >= 1: products with W, sweeps, or factorisations
  std::string_view method = "conjugate_gradients";  ///< a name in kSolverMethods
};

/// What a method reached.
struct SolverResult {
  int iterations = 0;
  double residual = 0;  ///< largest ContactGraph::residual; the contacts have converged if <= 1
};

/// Improves graph.z from its guess until each contact's residual is at most what is allowed of it,
/// or the iterations are used up. Impulses of redundant contacts, of which the velocities determine
/// only sums, depend on the guess. `factor` is that of earlier solves on the same graph, perhaps
/// with fewer contacts: a method may use it and replace it.
template <int D>
using SolverMethod = SolverResult (*)(ContactGraph<D>& graph, int max_iterations,
                                      ActiveSetFactor<D>& factor);

/// Projected conjugate gradients (MPRGP: Dostal & Schoeberl 2005, "Minimizing quadratic functions
/// subject to bound constraints with the rate of convergence and finite termination"): conjugate
/// gradients, preconditioned by symmetric Gauss-Seidel, while the set of active contacts stays, and
/// projected steps where it changes. If that does not converge soon and a sparse factor of W is
/// cheap, active_set_newton.hpp finishes it.
template <int D>
SolverResult conjugate_gradients(ContactGraph<D>& graph, int max_iterations,
                                 ActiveSetFactor<D>& factor);

/// Accelerated projected gradient (Nesterov) with the restart of O'Donoghue & Candes 2015 and a
/// step that shrinks where the quadratic is steeper than it allows (Mazhar et al. 2015, "Using
/// Nesterov's method to accelerate multibody dynamics").
template <int D>
SolverResult accelerated_gradient(ContactGraph<D>& graph, int max_iterations,
                                  ActiveSetFactor<D>& factor);

/// Projected Gauss-Seidel, sweeps in both directions in turn, on one core.
template <int D>
SolverResult gauss_seidel(ContactGraph<D>& graph, int max_iterations, ActiveSetFactor<D>& factor);

/// A method by its name in case files.
struct SolverMethodRow {
  std::string_view name;
  SolverMethod<2> discs;
  SolverMethod<3> spheres;
};

/// All methods, the default first.
inline constexpr std::array<SolverMethodRow, 3> kSolverMethods = {{
    {"conjugate_gradients", conjugate_gradients<2>, conjugate_gradients<3>},
    {"accelerated_gradient", accelerated_gradient<2>, accelerated_gradient<3>},
    {"gauss_seidel", gauss_seidel<2>, gauss_seidel<3>},
}};

}  // namespace viscontact::particles
