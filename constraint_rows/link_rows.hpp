// The equations that hinges, springs, arms and membranes impose on the motions of a time step,
// docs/physics.md (5.12) to (5.14) and (8.9) to (8.12).
#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {

/// What one unit, a rigid body or a particle without a body, adds to an equation: the inner product
/// of `direction` and the displacement of a point of the unit, or, with `is_turn`, its turn [rad].
struct LinkPart {
  std::int32_t particle = 0;  ///< the particle, or a member of the body
  /// A unit vector; of a membrane any vector [1], and [1/L] in rows for turns of beads. With
  /// `is_turn` the axis, in the plane (0, 0, 1) or (0, 0, -1).
  Vector direction{};
  Vector arm{};  ///< from the centre of the unit to the point [L]
  bool is_turn = false;
  /// Numbers of periods from the particle to the image to which the equation applies.
  Periods image{};
};

/// One equation: value + sum of the parts + compliance * impulse = 0 after the step, of
/// displacements [L] with an impulse [M L/T], or of turns [rad] with a moment of impulse [M L^2/T];
/// where a member has two dimensions, the first is that of displacements. In a sheared periodic
/// cell, h image_rate() is added to the sum, with the length h of the step.
struct LinkRow {
  /// Parts of all units that the link holds. A place in space, where a hinge is fixed, has none.
  std::vector<LinkPart> parts;
  /// Value if no unit moves: for example the distance of the ends of an arm before the step minus
  /// its length at the end of the step.
  double value = 0;
  double compliance = 0;  ///< >= 0 [T/M, T/(M L^2)]; 0: the link is rigid
  // In rows of springs, `value` and `compliance` are computed from these two.
  double extension = 0;  ///< before the step [L, rad]
  double stiffness = 0;  ///< > 0 [M/T^2, M L^2/T^2]; 0 for other links
  double length = 0;     ///< of the link that a row of rows_across() belongs to [L]; otherwise 0
};

/// The equations of one link. All rows have parts of the same units in the same order.
struct LinkEquations {
  /// kTorsion is the torsion spring of a hinge, kStop one of its stops. The last four belong to a
  /// membrane, a closed line through particles (beads): the distance of two neighbouring beads, the
  /// bending spring at a bead, the turn of a bead, and the area inside.
  enum class Kind { kHinge, kTorsion, kSpring, kArm, kStop, kDistance, kBend, kTurn, kArea };
  Kind kind = Kind::kArm;
  std::size_t number = 0;       ///< place of the link in its list in Links
  std::int32_t bead = 0;        ///< place in Membrane::beads; 0 for other links and the area
  std::size_t first_force = 0;  ///< place of the first row's force in State::link_forces
  /// At least one.
  std::vector<LinkRow> rows{};

  bool is_of_membrane() const {
    return kind == Kind::kDistance || kind == Kind::kBend || kind == Kind::kTurn ||
           kind == Kind::kArea;
  }
  /// True if the values of the rows are angles [rad] and their impulses moments.
  bool is_angle() const {
    return kind == Kind::kTorsion || kind == Kind::kTurn || kind == Kind::kStop;
  }
  /// True if the rows have a compliance > 0.
  bool is_spring() const {
    return kind == Kind::kTorsion || kind == Kind::kSpring || kind == Kind::kBend;
  }
  /// There is one part for each unit.
  const std::vector<LinkPart>& parts() const {
    assert(!rows.empty());
    return rows.front().parts;
  }
};

struct LinkTimes {
  double h = 0;             ///< length of the step [T], > 0
  double impulse_time = 0;  ///< time for which forces act on the velocities in it [T], > 0
  double end = 0;
  bool is_first = false;
  /// In a fluid with inertia the velocities of a step are those at its beginning. The ends of an
  /// arm then move apart with the mean rate of its length between these two times [T]; otherwise
  /// both are 0.
  double rate_from = 0;
  double rate_to = 0;

  /// Parameter of Newmark's method for springs [1]. With 1/4, the least stable value, a stiff
  /// spring that turns is in resonance with the turn of its direction where the phase of its
  /// vibration is a quarter of a turn a step, and gains energy without bound. With 1/2 the phase
  /// stays below a quarter. The first step takes twice the value, because no step before it has a
  /// share in the force.
  double beta() const { return is_first ? 1 : 0.5; }

