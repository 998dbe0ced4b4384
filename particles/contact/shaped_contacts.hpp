// Contacts of particles in the plane of which one is not round.
#pragma once

#include <span>
#include <variant>

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

 private:
  std::variant<ShapeContacts, WallContacts> contacts_;
};

}  // namespace viscontact::particles
