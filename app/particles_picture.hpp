// A motion of particles as a still picture, and what that has in common with the page that plays it (app/particles_page.hpp).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "particles/playback.hpp"

namespace viscontact {

/// An SVG: `panels` (1 to 6; no more than there are frames) states at evenly spaced times, the first and the last among them (one panel: the
/// last), side by side at the same scale. Discs as they are, spheres seen from a little above with the third axis upwards.
std::string particles_picture(const particles::Playback& playback, const std::string& title,
                              int panels);

/// A box [L].
struct Room {
  particles::Vector low{}, high{};
};

/// What a view of these frames should hold: all particles, or the central 98 % of each frame if the others have flown far away, and the planes
/// next to them. Never flat in a direction of the playback's.
Room room_of(const particles::Playback& playback, const std::vector<std::size_t>& frames);

/// The most negative gamma of all frames; 0 if no film holds.
double lowest_gamma(const particles::Playback& playback);

/// "#rrggbb" for gamma/lowest, from 0 (light) to 1 (dark): viridis, which colour-blind readers tell apart, and prints in grey.
std::string film_colour(double share);

/// Round numbers from `lowest` < 0 to 0, in falling order.
std::vector<double> film_ticks(double lowest);
std::string film_tick_text(double tick);

inline constexpr const char* kFilmWords = "gamma: what the film remembers [mass × length/time]";
inline constexpr const char* kTouchingColour = "#5a5a5a";  ///< of contacts without film

}  // namespace viscontact
