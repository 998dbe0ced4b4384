// Declares the records of collisions of solids that rebound. The tables rebounds.csv (struct
// Rebound), walls.csv and stress.csv (struct BlowImpulse) are made from them. Lengths, masses and
// times are in the units of the case file. impacts/ and fluid/ make the records, particles/io and
// run/ write them, and python/ returns rebounds. Numbers of particles and obstacles count from 0.
// Nothing is checked or thrown. A change must keep the columns of rebounds.csv, which are the
// members of Rebound in their order, with ids of particles in place of numbers. At an obstacle, the
// column `first` has the id of the particle, and `second` the number of the obstacle.
#pragma once

#include <cstdint>

#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// One contact of a blow, docs/physics.md (5.15) and (6.11). A blow is one collision of connected
/// particles, with all contacts that are hit at one time. In its first phase, the compression, the
/// surfaces stop approaching each other. In its second phase, the restitution, the solids push each
/// other apart with a part of the impulse of the compression.
struct Rebound {
  double time = 0;          ///< time of the blow [T]
  std::int32_t first = -1;  ///< number of a particle, or -1 - k for obstacle k
  std::int32_t second = 0;  ///< number of a particle
  /// Rate at which the gap changes before the blow [L/T], < 0. In a fluid it is 0 if the contact is
  /// not hit itself but pressed by the blow of another contact.
  double approach_velocity = 0;
  /// Normal impulse of the compression without the part that the fluid film absorbed, > 0 [M L/T];
  /// for discs in a fluid it is an impulse per length [M/T].
  double solid_impulse = 0;
  double velocity = 0;  ///< rate at which the gap changes after the blow [L/T], >= 0
};

/// The whole impulse of one contact of a blow in a case without a fluid: of the solids and the
/// film of the contact, normal and tangential. In a fluid these records are not made.
struct BlowImpulse {
  std::int32_t first = -1;  ///< number of a particle, or -1 - k for obstacle k
  Vector impulse{};         ///< impulse on the second particle [M L/T], of any direction
  /// Vector [L] to the centre of the second particle from that of the first or the nearest point of
  /// the obstacle.
  Vector branch{};
};

}  // namespace viscontact::particles
