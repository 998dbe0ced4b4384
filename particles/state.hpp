// All that the future of a simulation depends on, besides its case.
#pragma once

#include <cstdint>
#include <vector>

#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// What the film between two particles, or a particle and a plane, remembers.
struct Film {
  std::int32_t first = 0;   ///< particle, or -1 - k: plane k
  std::int32_t second = 0;  ///< particle, > first
  double gamma = 0;         ///< gamma_min <= gamma <= 0 [M L/T]
  double impulse = 0;       ///< h lambda of the last step [M L/T]: where the next projection starts
  /// The residuals and rounding errors of the impulses that gamma is the sum of, added up [M L/T]:
  /// what the solver may have made gamma wrong by. 0 at the bounds of gamma, which are known.
  double gamma_error = 0;
  bool operator==(const Film&) const = default;
};

/// To begin with: particles, all else as it is.
struct State {
  Particles particles;
  double time = 0;         ///< [T]
  std::int64_t steps = 0;  ///< done
  /// The steps' times are start + k h since this step: 0, or where a step was cut short or a restart changed h.
  double grid_time = 0;
  std::int64_t grid_step = 0;
  std::vector<Film> pairs;  ///< all that may touch soon, in order of first, second
  std::vector<Film> walls;  ///< particles at planes, in order of plane, particle
  // When `pairs` was made: pairs that are not in it cannot touch while no particle is further than its reach from where it was.
  std::vector<double> positions_at_listing;  ///< flat [L]; empty: no list yet
  std::vector<double> reaches;               ///< [L]
};

}  // namespace viscontact::particles
