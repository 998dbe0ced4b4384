// A motion of particles as a still picture; report/particles/particles_page.hpp plays it.
#pragma once

#include <string>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact {

/// An SVG: `panels` (1 to 6; no more than there are frames) states at evenly spaced times, the first and the last among them (one panel: the
/// last), side by side at the same scale. Discs as they are, spheres seen from a little above with the third axis upwards.
std::string particles_picture(const particles::Playback& playback, const std::string& title,
                              int panels);

}  // namespace viscontact
