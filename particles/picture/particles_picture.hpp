// A still picture of a motion of particles; the page of particles_page.hpp plays the motion.
// Lengths, masses and times are in the units of the case. run/particles_pages.cpp calls it. A
// change must keep the SVG complete without other files.
#pragma once

#include <string>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact::particles {

/// An SVG with up to `panels` states, side by side at the same scale: the frames nearest to evenly
/// spaced times, each once. `panels` is limited to 1 to 6 and to the number of frames. The first
/// and the last frame are among them; a single panel shows the last. Particles are drawn as discs
/// in motions in the plane, and as spheres in motions in space, which are seen from a little above
/// with the third axis upwards. Throws the errors of read_flow().
std::string particles_picture(const Playback& original, const std::string& title, int panels);

}  // namespace viscontact::particles
