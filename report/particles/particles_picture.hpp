// A still picture of a motion of particles; the page of report/particles/particles_page.hpp plays
// the motion.
#pragma once

#include <string>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact::report {

/// An SVG with `panels` (1 to 6, at most the number of frames) states at evenly spaced times, side
/// by side at the same scale. The first and the last frame are among them; with one panel it is the
/// last. Motions in the plane are drawn as discs; motions in space as spheres, seen from a little
/// above with the third axis upwards.
std::string particles_picture(const particles::Playback& playback, const std::string& title,
                              int panels);

}  // namespace viscontact::report
