// Sources, from which particles are poured in while a simulation runs. Lengths, masses and times
// are in the units of the case; nothing is thrown. Setting has them, and pouring.hpp pours. A
// change must keep the particles and the times of each source, because users repeat runs by their
// seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/particles/arrangement/species.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// A place where particles are poured in.
struct Source {
  std::vector<Species> species;   ///< not empty; with masses > 0
  Vector from{};                  ///< lowest corner of the box in which centres are put [L]
  Vector to{};                    ///< highest corner of that box [L], >= `from` in each component
  Vector velocity{};              ///< of each particle when it comes in [L/T]
  double rate = 0;                ///< particles per time [1/T], > 0
  double begin = 0;               ///< time of the first particle [T], >= 0
  double end = 0;                 ///< last time at which a particle is due [T], > `begin`
  std::size_t largest_count = 0;  ///< largest number of particles in all, >= 1
  std::uint64_t seed = 1;         ///< seed of radii and places

  /// The number of particles that are due at a time [T].
  std::size_t due(double time) const;
};

}  // namespace viscontact::particles
