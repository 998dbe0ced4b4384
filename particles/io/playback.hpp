// The frames of a simulation, kept to be drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/particles/current_contacts.hpp"
#include "viscontact/particles/plane.hpp"

namespace viscontact::particles {

/// What is there at one time.
struct Frame {
  double time = 0;  ///< [T]
  std::vector<float>
      positions;  ///< flat [L], the numbers of `dimension` for each particle: enough for a picture
  std::vector<PlanePosition> planes;     ///< in the order of the case
  std::vector<CurrentContact> contacts;  ///< glued (gamma < 0) or touching
};

/// What a page or a picture shows.
struct Playback {
  int dimension = 2;
  std::vector<float> radii;         ///< [L]
  std::vector<Frame> frames;        ///< in order of time; the first at the start
  std::vector<std::int32_t> ids{};  ///< as in Particles
};

/// Of particle k [L].
inline Vector position(const Playback& playback, const Frame& frame, std::size_t k) {
  Vector x{};
  const auto dimension = static_cast<std::size_t>(playback.dimension);
  for (std::size_t d = 0; d < dimension; ++d) x[d] = frame.positions[k * dimension + d];
  return x;
}

}  // namespace viscontact::particles
