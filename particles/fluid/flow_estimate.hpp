// The errors of velocities and forces in a fluid: the flow of one placement is computed again with
// another penalty and on another mesh. Lengths, masses and times are in the units of the case.
// fluid_simulation.cpp calls it at the first and the last step. A change must keep the order of the
// questions.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// A flow from two meshes, with estimates of its errors.
struct FlowEstimate {
  std::vector<double> velocities;  ///< the most accurate ones [L/T, 1/T]
  FlowQuantities quantities;       ///< the most accurate ones
  /// Of the velocities, where angular velocities are multiplied by the radius. They are relative to
  /// the largest velocity, or to the change of a linear flow over the largest radius if that is
  /// larger.
  RelativeErrors of_velocities;
  /// Of the forces of the fluid, relative to the largest of them, where torques are divided by the
  /// radius.
  RelativeErrors of_forces;
  /// Errors >= 0 of `quantities.fluid_forces`, as many numbers [M L/T^2, M L^2/T^2]. In the plane
  /// the components of the force on a particle have one error, and its torque has this error times
  /// the radius.
  std::vector<double> force_errors;
  /// Errors >= 0 of the further results on the mesh of the placement.
  std::vector<double> further_errors;
};

/// Estimates the errors of velocities(forces, true) and of the quantities of this flow. place()
/// must have been called with `particles`, and must be called before any further question but
/// flow().
///
/// `further` is called after each flow and returns more results that depend on it, such as the
/// forces of links; empty: there are none. The errors of impulses of contacts that `forces` may
/// contain are not in the estimates. Throws the errors of FluidSolver.
FlowEstimate estimate_flow(FluidSolver& solver, std::span<const double> forces,
                           const Particles& particles, const Fluid& fluid,
                           const std::function<std::vector<double>()>& further = {});

}  // namespace viscontact::particles
