// What a film remembers, as a colour, with the scale beside it: for the picture of a motion and for the page that plays it.
#pragma once

#include <string>
#include <vector>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact {

/// The most negative gamma of all frames; 0 if no film holds.
double lowest_gamma(const particles::Playback& playback);

/// "#rrggbb" for gamma/lowest, from 0 (light) to 1 (dark).
std::string film_colour(double share);

/// Round numbers from `lowest` < 0 to 0, in falling order.
std::vector<double> film_ticks(double lowest);
std::string film_tick_text(double tick);

inline constexpr const char* kFilmWords = "gamma: what the film remembers [mass × length/time]";
inline constexpr const char* kTouchingColour = "#5a5a5a";  ///< of contacts without film

}  // namespace viscontact
