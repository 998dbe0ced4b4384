// What moves the particles of a simulation, how their motion is computed, and when the projection
// of a step has converged: the content of a case file. Nothing is checked here; particles/case
// checks the values. Both simulations (simulation.hpp, fluid/fluid_simulation.hpp) and the output
// of their states read it. Lengths, masses and times are in any consistent units. A change of a
// default of SolverSettings changes the results of every case that does not set it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/particles/arrangement/source.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/piecewise_constant.hpp"

namespace viscontact::particles {

/// Tolerances have no dimension; docs/particles.md, "The projection", says how each is measured.
struct SolverSettings {
  /// Tolerance of the gaps, divided by the mean radius; > 0.
  double tolerance = 1e-6;
  /// Tolerance of each contact's impulse, divided by the impulses at work on its particles; > 0.
  double impulse_tolerance = 1e-10;
  /// Largest number of iterations in a step, >= 1. An iteration is a product with the matrix W of
  /// the dual problem, docs/physics.md (5.4), a sweep over the contacts, or a factorisation.
  int max_iterations = 10000;
};

/// Largest distance from the origin, and largest displacement in a step, that a particle may have
/// [L]. Beyond this distance the rounding errors of positions exceed `tolerance` (SolverSettings)
/// times `mean_radius` [L].
inline double largest_resolved_distance(double tolerance, double mean_radius) {
  // Squares of distances must be finite: 1e120 is far below 1e154, the root of the largest double.
  constexpr double kFinite = 1e120;
  return std::min(kFinite, tolerance * mean_radius / std::numeric_limits<double>::epsilon());
}

/// Velocities of a driven particle, which no force changes. Both are 0 after their last piece.
struct GivenMotion {
  PiecewiseConstant velocity;          ///< of the centre [L/T]
  PiecewiseConstant angular_velocity;  ///< counter-clockwise, value[2] of each piece [1/T]
};

/// At which time the velocities u^n of the scheme stand, docs/physics.md (5.3) and (5.10); t^n is
/// the time at the end of step n.
enum class Scheme {
  kEuler,     ///< u^n is the velocity at t^n; positions are of first order in the step
  kLeapfrog,  ///< u^n is the velocity half a step before t^n; of second order away from impacts
};

/// What moves the particles, and how their motion is computed. particles/case checks all values
/// when it reads a case, and a simulation does not check them again. The keys of the maps must be
/// numbers of existing particles.
struct Setting {
  std::vector<Plane> planes;  ///< rigid planes, at rest or moving, that particles cannot cross
  /// Holds the particles, and the fluid if there is one. Its walls are obstacles.
  Domain domain;
  Vector gravity{};  ///< acceleration, on all particles [L/T^2]
  /// Forces on single particles, by the number of the particle, in addition to gravity [M L/T^2].
  std::map<std::int32_t, PiecewiseConstant> forces;
  /// The laws of each pair. Friction needs particles that turn (add_rotation).
  ContactLaws laws;
  std::vector<Source> sources{};  ///< pour particles in; only without a fluid
  Links links;           ///< hinges, springs and arms; need particles that turn, except on an axis
  double time_step = 0;  ///< h [T], > 0
  Scheme scheme = Scheme::kEuler;  ///< kLeapfrog only without a fluid
  SolverSettings solver;           ///< tolerances and limits of the projection
  std::optional<Fluid> fluid;      ///< around the particles; needs a domain
  /// Torques on single particles, by the number of the particle [M L^2/T^2]; for discs value[2],
  /// counter-clockwise. Needs particles that turn. A particle with a torque has no entry in
  /// `given_motions`.
  std::map<std::int32_t, PiecewiseConstant> torques;
  /// Motions of the particles that are driven through the fluid, by the number of the particle. A
  /// driven particle has no entry in `forces`, and gravity does not change its motion.
  std::map<std::int32_t, GivenMotion> given_motions;
  /// Forces [M L/T^2] and torques [M L^2/T^2] on all particles in addition to those above, in the
  /// order of Particles::velocities and Particles::angular_velocities; empty: none. Those of driven
  /// particles have no effect. The caller of a simulation may change them between two steps
  /// (Simulation::added_forces). Torques need particles that turn.
  std::vector<double> added_forces{}, added_torques{};  ///< the torques, as above
};

/// The cell of the domain with the mean velocity gradient of the fluid, 0 without a fluid.
PeriodicCell cell_of(const Setting& setting);

/// The force of Setting::added_forces on particle k [M L/T^2]; 0 if there are none.
inline Vector added_force(const Setting& setting, std::size_t k, int dimension) {
  if (setting.added_forces.empty()) return {};
  return point_of(setting.added_forces.data(), k, dimension);
}

/// The torque of Setting::added_torques on particle k [M L^2/T^2], of a disc in component 2; 0 if
/// there are none.
inline Vector added_torque(const Setting& setting, std::size_t k, int dimension) {
  if (setting.added_torques.empty()) return {};
  if (dimension == 3) return point_of(setting.added_torques.data(), k, 3);
  return {0, 0, setting.added_torques[k]};
}

/// Setting::added_forces for these particles, with zeros at first.
inline std::span<double> added_forces_for(const Particles& particles, Setting& setting) {
  setting.added_forces.resize(particles.velocities.size());
  return setting.added_forces;
}

/// Setting::added_torques for these particles, with zeros at first; empty if they do not turn.
inline std::span<double> added_torques_for(const Particles& particles, Setting& setting) {
  setting.added_torques.resize(particles.angular_velocities.size());
  return setting.added_torques;
}

/// All obstacles of a case: the walls of its domain, then its planes. Files number them -1, -2, ...
std::vector<Plane> obstacles_of(const Setting& setting);

}  // namespace viscontact::particles
