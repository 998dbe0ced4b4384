// Contacts of particles in the plane of which one is not round.
#pragma once

#include <array>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// True if both surfaces of the pair are round or straight, so that contact_of() gives its contact.
inline bool is_round(const Particles& particles, const Pair& pair) {
  return particles.is_round(index_of(pair.second)) &&
         (pair.first < 0 || particles.is_round(index_of(pair.first)));
}

/// ShapeContacts or WallContacts of a pair. `obstacles` are the places of all obstacles.
class ShapedContacts {
 public:
  ShapedContacts(const Particles& particles, const Pair& pair,
                 std::span<const PlanePosition> obstacles);
  /// The numbers of the contacts (Pair::place).
  std::span<const int> places() const;
  int contact_of(int place) const;
  /// The contact of `pair`, which has one of the numbers, after the particles and obstacles have
  /// moved.
  SurfaceContact at(const Particles& particles, const Pair& pair,
                    std::span<const PlanePosition> obstacles) const;
  /// The contact `place` of two particles after they have moved.
  SurfaceContact at(int place, const PlacedShape& first, const PlacedShape& second) const {
    return std::get<ShapeContacts>(contacts_).at(place, first, second);
  }
  /// The contact `place` with an obstacle.
  SurfaceContact at(int place, const PlanePosition& obstacle, const PlacedShape& second) const {
    return std::get<WallContacts>(contacts_).at(place, obstacle, second);
  }

 private:
  std::variant<ShapeContacts, WallContacts> contacts_;
};

/// The radii of the circles of a contact, for its laws. `obstacle` is null between two particles.
PairRadii radii_of(const SurfaceContact& contact, const PlanePosition* obstacle);

/// How a particle moves in a step.
struct ShapeMotion {
  Vector2 displacement{};  ///< [L]
  double turn = 0;         ///< counter-clockwise [rad]
};

/// The contact of a pair of which one surface is not round, in a step: where it begins, and its gap
/// after the step.
class ShapedContact {
 public:
  /// `particles` are at their places at the beginning of the step, and `obstacles` at its end.
  ShapedContact(const Particles& particles, const Pair& pair,
                std::span<const PlanePosition> obstacles);
  const SurfaceContact& at_start() const { return at_start_; }
  /// The gap [L] if the obstacle were at another place.
  double gap_at(const PlanePosition& obstacle) const;
  PairRadii radii() const { return radii_of(at_start_, is_at_obstacle_ ? &obstacle_ : nullptr); }
  /// A lower bound of the distance of the surfaces after the motions [L], of second order in them:
  /// the gap along the normal at the beginning of the step, or along this normal turned with a
  /// shape that has sides, if that is larger. For discs it is the linearised gap. Between two
  /// shapes with sides, and at an obstacle, it is the distance. The motion of an obstacle is that
  /// of a plane under a load.
  double gap_after(const ShapeMotion& first, const ShapeMotion& second) const;
  /// True if the motions, to first order, take the centres of the two circles past each other.
  bool pass(const ShapeMotion& first, const ShapeMotion& second) const;
  /// The distance of the surfaces after the motions [L].
  double distance(const ShapeMotion& first, const ShapeMotion& second) const;
  /// The larger magnitude of the turns of the shapes that are not round [rad].
  double turn(const ShapeMotion& first, const ShapeMotion& second) const;
  /// How far the turns of the shapes that are not round move the contact along the surfaces, over
  /// the sizes of these shapes [1], the larger one.
  double shift(const ShapeMotion& first, const ShapeMotion& second) const;

 private:
  PlacedShape moved(std::size_t side, const ShapeMotion& motion) const;

  ShapedContacts contacts_;
  int place_;
  std::array<PlacedShape, 2> shapes_;  // the first one is arbitrary at an obstacle
  std::array<double, 2> angles_{};
  bool is_at_obstacle_;
  PlanePosition obstacle_{};
  SurfaceContact at_start_;
  std::array<bool, 2> have_sides_{};
  double along_at_start_ = 0;  // the gap along the normal [L]
};

/// The contact of the two circles. `shaped` must outlive it.
Contact<2> contact_of(const Pair& pair, const ShapedContact& shaped);

/// The circles that touch both surfaces of a contact and have their radii of curvature; for discs
/// and spheres these surfaces.
struct SurfaceCircles {
  std::array<Vector, 2> centres{};  ///< from those of the particles [L]; 0 at an obstacle
  std::array<double, 2> radii{};    ///< [L]; 0 at an obstacle
};

template <int D>
SurfaceCircles circles_of(const Contact<D>& contact, const Particles& particles) {
  SurfaceCircles circles;
  if (contact.shaped == nullptr) {
    circles.radii[1] = particles.radii[index_of(contact.second)];
    if (contact.first >= 0) circles.radii[0] = particles.radii[index_of(contact.first)];
    return circles;
  }
  const auto& start = contact.shaped->at_start();
  circles.radii = start.radii;
  for (std::size_t k = 0; k < 2; ++k) circles.centres[k] = {start.arms[k][0], start.arms[k][1], 0};
  return circles;
}

/// ShapedContact::gap_after() or, if `is_distance`, distance() [L] after a step in which all
/// particles, and then all planes under a load, move by `displacements` [L] and `turns` [rad]. As
/// Contact::gap it contains the tolerated overlap. Contact::shaped must not be null.
double gap_after_turns(const Contact<2>& contact, std::span<const double> displacements,
                       std::span<const double> turns, bool is_distance);

/// ShapedContact::pass() of the same motions.
bool pass(const Contact<2>& contact, std::span<const double> displacements,
          std::span<const double> turns);

/// ShapedContact::turn() of the same motions.
double turn_of_shapes(const Contact<2>& contact, std::span<const double> displacements,
                      std::span<const double> turns);

/// True if a particle that is not round turns too far in the step, or so that its contact moves too
/// far along its surface, or if the circles of two particles move around each other by more than
/// kLargestTurn.
bool turns_too_far(const Contact<2>& contact, std::span<const double> displacements,
                   std::span<const double> turns);

/// Lists of contacts have this order, with the obstacles in the order -1, -2, ...
inline auto order_of(const Pair& pair) {
  return std::tuple(std::max(pair.first, -1 - pair.first), pair.second, pair.image, pair.place);
}

/// Adds the pair to `pairs`, once for each of its contacts.
void add_contacts_of(const Particles& particles, Pair pair,
                     std::span<const PlanePosition> obstacles, std::vector<Pair>& pairs);

/// The pairs `before` of the step before in the order of order_of(), with the numbers of the
/// present contacts. If two contacts became one, this one gets the memory of the contact with the
/// smaller gamma.
std::vector<Pair> at_present_places(std::vector<Pair> before, const Particles& particles,
                                    std::span<const PlanePosition> obstacles);

/// Changes `pairs`, which have the order of order_of(), so that each has exactly its present
/// contacts. They keep what contact laws remember.
void list_present_contacts(std::vector<Pair>& pairs, const Particles& particles,
                           std::span<const PlanePosition> obstacles);

}  // namespace viscontact::particles
