// The records of a collision of two solids that rebound, for rebounds.csv, walls.csv and
// stress.csv. Lengths, masses and times are in the units of the case file. impacts/ and fluid/ make
// them; particles/io and run/ write them, and python/ returns rebounds. Numbers of particles and
// obstacles count from 0. Nothing is checked or thrown. A change must keep the columns of
// rebounds.csv.
#pragma once

#include <cstdint>

#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// One contact of a blow, docs/physics.md (5.15) and (6.11). A blow is a collision with all
/// contacts that are hit at one time. In its compression the surfaces stop approaching each other,
/// and in its restitution the solids give back a part of their impulse.
struct Rebound {
  double time = 0;          ///< of the blow [T]
  std::int32_t first = -1;  ///< number of a particle, or -1 - k for obstacle k
  std::int32_t second = 0;  ///< number of a particle
  /// Rate of the gap before the blow [L/T], < 0; in a fluid 0 if the contact is not hit itself but
  /// pressed by the blow of another contact.
  double approach_velocity = 0;
  /// Impulse that the solids took in the compression, without the part of the film, > 0 [M L/T], of
  /// discs in a fluid per length [M/T].
  double solid_impulse = 0;
  double velocity = 0;  ///< rate of the gap after the blow [L/T], >= 0
};

/// The whole impulse of one contact of a blow without a fluid, with its film and friction.
struct BlowImpulse {
  std::int32_t first = -1;  ///< number of a particle, or -1 - k for obstacle k
  Vector impulse{};         ///< on the second particle [M L/T]
  /// Vector [L] to the centre of the second particle from that of the first or the nearest point of
  /// the obstacle.
  Vector branch{};
};

}  // namespace viscontact::particles
