// Estimates the errors of velocities and forces in a fluid: the flow of one placement of the
// particles is computed again with another penalty and on another mesh. Lengths, masses and times
// are in any consistent units. fluid_simulation.cpp calls it in the first and the last step. Errors
// of the fluid solver are thrown; sizes are not checked. A change must keep the order of the calls
// of the solver.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// A flow that is extrapolated from two meshes, with estimates of its errors.
struct FlowEstimate {
  /// Extrapolated, motion_components() numbers for each particle [L/T, 1/T].
  std::vector<double> velocities;
  FlowQuantities quantities;  ///< dissipation, apparent viscosity, forces are extrapolated
  /// Errors of the velocities, with angular velocities multiplied by the radius. They are relative
  /// to the largest velocity or, if it is larger, to the largest entry of the gradient of a linear
  /// flow (LinearFlow) times the largest radius [1]; 0 if both are 0.
  RelativeErrors of_velocities;
  /// Errors of the forces of the fluid, with torques divided by the radius, relative to the largest
  /// of these forces [1]; 0 if all are 0.
  RelativeErrors of_forces;
  /// Errors >= 0 of `quantities.fluid_forces`, as many numbers [M L/T^2, M L^2/T^2]. In the plane
  /// both components of the force on a particle get the same error, and its torque this error times
  /// the radius.
  std::vector<double> force_errors;
  /// Errors >= 0 of the results of `further` on the mesh of the placement, as many and in their
  /// units; empty without `further`.
  std::vector<double> further_errors;
};

/// Estimates the errors of solver.velocities(forces, true) and of the quantities of this flow.
/// solver.place() must have been called with `particles`. It must be called again afterwards before
/// any function of the solver but flow(), because the solver is left on another mesh.
///
/// `further` is called after each flow and returns more results that depend on it, such as the
/// forces of links; empty: there are none. `forces` may contain contact forces, whose own errors
/// are not in the estimates; they have motion_components() numbers for each particle [M L/T^2,
/// M L^2/T^2]. If there is no penalty, or no second mesh, the part of the errors that it would
/// cause is 0. Throws the errors of FluidSolver, such as Error(kInterrupted) if a stop is
/// requested.
FlowEstimate estimate_flow(FluidSolver& solver, std::span<const double> forces,
                           const Particles& particles, const Fluid& fluid,
                           const std::function<std::vector<double>()>& further = {});

}  // namespace viscontact::particles
