// What a simulation asks of a fluid: the velocities that rigid particles take in it under given
// forces, and estimates of their errors (docs/fluid-solver.md).
#pragma once

#include <array>
#include <cassert>
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
#include "viscontact/particles/setting/fluid.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// Components of the motion of a particle: x, y and rotation in the plane (`dimension` 2), z on the
/// axis of a cylinder (`dimension` 1).
constexpr std::size_t motion_components(int dimension) { return dimension == 1 ? 1 : 3; }

struct MotionLayout {
  std::size_t components = 3;
  /// 2 in the plane, 1 on an axis.
  std::size_t directions() const { return components == 1 ? 1 : 2; }
  std::size_t at(std::int32_t k, std::size_t d) const {
    assert(k >= 0 && d < components);
    return index_of(k) * components + d;
  }
};

/// A step of a fluid with inertia, from the flow that FluidSolver::keep_flow() kept last to the
/// flow around the particles of place(), with backward differences in time.
struct FlowStep {
  int order = 0;      ///< order of the differences: 1 or 2; 0: Stokes flow, without inertia
  double length = 0;  ///< length of the step [T], > 0
  double before = 0;  ///< length of the step before it [T], > 0; only used with order 2
  double time = 0;    ///< time of the particles' places [T], at which walls have their velocities
  double from = 0;    ///< begin of the interval [T] over which WallVelocity::pieces are averaged
  /// End of this interval [T]. If it is not later than `from`, the pieces at `time` are taken.
  double to = 0;
  /// Mass or moment of inertia of each component of each particle [M, M L^2].
  std::span<const double> masses{};
};

struct FluidParticles {
  const Particles* particles = nullptr;  ///< never null in place()
  std::span<const double> angles;        ///< one for each particle [rad]; not used on an axis
  /// Motions of the driven particles, which forces do not change: x, y [L/T] and angular velocity
  /// [1/T]; on an axis only the first number is used.
  std::map<std::int32_t, std::array<double, 3>> driven;
  /// Mass or moment of inertia of each component of each particle, divided by the time step, >= 0
  /// [M/T, M L^2/T], which is added to the resistance of the fluid; may be empty. Not used in a
  /// fluid with inertia.
  std::span<const double> inertia;
  FlowStep flow_step{};  ///< only used in a fluid with inertia
};

/// Quantities of the flow of the last FluidSolver::velocities(forces, true).
struct FlowQuantities {
  /// 2 mu times the integral of D(u):D(u) over the fluid [M L^2/T^3], >= 0.
  double dissipation = 0;
  /// Dissipation over that of the fluid with the same walls alone [1]; 0 if this is 0 or not known.
  double apparent_viscosity = 0;
  /// Forces and torques of the fluid on all particles.
  std::vector<double> fluid_forces;
  /// Of the fluid [M L^2/T^2]; 0 without inertia.
  double kinetic_energy = 0;
  /// Largest distance that the fluid moves in a step relative to the mesh, over the size of the
  /// triangle [1]; 0 in a fluid without inertia.
  double courant_number = 0;
  double advection_error = 0;  ///< FluidStepReport::advection_error
  /// Flow [L^2/T] through each of Fluid::probes, and mean pressure [M/(L T^2)] on it.
  std::vector<std::array<double, 2>> probes{};
};

/// How results on a second mesh improve those on the first mesh. Let d be the change of a result
/// from the first to the second mesh. Then result + extrapolation * d is the most accurate value,
/// and error * |d| estimates its error; error_of_one_mesh * |d| estimates the error of the result
/// on the first mesh. All factors are >= 0 [1], and 0 if there is no second mesh.
struct SecondMesh {
  double extrapolation = 0;
  double error = 0;
  double error_of_one_mesh = 0;
};

using viscontact::FlowField;

/// A fluid with rigid particles, in any consistent units; in the plane masses, forces and powers
/// are per unit length of the third dimension. All arrays have motion_components() numbers for each
/// particle: velocities in [L/T, 1/T], forces and torques in [M L/T^2, M L^2/T^2].
///
/// Each function that asks the solver throws Error(kExternalProgram), with the last lines that the
/// solver printed, if the solver ends, is late or answers with anything but finite numbers;
/// Error(kInterrupted) if a stop was requested; and Error(kNotConverged) if an argument is not
/// finite.
class FluidSolver {
 public:
  virtual ~FluidSolver() = default;

  /// Takes new places of the particles. The matrix of the flow is made and factorised here, once in
  /// each step. Also throws Error(kNotConverged) if no mesh fits around the particles, because a
  /// gap is too narrow or particles overlap.
  virtual void place(const FluidParticles& bodies) = 0;

  /// The velocities of all particles under `forces` and torques. If `driving` is true, walls and
  /// driven particles move; otherwise they are at rest, so that the velocities are linear in the
  /// forces. place() must have been called.
  virtual std::vector<double> velocities(std::span<const double> forces, bool driving) = 0;

