// A still picture of a motion of particles, and a web page that plays it by the scripts in
// particles/picture/page. Lengths [L], times [T] and gamma ([M L/T], of discs in a fluid [M/T]) are
// in the units of the case. run/particles_pages.cpp calls both. A change must keep them complete
// without other files.
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

/// One HTML page that loads nothing from elsewhere and plays the motion. The size of the page is
/// limited to about 24 MB. If a motion is too long for that, only every 2nd, 4th, ... frame is
/// shown, and always the first and the last one. If there are too many particles, only every n-th
/// particle is shown. The page says what it leaves out. Throws the errors of read_flow().
std::string particles_page(const Playback& original, const std::string& title);

}  // namespace viscontact::particles
