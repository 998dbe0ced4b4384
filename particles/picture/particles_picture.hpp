// Makes a still picture of a motion of particles, and a web page that plays the motion by the
// scripts in particles/picture/page. Lengths [L] and times [T] are in the units of the case.
// run/particles_pages.cpp calls both functions for the folder of a run. A flow that cannot be read
// throws Error(kBadInput); other faults of a motion, such as arrays of a wrong length, are not
// checked. A change must keep that each result is complete without other files. The largest numbers
// of panels and particles and the size of a page are free choices.
#pragma once

#include <string>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact::particles {

struct FlowFrames;

/// The text of an SVG with up to `panels` frames of the motion `original` at the same scale. The
/// frames are those nearest to evenly spaced times, each once. `panels` is limited to 1 to 6 and to
/// the number of frames. The first and the last frame are among them; a single panel shows the
/// last. Particles are drawn as discs in motions in the plane, and as spheres in motions in space,
/// which are seen from 20 degrees above with the third axis upwards. `title` is plain text and may
/// be empty. `known` may be the flows that particles_page() returned for the same motion, which are
/// then not read again; null if there are none. Throws Error(kBadInput), which names the file, if
/// the flow of a frame cannot be read.
std::string particles_picture(const Playback& original, const std::string& title, int panels,
                              const FlowFrames* known = nullptr);

/// The text of one HTML page that loads nothing from elsewhere and plays the motion. The size of
/// the page is limited to about 24 MB. If the motion is too long for that, only every 2nd, 4th, ...
/// frame is shown, and always the first and the last one; if two frames are still too large, no
/// contacts are shown. Of more than 200 000 particles only every n-th is shown. The page states
/// what it leaves out. `title` is plain text and may be empty. The flows that the page shows are
/// written to `flows`, unless it is null. Throws Error(kBadInput), which names the file, if the
/// flow of a frame cannot be read.
std::string particles_page(const Playback& original, const std::string& title,
                           FlowFrames* flows = nullptr);

}  // namespace viscontact::particles
