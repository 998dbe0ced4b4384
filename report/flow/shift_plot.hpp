// The shift of a rough wall against the gap, and how well one shift serves all.
#pragma once

#include <string>

#include "viscontact/fitting/wall_shift.hpp"

namespace viscontact {

/// An SVG element of two panels: each row's own shift beside the common one, and the relative residuals of the common one. `wall` says
/// which wall, for the title. Throws Error(kExternalProgram) if gnuplot is missing or fails.
std::string plot_wall_shift(const WallShift& shift, const std::string& wall);

}  // namespace viscontact