  /// The same for the geometric stiffness, (5.21) [1]. With 1/4 the phase of a vibration goes up to
  /// half a turn a step; where it is a quarter, the change of the tension that a larger vibration
  /// causes is in resonance with it, and a double pendulum grows. With 1/2 the phase stays below a
  /// quarter. In the first step a velocity at the start has, with 3/8, the amplitude that it has in
  /// reality, if the step resolves it, and a smaller one otherwise.
  double beta_across() const { return is_first ? 0.375 * h / impulse_time : 0.5; }
};

/// The equations of all links, in the order of their forces in State::link_forces. Springs are
/// integrated by Newmark's method (Newmark 1959, "A method of computation for structural dynamics")
/// with beta = 1/2, which is stable for every stiffness and does not damp.
std::vector<LinkEquations> link_equations(const Links& links, const Particles& particles,
                                          const LinkTimes& times);

/// The equations of a membrane of N >= 3 beads without a fluid, in the order of its forces: N of
/// distances, N of turns, N of bending springs if the membrane resists bending, and one of the area
/// if it is kept. link_equations() sets `number` and `first_force`. Beads at one place give numbers
/// that are not finite.
std::vector<LinkEquations> membrane_equations(const Membrane& membrane, const Particles& particles,
                                              const LinkTimes& times);

/// The stops of all hinges of discs. A row is the angle that is left to the stop [rad], >= 0 after
/// a step. Its moment of impulse >= 0, which is 0 if the angle is > 0, is added to that of the
/// torsion spring, at the same place in State::link_forces.
std::vector<LinkEquations> stop_equations(const Links& links, const Particles& particles);

/// Numbers of periods from a particle to its image that belongs to its rigid body; 0 without a
/// body.
Periods periods_in_unit(const Particles& particles, std::int32_t particle);

/// Rate at which the sum of the parts of a row changes [L/T, 1/T] because images move relative to
/// their particles; 0 unless the cell is sheared.
double image_rate(const LinkRow& row, const PeriodicCell& cell);

struct UnitMotion {
  Vector displacement{},  ///< of the centre [L]
      turn{};             ///< [rad]; that of a disc has only the component z
};

// In the following functions, `motions` has the motion of each unit of a link, in the order of the
// parts of its rows. Turns may be of any size. In a sheared periodic cell the motion of the images
// must be in the displacements.

/// The value is of first order in the turn [L, rad].
double value_of(const LinkPart& part, const UnitMotion& motion);

/// A copy for the places after the motions: LinkPart::arm has turned with its unit, and
/// LinkPart::direction of arms and springs is along the line between their ends; values stay as
/// they are.
LinkEquations turned_equations(const LinkEquations& equations, const Links& links,
                               const Particles& particles, std::span<const UnitMotion> motions);

/// For each row its value plus the sum of its parts after these motions [L, rad]. The parts are its
/// derivatives. The result is exact, except for springs, where it is of first order in the motions.
std::vector<double> values_after(const LinkEquations& equations, const Links& links,
                                 const Particles& particles, const LinkTimes& times,
                                 std::span<const UnitMotion> motions);

double extension_after(const LinkEquations& spring, const Links& links, const Particles& particles,
                       std::span<const UnitMotion> motions);

/// By how much a distance is too large [L], a bead turns more than the line between its neighbours
/// [rad], or the area is too large over the mean distance of neighbours [L], after these motions.
double membrane_value_after(const LinkEquations& equations, const Membrane& membrane,
                            const Particles& particles, std::span<const UnitMotion> motions);

/// Rate at which the length of an arm grows at the present places [L/T]. `first` and `second` are
/// the velocities of the units of its ends, in [L/T] and [1/T].
double rate_of_arm(const Arm& arm, const Particles& particles, const UnitMotion& first,
                   const UnitMotion& second);

/// Name of a link in messages, such as "arm 2 (particles 3 and 4)": with its number from 0, as in
/// the files of a run, and the ids of particles.
std::string name_of(const LinkEquations& equations, const Links& links, const Particles& particles);

}  // namespace viscontact::particles
