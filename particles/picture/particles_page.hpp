// A web page that plays a motion of particles by the scripts in particles/picture/page.
// run/particles_pages.cpp calls it. A change of the data's layout must be made in these scripts,
// too.
#pragma once

#include <string>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact::particles {

/// One HTML page that loads nothing from elsewhere. Lengths [L], times [T] and gamma ([M L/T], of
/// discs in a fluid [M/T]) are in the units of the case. The size of the page is limited to about
/// 24 MB. If a motion is too long for that, only every 2nd, 4th, ... frame is shown, and always the
/// first and the last one. If there are too many particles, only every n-th particle is shown. The
/// page says what it leaves out. Throws the errors of read_flow().
std::string particles_page(const Playback& original, const std::string& title);

}  // namespace viscontact::particles
