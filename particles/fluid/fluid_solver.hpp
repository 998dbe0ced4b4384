// What a simulation asks of a fluid: the velocities that rigid particles take in it under given
// forces. Lengths, masses and times are in the units of the case.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// Number of components of the motion of a particle: 3 in the plane (velocity along x and y,
/// angular velocity), 1 on the axis of a cylinder (velocity along z).
constexpr std::size_t motion_components(int dimension) { return dimension == 1 ? 1 : 3; }

/// The particles at one time, as the fluid sees them.
struct FluidParticles {
  const Particles* particles = nullptr;
  std::span<const double> angles;  ///< of each particle; empty on an axis
  /// Motions of particles that are driven, by the number of the particle; the others are free.
  std::map<std::int32_t, std::array<double, 3>> driven;
  /// Mass and moment of inertia over the time step of each component of each particle [M/T], added
  /// to the resistance; empty: no inertia.
  std::span<const double> inertia;
};

/// Quantities of the flow that the last call of velocities() with `driving` computed.
struct FlowQuantities {
  double dissipation = 0;  ///< 2 mu integral of D(u):D(u) [M L^2/T^3]
  /// Dissipation over that of the fluid alone with the same boundary. 0 if the boundary is at rest,
  /// or if the dissipation of the fluid alone is not known.
  double apparent_viscosity = 0;
  /// Force and torque of the fluid on each particle, motion_components() numbers each.
  std::vector<double> fluid_forces;
};

/// Velocities of all particles with their error.
struct EstimatedVelocities {
  std::vector<double> velocities;  ///< extrapolated from two meshes
  /// Estimate of the error of `velocities`, relative to the largest velocity.
  double relative_error = 0;
  /// The same estimate for the velocities of one mesh, which velocities() returns.
  double relative_error_of_one_mesh = 0;
  /// The part of both that is the error of the penalty; < 0 if it is not known and in neither.
  double relative_error_of_penalty = -1;
};

/// Velocity and pressure at the nodes of a mesh of quadratic triangles. On an axis, x is the
/// distance from it and y is z.
struct FlowField {
  std::vector<double> x, y;                              ///< of each node [L]
  std::vector<double> velocity_x, velocity_y, pressure;  ///< [L/T], [M/(L T^2)]
  /// The nodes of each triangle: three corners counter-clockwise, then the middles of the sides
  /// between corners 0 and 1, 1 and 2, 2 and 0, as VTK numbers them.
  std::vector<std::array<std::int32_t, 6>> triangles;
};

/// A fluid with rigid particles. All arrays have motion_components() numbers for each particle.
///
/// Each function throws Error(kExternalProgram) with the last lines of the solver if it ends or
/// answers with anything but numbers, and Error(kInterrupted) if a stop was requested.
class FluidSolver {
 public:
  virtual ~FluidSolver() = default;

  /// Takes new places of the particles. The matrix of the flow is made and factorised here, once a
  /// step.
  virtual void place(const FluidParticles& bodies) = 0;

  /// The velocities of all particles under `forces` (forces and torques). With `driving`, walls and
  /// driven particles move; without it they are at rest, so that the velocities are linear in the
  /// forces. place() must have been called.
  virtual std::vector<double> velocities(std::span<const double> forces, bool driving) = 0;

  /// Quantities of the last velocities(forces, true).
  virtual FlowQuantities quantities() = 0;

  /// The velocities of velocities(forces, true) from two meshes, with their error.
  virtual EstimatedVelocities estimate(std::span<const double> forces) = 0;

  /// Velocity and pressure of the last velocities(forces, true).
  virtual FlowField flow() = 0;

  /// Number of unknowns of the last mesh; 0 if the solver does not say.
  virtual std::size_t unknowns() const = 0;

  /// The largest resident memory of the solver so far [MiB], if it is a process of its own; else 0.
  virtual double peak_memory_mebibytes() const { return 0; }
};

}  // namespace viscontact::particles
