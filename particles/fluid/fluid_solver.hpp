// What a simulation asks of a fluid: the velocities that rigid particles take in it under given
// forces, and estimates of their errors. Lengths, masses and times are in any consistent units; in
// the plane masses, forces and powers are per unit length of the third dimension. Simulations in
// particles/fluid/ ask, freefem_flow/ answers, and app/ connects both. A solver that fails throws
// Error(kExternalProgram), places without a mesh and arguments that are not finite
// Error(kNotConverged), a stop Error(kInterrupted). Sizes of arrays are only asserted. A change
// must agree with docs/fluid-solver.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// Number of components of the motion of a particle: 3 in the plane (velocity along x and y,
/// angular velocity), 1 on the axis of a cylinder (velocity along z, `dimension` 1).
constexpr std::size_t motion_components(int dimension) { return dimension == 1 ? 1 : 3; }

/// The order of the components of velocities or forces of all particles in an array.
struct MotionLayout {
  std::size_t components = 3;  ///< motion_components()
  /// Number of components that are not angular: 2 in the plane, 1 on an axis.
  std::size_t directions() const { return components == 1 ? 1 : 2; }
  /// Place in the array of component `d` of particle `k`, both from 0.
  std::size_t at(std::int32_t k, std::size_t d) const { return index_of(k) * components + d; }
};

/// A step of a fluid with inertia, from the flow that keep_flow() kept last to the flow of the next
/// placement. Rates are backward differences of the flows at the ends of the last steps.
struct FlowStep {
  int order = 0;      ///< of the differences: 1 or 2; 0: Stokes flow, without inertia
  double length = 0;  ///< of the step [T], > 0
  double before = 0;  ///< of the step before it [T]; needed by order 2
  double time = 0;    ///< of the placement [T], at which walls have their velocities
  double from = 0;    ///< time [T] from which the pieces of a wall's velocity are averaged
  double to = 0;  ///< time [T] until which they are; if it is not larger, they are taken at `time`
  /// Mass or moment of inertia of each component of each particle [M, M L^2]; empty: the fluid has
  /// no inertia.
  std::span<const double> masses{};
};

/// The particles at one time, as the fluid sees them.
struct FluidParticles {
  const Particles* particles = nullptr;  ///< not null when place() is called
  std::span<const double> angles;        ///< one for each particle [rad]; not used on an axis
  /// Motions [L/T, 1/T] of particles that are driven, whose motion is given and not changed by
  /// forces, by the number of the particle; on an axis only the first number is used. The others
  /// are free.
  std::map<std::int32_t, std::array<double, 3>> driven;
  /// Mass or moment of inertia over the time step of each component of each particle, >= 0 [M/T,
  /// M L^2/T], in a fluid without inertia, added to the resistance; empty: the particles have no
  /// inertia.
  std::span<const double> inertia;
  FlowStep flow_step{};  ///< in a fluid with inertia
};

/// Quantities of the flow of the last FluidSolver::velocities(forces, true).
struct FlowQuantities {
  /// 2 mu times the integral of D(u):D(u) [M L^2/T^3]; D(u): symmetric velocity gradient.
  double dissipation = 0;
  /// Dissipation over that of the fluid alone with the same walls [1]; 0 if the walls are at rest,
  /// or if the dissipation of the fluid alone is not known.
  double apparent_viscosity = 0;
  /// Forces and torques of the fluid on all particles [M L/T^2, M L^2/T^2], motion_components()
  /// numbers each.
  std::vector<double> fluid_forces;
  // In a fluid with inertia:
  double kinetic_energy = 0;  ///< of the fluid [M L^2/T^2], >= 0
  /// Largest distance that the fluid moves in a step relative to the mesh, over the size of the
  /// triangle [1].
  double courant_number = 0;
  /// Flow [L^2/T] and mean pressure [M/(L T^2)] of each of Fluid::probes.
  std::vector<std::array<double, 2>> probes{};
};

/// How results on a second mesh improve those on the mesh of a placement. With the change d of a
/// result from the mesh of the placement to the second one, result + extrapolation * d is the most
/// accurate value; error * |d| estimates its error, and error_of_one_mesh * |d| that of the result
/// on the mesh of the placement. All are >= 0, without dimension, and 0 if there is no mesh.
struct SecondMesh {
  double extrapolation = 0;      ///< factor of d in the most accurate value
  double error = 0;              ///< factor of |d| in the error of the most accurate value
  double error_of_one_mesh = 0;  ///< factor of |d| in the error on the mesh of the placement
};

