// Colours for the speed [L/T] of a flow, for the picture and the page of a motion of particles.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace viscontact::report {

/// The colour "#rrggbb" for share = speed / top speed from 0 (nearly white) to 1 (blue). The
/// colours are evenly spaced in lightness, and dark lines can be seen on all of them.
std::string speed_colour(double share);

/// Round speeds from 0 to `top` > 0 for the scale, with their texts.
std::vector<std::pair<double, std::string>> speed_ticks(double top);

inline constexpr const char* kSpeedWords = "speed of the fluid [length/time]";
inline constexpr const char* kPressureWords = "pressure less its mean [viscosity/time]";
inline constexpr const char* kStreamLineColour = "#12233f";

}  // namespace viscontact::report
