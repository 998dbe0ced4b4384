// A web page that plays a motion of particles (report/particles/page/particles.js). The layout of
// its data must be changed here and in that script together.
#pragma once

#include <string>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact::report {

/// One HTML page that loads nothing from elsewhere. Its size is limited to about 24 MB: of a long
/// motion only every 2nd, 4th, ... frame is shown, always with the first and the last, and of very
/// many particles only one in several. The page says so.
std::string particles_page(const particles::Playback& playback, const std::string& title);

}  // namespace viscontact::report
