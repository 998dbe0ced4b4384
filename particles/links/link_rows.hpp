// The equations that hinges, springs, arms and membranes (the links) impose on the motions of
// particles and rigid bodies in a time step, docs/physics.md (5.12) to (5.14) and (8.9) to (8.12).
// Lengths, masses and times are in any consistent units. Equations of displacements [L] have
// impulses [M L/T], equations of turns [rad] moments of impulses [M L^2/T]; where a member has two
// dimensions, the first is that of displacements. Numbers and places count from 0. Nothing is
// checked or thrown. constraints/ and fluid/ solve the equations; simulation.cpp and run/ use them.
// A change must keep the order of forces in State::link_forces, which restart files store.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// What one unit, a rigid body or a particle without a body, adds to an equation. Without `is_turn`
/// this is the inner product of `direction` and the displacement of a point of the unit, otherwise
/// the turn of the unit about z [rad], times the third component of `direction`.
struct LinkPart {
  std::int32_t particle = 0;  ///< number of the particle, or of a member of the body
  /// A unit vector, or for a membrane any vector [1], in its rows of turns [1/L]. With `is_turn` it
  /// is (0, 0, 1) or (0, 0, -1).
  Vector direction{};
  Vector arm{};          ///< vector from the centre of the unit to the point [L]
  bool is_turn = false;  ///< true: the turn about z; false: the displacement
  /// Numbers of periods from the particle to its periodic image to which the equation applies.
  Periods image{};
};

/// One equation of a link: value + sum of the parts + compliance * impulse = 0 after the step. In a
/// sheared periodic cell, h image_rate() is added to the sum.
struct LinkRow {
  std::vector<LinkPart> parts;  ///< of all units that the link holds; a fixed end has none
  /// Value of the sum without motion [L, rad]: for example the distance of the ends of an arm
  /// before the step minus its length at the end of the step.
  double value = 0;
  double compliance = 0;  ///< >= 0 [T/M, T/(M L^2)]; 0: the link is rigid
  // Of springs: value and compliance are computed from these two.
  double extension = 0;  ///< before the step [L, rad]
  double stiffness = 0;  ///< > 0 [M/T^2, M L^2/T^2]; 0 for other links
};

/// The equations of one link. All rows have parts of the same units in the same order.
struct LinkEquations {
  /// The kind of link; kTorsion is the torsion spring of a hinge, kStop one of its stops. The last
  /// four belong to a membrane: the distance of two neighbouring beads, the bending spring at a
  /// bead, the turn of a bead, and the area inside.
  enum class Kind { kHinge, kTorsion, kSpring, kArm, kStop, kDistance, kBend, kTurn, kArea };
  Kind kind = Kind::kArm;       ///< the kind of this link
  std::size_t number = 0;       ///< place of the link in its list in Links
  std::int32_t bead = 0;        ///< of a membrane, except for its area: place in Membrane::beads
  std::size_t first_force = 0;  ///< place of the first row's force in State::link_forces
  /// The equations, at least one.
  std::vector<LinkRow> rows{};

  /// True for the four kinds of a membrane.
  bool is_of_membrane() const {
    return kind == Kind::kDistance || kind == Kind::kBend || kind == Kind::kTurn ||
           kind == Kind::kArea;
  }
  /// True if the values of the rows are angles [rad] and their impulses moments.
  bool is_angle() const {
    return kind == Kind::kTorsion || kind == Kind::kTurn || kind == Kind::kStop;
  }
  /// True if the link is elastic: its rows have a compliance > 0.
  bool is_spring() const {
    return kind == Kind::kTorsion || kind == Kind::kSpring || kind == Kind::kBend;
  }
  /// The parts of the first row, one for each unit. `rows` must not be empty.
  const std::vector<LinkPart>& parts() const { return rows.front().parts; }
};

/// The times of a step on which the equations of links depend.
struct LinkTimes {
  double h = 0;           ///< length of the step [T], > 0
  double kick = 0;        ///< time for which forces act on the velocities in it [T], > 0
  double end = 0;         ///< time at its end [T]
  bool is_first = false;  ///< whether it is the first step of a simulation
  /// In a fluid with inertia the velocities of a step are those at its beginning. The rate of an
  /// arm in them is then the mean rate of its length from the time rate_from to rate_to [T].
  /// Elsewhere both are 0.
  double rate_from = 0;
  double rate_to = 0;  ///< see rate_from

