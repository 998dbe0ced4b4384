// The record of a collision of two solids that rebound, for rebounds.csv. Lengths, masses and times
// are in the units of the case file. impacts/ and fluid/ make it; particles/io and run/ write it,
// and python/ returns it. Numbers of particles and obstacles count from 0. A change must keep the
// columns of rebounds.csv.
#pragma once

#include <cstdint>

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

}  // namespace viscontact::particles
