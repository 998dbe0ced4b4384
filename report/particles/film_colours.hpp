// Colours for gamma, and the numbers on the scale of these colours, for the picture and the page of
// a motion of particles. gamma is minus the impulse that a film has
// absorbed [M L/T], of discs in a fluid per length [M/T].
#pragma once

#include <string>
#include <vector>

#include "viscontact/particles/io/playback.hpp"

namespace viscontact::report {

/// The most negative gamma of all frames; 0 if no contact has gamma < 0.
double lowest_gamma(const particles::Playback& playback);

/// True if a contact of the frame has gamma = 0.
bool has_contact_without_film(const particles::Frame& frame);

/// True if a contact of the frame slides.
bool has_sliding_contact(const particles::Frame& frame);

/// The colour "#rrggbb" for share = gamma/lowest from 0 (light) to 1 (dark).
std::string film_colour(double share);
/// The colour of one of `levels` evenly spaced shares, the first of which is 0.
std::string film_colour(int level, int levels);

/// Round numbers from `lowest` < 0 to 0 for the scale, in decreasing order.
std::vector<double> film_ticks(double lowest);
std::string film_tick_text(double tick);

/// What the scale of gamma shows, with its dimension.
const char* film_words(const particles::Playback& playback);
inline constexpr const char* kTouchingColour = "#5a5a5a";  ///< for contacts with gamma = 0
inline constexpr const char* kSlidingColour = "#d55e00";   ///< for contacts that slide

}  // namespace viscontact::report
