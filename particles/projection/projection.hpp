// The methods that solve the projection (5.4) of a time step, and their settings. Impulses and
// residuals are scaled as contact_graph.hpp says.
#pragma once

#include <array>
#include <string_view>

#include "viscontact/particles/projection/active_set_factor.hpp"
#include "viscontact/particles/projection/contact_graph.hpp"

namespace viscontact::particles {

struct SolverSettings {
  /// Tolerance of the gaps, divided by the mean radius; > 0.
  double tolerance = 1e-6;
  /// Tolerance of each contact's impulse, divided by the impulses at work on its particles; > 0.
  double impulse_tolerance = 1e-10;
  /// Largest number of iterations in a step, >= 1. An iteration is a product with W, a sweep, or a
  /// factorisation.
  int max_iterations = 10000;
  std::string_view method = "conjugate_gradients";  ///< one of the names in kSolverMethods
};

/// What a method returns.
struct SolverResult {
  int iterations = 0;
  /// Largest ContactGraph::residual. All contacts have converged if it is at most 1.
  double residual = 0;
};

/// A method improves graph.z, which begins as a guess, until all residuals are at most 1 or
/// `max_iterations` are done. Redundant contacts have impulses of which the velocities determine
/// only sums; their values depend on the guess. `factor` belongs to earlier solves of the same
/// step, whose graph may have had fewer contacts. The method may use the factor and replace it.
template <int D>
using SolverMethod = SolverResult (*)(ContactGraph<D>& graph, int max_iterations,
                                      ActiveSetFactor<D>& factor);

/// Modified proportioning with reduced gradient projections, MPRGP (Dostal & Schoeberl 2005,
/// "Minimizing quadratic functions subject to bound constraints with the rate of convergence and
/// finite termination"). While the set of active contacts stays the same, it makes conjugate
/// gradient steps, preconditioned by symmetric Gauss-Seidel; where the set changes, projected
/// gradient steps. If these do not converge soon and a sparse factor of W is cheap, the factor
/// becomes the preconditioner (active_set_factor.hpp). Newton's method (active_set_newton.hpp)
/// solves chains of contacts and helps if all else takes long.
template <int D>
SolverResult conjugate_gradients(ContactGraph<D>& graph, int max_iterations,
                                 ActiveSetFactor<D>& factor);

/// Accelerated projected gradient (Nesterov), with the restart of O'Donoghue & Candes 2015. The
/// step length shrinks where the objective curves more than it assumes (Mazhar et al. 2015, "Using
/// Nesterov's method to accelerate multibody dynamics").
template <int D>
SolverResult accelerated_gradient(ContactGraph<D>& graph, int max_iterations,
                                  ActiveSetFactor<D>& factor);

/// Projected Gauss-Seidel, with forward and backward sweeps in turn, on one thread.
template <int D>
SolverResult gauss_seidel(ContactGraph<D>& graph, int max_iterations, ActiveSetFactor<D>& factor);

/// A method and its name in case files, for discs and for spheres.
struct SolverMethodRow {
  std::string_view name;
  SolverMethod<2> discs;
  SolverMethod<3> spheres;
};

/// All methods. The first is the default.
inline constexpr std::array<SolverMethodRow, 3> kSolverMethods = {{
    {"conjugate_gradients", conjugate_gradients<2>, conjugate_gradients<3>},
    {"accelerated_gradient", accelerated_gradient<2>, accelerated_gradient<3>},
    {"gauss_seidel", gauss_seidel<2>, gauss_seidel<3>},
}};

}  // namespace viscontact::particles
