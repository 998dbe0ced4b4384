// What a simulation asks of a fluid: the velocities that rigid particles take in the fluid under
// given forces, and estimates of the errors of these velocities. Lengths [L], masses [M] and times
// [T] are in any consistent units; in the plane masses, forces and powers are per unit length of
// the third dimension. Simulations in particles/fluid/ ask, freefem_flow/ answers, and app/
// connects both. A solver that fails throws Error(kExternalProgram); places around which no mesh
// fits and arguments that are not finite throw Error(kNotConverged); a stop that is requested
// throws Error(kInterrupted). Sizes of arrays are only asserted. A change must agree with
// docs/fluid-solver.md.
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

/// Number of components of the motion of a particle. It is 3 in the plane (`dimension` 2): velocity
/// along x and y, and angular velocity. It is 1 on the axis of a cylinder (`dimension` 1): velocity
/// along z.
constexpr std::size_t motion_components(int dimension) { return dimension == 1 ? 1 : 3; }

/// The order of the components of velocities or forces of all particles in an array.
struct MotionLayout {
  std::size_t components = 3;  ///< motion_components()
  /// Number of components that are not angular: 2 in the plane, 1 on an axis.
  std::size_t directions() const { return components == 1 ? 1 : 2; }
  /// Place in the array of component `d` of particle `k`, both from 0.
  std::size_t at(std::int32_t k, std::size_t d) const { return index_of(k) * components + d; }
};

/// A step of a fluid with inertia, from the flow that FluidSolver::keep_flow() kept last to the
/// flow around the particles that FluidSolver::place() takes next. Rates of change are backward
/// differences of the flows at the ends of the last steps.
struct FlowStep {
  int order = 0;      ///< order of the differences: 1 or 2; 0: Stokes flow, without inertia
  double length = 0;  ///< length of the step [T], > 0
  double before = 0;  ///< length of the step before it [T], > 0; only used with order 2
  double time = 0;    ///< time of the particles' places [T], at which walls have their velocities
  double from = 0;    ///< begin of the interval [T] over which WallVelocity::pieces are averaged
  /// End of this interval [T]. If it is not later than `from`, the pieces at `time` are taken.
  double to = 0;
  /// Mass or moment of inertia of each component of each particle [M, M L^2]; empty: the fluid has
  /// no inertia.
  std::span<const double> masses{};
};

/// The particles at one time, as the fluid sees them.
struct FluidParticles {
  const Particles* particles = nullptr;  ///< must not be null when place() is called
  std::span<const double> angles;        ///< one for each particle [rad]; not used on an axis
  /// Motions of the driven particles by the number of the particle: x, y [L/T] and angular velocity
  /// [1/T]; on an axis only the first number is used. A driven particle has a given motion, which
  /// forces do not change. All other particles are free.
  std::map<std::int32_t, std::array<double, 3>> driven;
  /// Mass or moment of inertia of each component of each particle, divided by the time step, >= 0
  /// [M/T, M L^2/T]. In a fluid without inertia it is added to the resistance of the fluid. Empty:
  /// the particles have no inertia.
  std::span<const double> inertia;
  FlowStep flow_step{};  ///< only used in a fluid with inertia
};

/// Quantities of the flow of the last FluidSolver::velocities(forces, true).
struct FlowQuantities {
  /// 2 mu times the integral of D(u):D(u) over the fluid [M L^2/T^3], >= 0, with the viscosity mu
  /// and the symmetric gradient D(u) of the velocity u.
  double dissipation = 0;
  /// Dissipation divided by that of the fluid without particles and with the same walls [1]; 0 if
  /// the walls are at rest, or if the dissipation without particles is not known.
  double apparent_viscosity = 0;
  /// Forces and torques of the fluid on all particles [M L/T^2, M L^2/T^2], motion_components()
  /// numbers each.
  std::vector<double> fluid_forces;
  /// Kinetic energy of the fluid [M L^2/T^2], >= 0; 0 in a fluid without inertia.
  double kinetic_energy = 0;
  /// Largest distance that the fluid moves in a step relative to the mesh, divided by the size of
  /// the triangle of the mesh [1], >= 0; 0 in a fluid without inertia.
  double courant_number = 0;
  double advection_error = 0;  ///< FluidStepReport::advection_error
  /// Flow [L^2/T] through each of Fluid::probes, and mean pressure [M/(L T^2)] on it, in the order
  /// of the probes.
  std::vector<std::array<double, 2>> probes{};
};

/// How results on a second mesh improve those on the first mesh, which place() made. Let d be the
/// change of a result from the first to the second mesh. Then result + extrapolation * d is the
/// most accurate value, and error * |d| estimates the error of this value. error_of_one_mesh * |d|
/// estimates the error of the result on the first mesh. All three factors are >= 0 and without
/// dimension; all are 0 if there is no second mesh.
struct SecondMesh {
  double extrapolation = 0;      ///< factor of d in the most accurate value [1]
  double error = 0;              ///< factor of |d| in the error of the most accurate value [1]
  double error_of_one_mesh = 0;  ///< factor of |d| in the error on the first mesh [1]
};

using viscontact::FlowField;

/// A fluid with rigid particles. All arrays have motion_components() numbers for each particle:
/// velocities in [L/T, 1/T], forces and torques in [M L/T^2, M L^2/T^2].
///
/// Each function that asks the solver throws Error(kExternalProgram), with the last lines that the
/// solver printed, if the solver ends, is late or answers with anything but finite numbers. It
/// throws Error(kInterrupted) if a stop was requested, and Error(kNotConverged) if an argument is
/// not finite. Only asserts check that place() was called and that arrays have their sizes.
class FluidSolver {
 public:
  virtual ~FluidSolver() = default;