  /// velocities(force, false) for a unit force or torque on each component of each particle in
  /// turn: a matrix, row after row [T/M, T/(M L), T/(M L^2)]. It is symmetric if the fluid has no
  /// inertia. `components` is the length of arrays of forces.
  virtual std::vector<double> mobility(std::size_t components);

  /// Of the last velocities(forces, true), which must have been called.
  virtual FlowQuantities quantities() = 0;

  /// Takes the particles of the last place() with another penalty (Fluid::penalty), until the next
  /// place() or vary_mesh(). Returns the factor [1], >= 0, by which the change of a result must be
  /// multiplied to estimate the error that the penalty causes in it. Without a penalty returns 0
  /// and changes nothing.
  virtual double vary_penalty() = 0;

  /// Takes the particles of the last place(), with the penalty of the case, on a second mesh, until
  /// the next place().
  virtual SecondMesh vary_mesh() = 0;

  /// That of the last velocities(forces, true); after vary_mesh() on the finer of both meshes.
  virtual FlowField flow() = 0;

  // For a fluid with inertia, which remembers flows; those of this class do nothing.

  /// Keeps the flow of the last velocities(forces, true), or a fluid at rest, as the flow at the
  /// time of the last place(), from which the flow after the next place() continues. `motions` are
  /// the velocities of the particles, which Coupling::kSplitting may make different from those in
  /// the flow.
  virtual void keep_flow(bool at_rest, std::span<const double> motions);
  /// The kept flows, for load_flow(), in a form that each solver chooses.
  virtual std::string saved_flow();
  /// Continues from saved_flow() of another object for the same case.
  virtual void load_flow(const std::string& flow);

  /// On the mesh of the last place(); 0 if the solver does not say it.
  virtual std::size_t unknowns() const = 0;

  /// Of the solver so far [MiB] if it is a process of its own, otherwise 0.
  virtual double peak_memory_mebibytes() const { return 0; }
};

inline std::vector<double> FluidSolver::mobility(std::size_t components) {
  std::vector<double> matrix, forces(components);
  for (std::size_t i = 0; i < components; ++i) {
    forces[i] = 1;
    const auto row = velocities(forces, false);
    assert(row.size() == components);
    matrix.insert(matrix.end(), row.begin(), row.end());
    forces[i] = 0;
  }
  return matrix;
}
inline void FluidSolver::keep_flow(bool /*at_rest*/, std::span<const double> /*motions*/) {}
inline std::string FluidSolver::saved_flow() { return {}; }
inline void FluidSolver::load_flow(const std::string& /*flow*/) {}

/// Starts a solver of the fluid in `domain` around particles of the `shapes`, and waits until
/// it is ready. `dimension` is 2 for discs in the plane, 1 for spheres on the axis of a cylinder.
/// If `stop` requests a stop, the solver throws Error(kInterrupted).
using StartFluidSolver = std::function<std::unique_ptr<FluidSolver>(
    const Fluid& fluid, const Domain& domain, std::span<const Shape> shapes, int dimension,
    const StopToken& stop)>;

/// Extrapolated from two meshes, with estimates of errors.
struct FlowEstimate {
  std::vector<double> velocities;
  /// Dissipation, apparent viscosity and forces are extrapolated, the other members are not.
  FlowQuantities quantities;
  /// Relative to the largest velocity or, if it is larger, to the largest entry of the gradient of
  /// a linear flow times the largest radius; angular velocities are multiplied by the radius. 0 if
  /// both are 0.
  RelativeErrors of_velocities;
  /// Relative to the largest of the forces of the fluid; torques are divided by the radius. 0 if
  /// all are 0.
  RelativeErrors of_forces;
  /// Errors >= 0 of `quantities.fluid_forces` [M L/T^2, M L^2/T^2]. In the plane both components of
  /// a force get the same error, and the torque this error times the radius.
  std::vector<double> force_errors;
  /// Errors >= 0 of the results of `further`, in their units, on the mesh that place() made.
  std::vector<double> further_errors;
};

/// Estimates the errors of solver.velocities(forces, true) and of the quantities of this flow.
/// solver.place() must have been called with `particles`. Afterwards the solver is on another mesh,
/// and only flow() may be called before the next place().
///
/// `forces` may contain contact forces, whose own errors are not in the estimates. `further` is
/// called after each flow and returns more results that depend on it, such as forces of links; it
/// may be empty. Without a penalty or second mesh the errors lack the part that it would cause.
/// Throws the errors of FluidSolver.
FlowEstimate estimate_flow(FluidSolver& solver, std::span<const double> forces,
                           const Particles& particles, const Fluid& fluid,
                           const std::function<std::vector<double>()>& further = {});

}  // namespace viscontact::particles
