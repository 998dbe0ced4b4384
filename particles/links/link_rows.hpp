// The equations of hinges, springs and arms in a time step, docs/physics.md (5.12) to (5.14), and
// those of membranes without a fluid (membranes/necklace.hpp).
// Lengths, masses and times are in the units of the case. Equations of displacements [L] have
// impulses [M L/T], equations of turns [rad] moments of impulses [M L^2/T]; where a member has two
// dimensions, the first is that of displacements. constraints/ and fluid/ solve the equations.
// Nothing is thrown. A change must keep the order of forces in State::link_forces.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// Part of an equation. A unit is a particle without a body, or a rigid body. The part is the inner
/// product of `direction` and the displacement of the point at `arm` from the centre of a unit, or
/// with its component along z the turn of the unit about z.
struct LinkPart {
  std::int32_t particle = 0;  ///< number of the particle, or of a member of the body
  /// A unit vector; of membranes a vector [1, 1/L]. With `is_turn` (0, 0, 1) or (0, 0, -1).
  Vector direction{};
  Vector arm{};          ///< [L]
  bool is_turn = false;  ///< true: the turn about z; false: the displacement
  /// Numbers of periods from the particle to the image of it that the equation means.
  Periods image{};
};

/// One equation of a link: value + sum of the parts + compliance * impulse = 0 after the step. The
/// parts are motions of images: in a sheared cell, those of the particles and image_rate().
struct LinkRow {
  std::vector<LinkPart> parts;  ///< of all units that the link holds; what is fixed has none
  /// What is left of the equation at the places before the step, with the length that an arm has at
  /// the end of the step [L, rad].
  double value = 0;
  double compliance = 0;  ///< [T/M, T/(M L^2)]; 0: the equation holds whatever impulse it needs
  // Of springs: value and compliance follow from these two.
  double extension = 0;  ///< before the step [L, rad]
  double stiffness = 0;  ///< [M/T^2, M L^2/T^2]
};

/// The equations of one link, and what they are called. All have parts of the same units in one
/// order.
struct LinkEquations {
  /// The kind of link; kTorsion is the torsion spring of a hinge, kStop one of its stops. The last
  /// four are those of a membrane: the distance of two neighbours, the bending spring and the turn
  /// of a bead, and the area inside.
  enum class Kind { kHinge, kTorsion, kSpring, kArm, kStop, kDistance, kBend, kTurn, kArea };
  Kind kind = Kind::kArm;       ///< the kind of this link
  std::size_t number = 0;       ///< of the link in its list
  std::int32_t bead = 0;        ///< of a membrane: place in Membrane::beads; not of the area
  std::size_t first_force = 0;  ///< place of the force of the first row in State::link_forces
  /// The equations, at least one.
  std::vector<LinkRow> rows{};

  /// True for the four kinds of a membrane.
  bool is_of_membrane() const {
    return kind == Kind::kDistance || kind == Kind::kBend || kind == Kind::kTurn ||
           kind == Kind::kArea;
  }
  /// True if the rows are angles [rad] and their impulses moments.
  bool is_angle() const {
    return kind == Kind::kTorsion || kind == Kind::kTurn || kind == Kind::kStop;
  }
  /// True if the link gives way: its rows have a compliance, and are linear in the motion.
  bool is_spring() const {
    return kind == Kind::kTorsion || kind == Kind::kSpring || kind == Kind::kBend;
  }
  /// The parts of the first row, one for each unit.
  const std::vector<LinkPart>& parts() const { return rows.front().parts; }
};

/// The times of a step on which the equations of links depend.
struct LinkTimes {
  double h = 0;     ///< length of the step [T]
  double kick = 0;  ///< time for which forces act on the velocities in it [T]
  double end = 0;   ///< time at its end [T]
  /// Whether it is the first step of a simulation. There is no step before it, so that Newmark's
  /// method takes the change of an extension in that step from the rate at the start.
  bool is_first = false;
  /// Times [T] between which arms have their mean rate in the velocities, where these are not those
  /// of the step but at its beginning (a fluid with inertia); both 0 elsewhere.
  double rate_from = 0;
  double rate_to = 0;  ///< see rate_from

  /// Newmark's beta for springs: 1/4 is the least one that is stable for every stiffness. The first
  /// step has no step before it, whose share is its own.
  double beta() const { return is_first ? 0.5 : 0.25; }
};

/// The equations of all links. Springs are integrated by Newmark's method with beta = 1/4 (Newmark
/// 1959, "A method of computation for structural dynamics"), which is stable for every stiffness
/// and does not damp.
std::vector<LinkEquations> link_equations(const Links& links, const Particles& particles,
                                          const LinkTimes& times);

/// The stops of all hinges: each has one row, the angle that is left to the stop, which is not
/// negative after a step. It has a moment of impulse >= 0, and only where it is 0. The places of
/// their forces are those of the torsion springs.
std::vector<LinkEquations> stop_equations(const Links& links, const Particles& particles);

/// Numbers of periods from a particle to its image at the place in its body; 0 without a body.
Periods periods_in_unit(const Particles& particles, std::int32_t particle);

/// Rate at which the sum of the parts of a row changes [L/T] because images move relative to their
/// particles; 0 unless the cell is sheared.
double image_rate(const LinkRow& row, const PeriodicCell& cell);

/// Displacements and turns of the unit of a particle: 3 numbers each, of discs in the plane.
struct UnitMotion {
  Vector displacement{},  ///< [L]
      turn{};             ///< [rad]; only the component z in the plane
};

// In the following, `motions` are those of the units of a link, in the order of its parts. The
// units are the images that the rows mean, and turn by finite angles.

/// Value of a part for the motion of its unit, to first order in the turn [L, rad].
double value_of(const LinkPart& part, const UnitMotion& motion);

/// The equations with the directions of arms and springs, and the arms of parts, after these
/// motions; nothing else changes.
LinkEquations turned_equations(const LinkEquations& equations, const Links& links,
                               const Particles& particles, std::span<const UnitMotion> motions);

/// Values of the rows of a link after these motions [L, rad], without compliance times impulse.
std::vector<double> values_after(const LinkEquations& equations, const Links& links,
                                 const Particles& particles, const LinkTimes& times,
                                 std::span<const UnitMotion> motions);

/// Extension of a spring (kSpring) after these motions [L].
double extension_after(const LinkEquations& spring, const Links& links, const Particles& particles,
                       std::span<const UnitMotion> motions);

/// Rate at which the length of an arm grows, to first order, in the direction of the beginning of a
/// step [L/T]. `first` and `second` are velocities and angular velocities of the units of its ends.
double rate_of_arm(const Arm& arm, const Particles& particles, const UnitMotion& first,
                   const UnitMotion& second);

/// "arm 2 (particles 3 and 4)": the name of a link in messages, with its number from 0 on, as in
/// files, and the ids of its particles.
std::string name_of(const LinkEquations& equations, const Links& links, const Particles& particles);

}  // namespace viscontact::particles
