// A still picture of a motion of particles, and a web page that plays the motion.
#pragma once

#include <string>

#include "viscontact/particle_runs/io/playback.hpp"

namespace viscontact::particles {

struct FlowFrames;

/// The text of an SVG, complete in itself, with up to `panels` frames of the motion `original` at
/// the same scale. The frames are those nearest to evenly spaced times, each once. `panels` is
/// limited to 1 to 6 and to the number of frames. The first and the last frame are among them; a
/// single panel shows the last. Motions in space are seen from 20 degrees above with the third axis
/// upwards. `title` is plain text and may be empty. `known` may be the flows that particles_page()
/// returned for the same motion, which are then not read again. Throws Error(kBadInput), which
/// names the file, if the flow of a frame cannot be read.
std::string particles_picture(const Playback& original, const std::string& title, int panels,
                              const FlowFrames* known = nullptr);

/// The text of one HTML page that loads nothing from elsewhere and plays the motion, of at most
/// about 24 MB. If the motion is too long for that, only every 2nd, 4th, ... frame is shown, and
/// always the first and the last one; if two frames are still too large, no contacts are shown. Of
/// more than 200 000 particles only every n-th is shown. The page states what it leaves out. The
/// flows that the page shows are written to `flows`, unless it is null. Throws Error(kBadInput),
/// which names the file, if the flow of a frame cannot be read.
std::string particles_page(const Playback& original, const std::string& title,
                           FlowFrames* flows = nullptr);

}  // namespace viscontact::particles