  /// Parameter of Newmark's method for springs [1]: 1/4 is the least one that is stable for every
  /// stiffness. The first step takes 1/2, because no step before it has a share in the force.
  double beta() const { return is_first ? 0.5 : 0.25; }
};

/// The equations of all links, in the order of their forces in State::link_forces. Springs are
/// integrated by Newmark's method (Newmark 1959, "A method of computation for structural dynamics")
/// with beta = 1/4, which is stable for every stiffness and does not damp.
std::vector<LinkEquations> link_equations(const Links& links, const Particles& particles,
                                          const LinkTimes& times);

/// The equations of a membrane without a fluid, in the order of its forces in State::link_forces: N
/// for the distances of neighbours, N for the turns of the N beads with the membrane, N for the
/// bending springs of the beads if it resists bending, and one for the area if it is kept. The
/// caller, link_equations(), sets `number` and `first_force`.
std::vector<LinkEquations> membrane_equations(const Membrane& membrane, const Particles& particles,
                                              const LinkTimes& times);

/// The stops of all hinges. Each has one row, the angle that is left to the stop [rad], which must
/// be >= 0 after a step. The stop exerts a moment of impulse >= 0, which is 0 where the angle is >
/// 0. Its force has the place of the torsion spring of the hinge. Only discs have stops.
std::vector<LinkEquations> stop_equations(const Links& links, const Particles& particles);

/// Numbers of periods from a particle to its image that belongs to its body; 0 without a body.
Periods periods_in_unit(const Particles& particles, std::int32_t particle);

/// Rate at which the sum of the parts of a row changes [L/T, 1/T] because images move relative to
/// their particles; 0 unless the cell is sheared.
double image_rate(const LinkRow& row, const PeriodicCell& cell);

/// Motion of a unit in a step.
struct UnitMotion {
  Vector displacement{},  ///< of its centre [L]
      turn{};             ///< [rad]; of discs only the component z
};

// In the following, `motions` are those of the units of a link, in the order of its parts, with
// finite turns. In a sheared periodic cell they contain the motion of the images.

/// Value of a part for the motion of its unit, to first order in the turn [L, rad].
double value_of(const LinkPart& part, const UnitMotion& motion);

/// A copy in which LinkPart::arm, and directions of arms and springs, are those after the motions.
LinkEquations turned_equations(const LinkEquations& equations, const Links& links,
                               const Particles& particles, std::span<const UnitMotion> motions);

/// For each row of a link its value plus the sum of its parts after these motions [L, rad]; of
/// springs to first order, otherwise exactly.
std::vector<double> values_after(const LinkEquations& equations, const Links& links,
                                 const Particles& particles, const LinkTimes& times,
                                 std::span<const UnitMotion> motions);

/// Extension of a spring (kSpring) after these motions [L], < 0 if it is compressed.
double extension_after(const LinkEquations& spring, const Links& links, const Particles& particles,
                       std::span<const UnitMotion> motions);

/// Value of the row of a distance, a turn or the area of a membrane after these motions of the
/// beads, which are in the order of the row's parts: the excess of the distance [L], of the turn
/// [rad], or of the area over the mean distance [L].
double membrane_value_after(const LinkEquations& equations, const Membrane& membrane,
                            const Particles& particles, std::span<const UnitMotion> motions);

/// Rate at which the length of an arm grows [L/T], with the direction that it has at the beginning
/// of a step. `first` and `second` are the velocities [L/T, 1/T] of the units of its ends.
double rate_of_arm(const Arm& arm, const Particles& particles, const UnitMotion& first,
                   const UnitMotion& second);

/// "arm 2 (particles 3 and 4)": the name of a link in messages, with its number from 0 on, as in
/// files, and the ids of its particles.
std::string name_of(const LinkEquations& equations, const Links& links, const Particles& particles);

}  // namespace viscontact::particles
