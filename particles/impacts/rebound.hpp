// A blow between solids that rebound, for rebounds.csv. Lengths, masses and times are in the units
// of the case. impacts/ and fluid/ make it, particles/io writes it. The columns of the file must
// stay.
#pragma once

#include <cstdint>

namespace viscontact::particles {

/// One contact of a blow, docs/physics.md (5.15) and (6.11).
struct Rebound {
  double time = 0;          ///< of the blow [T]
  std::int32_t first = -1;  ///< number of a particle, or -1 - k for obstacle k
  std::int32_t second = 0;  ///< number of a particle
  /// Rate of the gap before the blow [L/T], < 0; in a fluid 0 if the blow of another contact
  /// presses on this one.
  double approach_velocity = 0;
  double solid_impulse = 0;  ///< impulse that the solids took in the compression [M L/T], > 0
  double velocity = 0;       ///< rate of the gap after the blow [L/T], >= 0
};

}  // namespace viscontact::particles
