// A motion of particles as a web page that plays it.
#pragma once

#include <string>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact {

/// One HTML page that needs nothing else. Never above about 24 MB: of a long motion every 2nd, 4th, ... frame is shown, the first and the last
/// always, and of very many particles one in a few; the page says so.
std::string particles_page(const particles::Playback& playback, const std::string& title);

}  // namespace viscontact
