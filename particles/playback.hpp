// The frames of a simulation, kept to be drawn.
#pragma once

#include <vector>

#include "particles/plane.hpp"
#include "particles/simulation.hpp"

namespace viscontact::particles {

/// What is there at one time.
struct Frame {
  double time = 0;  ///< [T]
  std::vector<float>
      positions;  ///< flat [L], the numbers of `dimension` for each particle: enough for a picture
  std::vector<PlanePlace> planes;    ///< in the order of the case
  std::vector<ContactNow> contacts;  ///< glued (gamma < 0) or touching
};

/// What a page or a picture shows.
struct Playback {
  int dimension = 2;
  std::vector<float> radii;   ///< [L]
  std::vector<Frame> frames;  ///< in order of time; the first at the start
};

}  // namespace viscontact::particles
