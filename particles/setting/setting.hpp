// The settings of a simulation, the content of a case file.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/setting/fluid.hpp"
#include "viscontact/particles/setting/pair_lubrication.hpp"
#include "viscontact/particles/setting/source.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/values/piecewise_constant.hpp"

namespace viscontact::particles {

/// What tolerances are chosen for.
enum class Accuracy {
  kFull,  ///< impulses to many digits
  /// Packings of round particles: as accurate as a computation with stiff grains, and fast. The
  /// impulse that acts on a particle is at least the mean of the normal impulses in its set, the
  /// particles that contacts connect.
  kPacking,
};

/// Accuracy of the projection of a step, the problem that gives its velocities and impulses.
/// Tolerances have no dimension (docs/particles.md, "The projection").
struct SolverSettings {
  /// Largest error of a gap after a step, divided by the mean radius; > 0.
  double tolerance = 1e-6;
  /// Largest error of the normal impulse of a contact, divided by the largest impulse that acts on
  /// the less loaded of its two particles; > 0. For the impulse of friction it is 100 `tolerance`
  /// if this is larger.
  double impulse_tolerance = 1e-10;
  /// Largest number of iterations in a step, >= 1; a step that needs more has not converged. An
  /// iteration is a product of the matrix W of docs/physics.md (5.4) and a vector, or a sweep over
  /// the contacts, or a factorisation.
  int max_iterations = 10000;
  Accuracy accuracy = Accuracy::kFull;

  static SolverSettings for_packings() {
    return {.tolerance = 1e-4, .impulse_tolerance = 1e-3, .accuracy = Accuracy::kPacking};
  }
  /// True if, without a fluid, sweeps from the impulses of the step before are the fastest method.
  /// With smaller tolerances steps of Newton's method are.
  bool suits_sweeps() const { return tolerance >= 5e-5 && impulse_tolerance >= 1e-4; }
};

/// Largest magnitude [L] of a coordinate, and of a component of a displacement in a step. Beyond
/// this length the rounding errors of positions exceed the allowed error of a gap, `tolerance`
/// (SolverSettings) times `mean_radius` [L].
inline double largest_resolved_distance(double tolerance, double mean_radius) {
  // Squares of distances must be finite: 1e120 is far below 1e154, the root of the largest double.
  constexpr double kFinite = 1e120;
  return std::min(kFinite, tolerance * mean_radius / std::numeric_limits<double>::epsilon());
}

struct PlaneMotion;

/// Motion of a driven particle, which no force changes. Either velocity is 0 after its last piece.
struct GivenMotion {
  PiecewiseConstant velocity;          ///< velocity of the centre [L/T]
  PiecewiseConstant angular_velocity;  ///< in component 2 [1/T], > 0 if counter-clockwise
};

/// The time to which the velocities after a step belong, docs/physics.md (5.3) and (5.10). The step
/// ends at the time t [T] and has the length h [T].
enum class Scheme {
  kEuler,     ///< they belong to t; errors of positions are proportional to h
  kLeapfrog,  ///< they belong to t - h/2; away from impacts errors are proportional to h^2
};

/// All settings of a simulation, in any consistent units; masses and forces of discs in a fluid are
/// per length. The keys of the maps are numbers of existing particles, their places in the arrays
/// of Particles.
struct Setting {
  std::vector<Plane> planes;  ///< rigid planes, at rest or moving, that particles cannot cross
  Domain domain;
  Vector gravity{};  ///< acceleration of all particles [L/T^2]
  /// Forces on single particles in addition to gravity [M L/T^2].
  std::map<std::int32_t, PiecewiseConstant> forces;
  /// Friction needs particles that turn (add_rotation()).
  ContactLaws laws;
  std::vector<Source> sources{};  ///< must be empty with a fluid
  Links links;           ///< hinges, springs and arms; need particles that turn, except on an axis
  double time_step = 0;  ///< h [T], > 0
  Scheme scheme = Scheme::kEuler;  ///< must be kEuler with a fluid
  SolverSettings solver;
  std::optional<Fluid> fluid;                    ///< needs a domain
  std::optional<PairLubrication> lubrication{};  ///< not together with `fluid`
  /// Torques on single particles [M L^2/T^2], of discs in component 2, > 0 if counter-clockwise.
  /// They need particles that turn. A particle with a torque must not be in `given_motions`.
  std::map<std::int32_t, PiecewiseConstant> torques;
  /// Motions of the particles that are fixed or driven. A driven particle has no entry in `forces`,
  /// and gravity does not change its motion.
  std::map<std::int32_t, GivenMotion> given_motions;
  /// Forces [M L/T^2] on all particles in addition to gravity and `forces`, in the order of
  /// Particles::velocities; empty if there are none. A force on a driven particle has no effect.
  /// They may change between two steps (Simulation::added_forces()).
  std::vector<double> added_forces{}, added_torques{};  ///< torques [M L^2/T^2] in the order of
                                                        ///< Particles::angular_velocities
};

/// The periods [L], 0 along an axis that is not periodic, and the mean velocity gradient [1/T] of a
/// fluid with a linear flow.
PeriodicCell cell_of(const Setting& setting);

/// The force [M L/T^2] that is added on particle k; 0 if there are none.
inline Vector added_force(const Setting& setting, std::size_t k, int dimension) {
  if (setting.added_forces.empty()) return {};
  assert((k + 1) * static_cast<std::size_t>(dimension) <= setting.added_forces.size());
  return point_of(setting.added_forces.data(), k, dimension);
}

/// The torque [M L^2/T^2] that is added on particle k, of a disc in component 2; 0 if there are
/// none.
inline Vector added_torque(const Setting& setting, std::size_t k, int dimension) {
  if (setting.added_torques.empty()) return {};
  assert((k + 1) * turn_components(dimension) <= setting.added_torques.size());
  if (dimension == 3) return point_of(setting.added_torques.data(), k, 3);
  return {0, 0, setting.added_torques[k]};
}

/// Setting::added_forces [M L/T^2], extended by zeros to one entry for each velocity component.
inline std::span<double> added_forces_for(const Particles& particles, Setting& setting) {
  setting.added_forces.resize(particles.velocities.size());
  return setting.added_forces;
}

/// The same for added_torques [M L^2/T^2]; empty if the particles do not turn.
inline std::span<double> added_torques_for(const Particles& particles, Setting& setting) {
  setting.added_torques.resize(particles.angular_velocities.size());
  return setting.added_torques;
}

/// The walls of the domain, then the planes, where they were at time 0. In files obstacle k,
/// counted from 0, has the number -1 - k.
std::vector<Plane> obstacles_of(const Setting& setting);

/// The same obstacles, with planes under a load moved by `motions` (State::planes), so that
/// Plane::at() gives their present places.
std::vector<Plane> obstacles_of(const Setting& setting, std::span<const PlaneMotion> motions);

}  // namespace viscontact::particles
