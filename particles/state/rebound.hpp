// The records of collisions of solids that rebound.
#pragma once

#include <cstdint>

#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// One contact of an impact, docs/physics.md (5.15) and (6.11), in the order of the columns of
/// rebounds.csv. In the compression the surfaces stop approaching each other. In the restitution
/// the solids push each other apart with a part of its impulse.
struct Rebound {
  double time = 0;          ///< of the impact [T]
  std::int32_t first = -1;  ///< number of a particle, or -1 - k for obstacle k
  std::int32_t second = 0;  ///< number of a particle
  /// Rate at which the gap changes before the impact [L/T], < 0. In a fluid it is 0 if the contact
  /// is pressed only by the impact of another contact.
  double approach_velocity = 0;
  /// Normal impulse of the compression without the part of the fluid film, > 0 [M L/T]; for discs
  /// in a fluid it is an impulse per length [M/T].
  double solid_impulse = 0;
  double velocity = 0;  ///< rate at which the gap changes after the impact [L/T], >= 0
};

/// The impulse of one contact of an impact in a case without a fluid: of the solids and the film,
/// normal and tangential.
struct ImpactImpulse {
  std::int32_t first = -1;  ///< number of a particle, or -1 - k for obstacle k
  Vector impulse{};         ///< on the second particle [M L/T]
  /// Vector [L] to the centre of the second particle from that of the first or the nearest point of
  /// the obstacle.
  Vector branch{};
};

}  // namespace viscontact::particles