  /// Takes new places of the particles. The matrix of the flow is made and factorised here, once in
  /// each step. Also throws Error(kNotConverged) if no mesh fits around the particles, because a
  /// gap is too narrow or particles overlap.
  virtual void place(const FluidParticles& bodies) = 0;

  /// Returns the velocities of all particles under the forces and torques `forces`. If `driving` is
  /// true, walls and driven particles move; if it is false, they are at rest, so that the
  /// velocities are linear in the forces. place() must have been called.
  virtual std::vector<double> velocities(std::span<const double> forces, bool driving) = 0;

  /// Returns velocities(force, false) for a unit force or torque on each component of each particle
  /// in turn: a matrix with one row of `components` numbers for each force, row after row [T/M,
  /// T/(M L), T/(M L^2)]. It is symmetric if the fluid has no inertia. `components` must be the
  /// number of components of all particles together (not checked).
  virtual std::vector<double> mobility(std::size_t components);

  /// Quantities of the flow of the last velocities(forces, true). This function must have been
  /// called before.
  virtual FlowQuantities quantities() = 0;

  /// Takes the particles of the last place() with another penalty (Fluid::penalty). Until the next
  /// call of place() or vary_mesh(), velocities() and quantities() are those with this penalty.
  /// Returns the factor [1], >= 0, by which the change of a result must be multiplied to estimate
  /// the error that the penalty causes in it. If there is no penalty, returns 0 and changes
  /// nothing.
  virtual double vary_penalty() = 0;

  /// Takes the particles of the last place(), with the penalty of the case, on a second mesh. Until
  /// the next call of place(), velocities() and quantities() are those on this mesh.
  virtual SecondMesh vary_mesh() = 0;

  /// Velocity and pressure of the last velocities(forces, true), which must have been called. After
  /// vary_mesh() they are those on the finer of both meshes.
  virtual FlowField flow() = 0;

  // A fluid with inertia remembers flows. For other fluids these three functions must not be called
  // (not checked); those of this class do nothing.

  /// Keeps a flow from which the flow after the next place() continues, as the flow at the time of
  /// the last place(). It is that of the last velocities(forces, true), or a fluid at rest if
  /// `at_rest` is true. `motions` are the velocities of the particles, which Coupling::kSplitting
  /// may make different from the velocities in the flow.
  virtual void keep_flow(bool at_rest, std::span<const double> motions);
  /// The kept flows that the next steps need, for load_flow(). Each solver chooses their form.
  virtual std::string saved_flow();
  /// Continues from the flows that saved_flow() of another object for the same case returned.
  virtual void load_flow(const std::string& flow);

  /// Number of unknowns on the mesh of the last place(); 0 if the solver does not say it.
  virtual std::size_t unknowns() const = 0;

  /// The largest resident memory of the solver so far [MiB] if it is a process of its own,
  /// otherwise 0.
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

/// A function that starts a solver of the fluid in `domain` around particles with `radii` [L], > 0,
/// one for each, and waits until the solver is ready. `dimension` is 2 for discs in the plane, 1
/// for spheres on the axis of a cylinder. If `stop` requests a stop, the solver throws
/// Error(kInterrupted). freefem_flow::start_fluid_solver is such a function; its header says which
/// errors it throws.
using StartFluidSolver = std::function<std::unique_ptr<FluidSolver>(
    const Fluid& fluid, const Domain& domain, std::span<const double> radii, int dimension,
    const StopToken& stop)>;

/// A flow that is extrapolated from two meshes, with estimates of its errors.
struct FlowEstimate {
  /// The extrapolated velocities, motion_components() numbers for each particle [L/T, 1/T].
  std::vector<double> velocities;
  /// Dissipation, apparent viscosity and forces are extrapolated, the other members are not.
  FlowQuantities quantities;
  /// Errors of the velocities [1], >= 0, where angular velocities are multiplied by the radius.
  /// They are divided by the largest velocity or, if it is larger, by the largest entry of the
  /// gradient of a linear flow (LinearFlow) times the largest radius; 0 if both of these are 0.
  RelativeErrors of_velocities;
  /// Errors of the forces of the fluid [1], >= 0, where torques are divided by the radius. They are
  /// divided by the largest of these forces; 0 if all forces are 0.
  RelativeErrors of_forces;
  /// Errors >= 0 of `quantities.fluid_forces`, as many numbers [M L/T^2, M L^2/T^2]. In the plane
  /// both components of the force on a particle get the same error, and the error of its torque is
  /// this error times the radius.
  std::vector<double> force_errors;
  /// Errors >= 0 of the results of `further`, an argument of estimate_flow(), on the mesh that
  /// place() made. They are as many as these results and have their units; empty without `further`.
  std::vector<double> further_errors;
};

/// Estimates the errors of solver.velocities(forces, true) and of the quantities of this flow.
/// solver.place() must have been called with `particles`. Afterwards the solver is on another mesh;
/// only flow() may then be called before the next place().
///
/// `forces` are forces and torques, motion_components() numbers for each particle [M L/T^2,
/// M L^2/T^2]. They may contain contact forces, whose own errors are not in the estimates.
/// `further` is called after each flow and returns more results that depend on the flow, such as
/// the forces of links; if it is empty, there are no such results. If there is no penalty, or no
/// second mesh, the errors do not contain the part that the penalty or the mesh would cause. Throws
/// the errors of FluidSolver, also Error(kInterrupted) if a stop is requested.
FlowEstimate estimate_flow(FluidSolver& solver, std::span<const double> forces,
                           const Particles& particles, const Fluid& fluid,
                           const std::function<std::vector<double>()>& further = {});

}  // namespace viscontact::particles