using viscontact::FlowField;

/// A fluid with rigid particles. All arrays have motion_components() numbers for each particle:
/// velocities in [L/T, 1/T], forces and torques in [M L/T^2, M L^2/T^2].
///
/// Each function that asks the solver throws Error(kExternalProgram) with the last lines of the
/// solver if the solver ends, is late or answers with anything but finite numbers,
/// Error(kInterrupted) if a stop was requested, and Error(kNotConverged) if an argument is not
/// finite. That place() was called and that arrays have their sizes is checked by asserts only.
class FluidSolver {
 public:
  virtual ~FluidSolver() = default;

  /// Takes new places of the particles. The matrix of the flow is made and factorised here, once a
  /// step. Also throws Error(kNotConverged) if no mesh fits, because a gap is too narrow or
  /// particles overlap.
  virtual void place(const FluidParticles& bodies) = 0;

  /// The velocities of all particles under `forces` (forces and torques). With `driving`, walls and
  /// driven particles move; without it they are at rest, so that the velocities are linear in the
  /// forces. place() must have been called.
  virtual std::vector<double> velocities(std::span<const double> forces, bool driving) = 0;

  /// velocities(force, false) for a unit force or torque on each of the `components` components of
  /// all particles in turn: a matrix with one row of `components` numbers for each force, row after
  /// row [T/M, T/(M L), T/(M L^2)], symmetric without inertia of the fluid. `components` is the
  /// number of those of all particles (not checked).
  virtual std::vector<double> mobility(std::size_t components);

  /// Quantities of the last velocities(forces, true), which there must have been.
  virtual FlowQuantities quantities() = 0;

  /// Takes the particles of the last placement with another penalty (Fluid::penalty). Until the
  /// next call of place() or vary_mesh(), velocities() and quantities() are those with this
  /// penalty. Returns the factor >= 0 by which the change of a result is multiplied to estimate its
  /// error by the penalty; 0 if there is no penalty, and then nothing changes.
  virtual double vary_penalty() = 0;

  /// Takes the particles of the last placement, with the penalty of the case, on a second mesh.
  /// Until the next call of place(), velocities() and quantities() are those on this mesh.
  virtual SecondMesh vary_mesh() = 0;

  /// Velocity and pressure of the last velocities(forces, true); after vary_mesh() on the finer of
  /// both meshes.
  virtual FlowField flow() = 0;

  // A fluid with inertia remembers flows. For other fluids these three functions must not be called
  // (not checked); those of this class do nothing.

  /// Keeps the flow of the last velocities(forces, true), or a fluid at rest if `at_rest`, as that
  /// at the time of the placement, from which the next placement continues. `motions` are those of
  /// the particles, which Coupling::kSplitting may make different from the velocities in the flow.
  virtual void keep_flow(bool at_rest, std::span<const double> motions);
  /// The flows that were kept and still matter, for load_flow(), in a form of the solver's own.
  virtual std::string saved_flow();
  /// Continues from the flows that saved_flow() of another object for the same case returned.
  virtual void load_flow(const std::string& flow);

  /// Number of unknowns on the mesh of the last placement; 0 if the solver does not say.
  virtual std::size_t unknowns() const = 0;

  /// The largest resident memory of the solver so far [MiB], if it is a process of its own; else 0.
  virtual double peak_memory_mebibytes() const { return 0; }
};

inline std::vector<double> FluidSolver::mobility(std::size_t components) {
  std::vector<double> matrix, forces(components);
  for (std::size_t i = 0; i < components; ++i) {
    forces[i] = 1;
    const auto row = velocities(forces, false);
    matrix.insert(matrix.end(), row.begin(), row.end());
    forces[i] = 0;
  }
  return matrix;
}
inline void FluidSolver::keep_flow(bool /*at_rest*/, std::span<const double> /*motions*/) {}
inline std::string FluidSolver::saved_flow() { return {}; }
inline void FluidSolver::load_flow(const std::string& /*flow*/) {}

/// Starts a solver of the fluid in `domain` around particles with `radii` [L], > 0, and waits until
/// it is ready. `dimension`: 2 for discs in the plane, 1 for spheres on the axis of a cylinder.
/// freefem_flow::start_fluid_solver is such a function, and says which errors it throws.
using StartFluidSolver = std::function<std::unique_ptr<FluidSolver>(
    const Fluid& fluid, const Domain& domain, std::span<const double> radii, int dimension,
    const StopToken& stop)>;

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
