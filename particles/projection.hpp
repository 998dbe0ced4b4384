// The methods that solve the projection of a time step.
#pragma once

#include <array>
#include <string_view>

#include "particles/contact_graph.hpp"
#include "particles/face_factor.hpp"

namespace viscontact::particles {

struct SolverSettings {
  double tolerance = 1e-6;                          ///< of the residual, > 0
  int max_iterations = 10000;                       ///< of a step, >= 1: products with W, or sweeps
  std::string_view method = "conjugate_gradients";  ///< a name in kSolverMethods
};

/// How far a method came.
struct Solved {
  int iterations = 0;
  double violation = 0;  ///< largest over the contacts [L]: ContactGraph::violation
};

/// Improves graph.z from its guess until no contact is further than `tolerance` [L] from its conditions or the iterations are used up. Impulses of
/// redundant contacts, of which the velocities know only a part, depend on the guess. `factor` is that of the solves before it on the same graph, perhaps with fewer contacts: a
/// method may use it and make another.
template <int D>
using SolverMethod = Solved (*)(ContactGraph<D>& graph, double tolerance, int max_iterations,
                                FaceFactor<D>& factor);

/// Projected conjugate gradients (MPRGP: Dostal & Schoeberl 2005, "Minimizing quadratic functions subject to bound constraints with the rate of
/// convergence and finite termination"): conjugate gradients, preconditioned by symmetric Gauss-Seidel, while the set of held contacts stays; projected
/// steps where it changes.
template <int D>
Solved conjugate_gradients(ContactGraph<D>& graph, double tolerance, int max_iterations,
                           FaceFactor<D>& factor);

/// Accelerated projected gradient (Nesterov) with the restart of O'Donoghue & Candes 2015 and a step that shrinks where the quadratic is steeper than it
/// allows (Mazhar et al. 2015, "Using Nesterov's method to accelerate multibody dynamics").
template <int D>
Solved accelerated_gradient(ContactGraph<D>& graph, double tolerance, int max_iterations,
                            FaceFactor<D>& factor);

/// Projected Gauss-Seidel, sweeps to and fro, on one core.
template <int D>
Solved gauss_seidel(ContactGraph<D>& graph, double tolerance, int max_iterations,
                    FaceFactor<D>& factor);

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
