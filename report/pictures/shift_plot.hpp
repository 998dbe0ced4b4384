// The picture of `viscontact shift`: the depth below the crests of a rough wall at which a smooth
// wall has the same drag (fitting/wall_shift.hpp).
#pragma once

#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/text/text_kind.hpp"
#include "viscontact/fitting/wall_shift.hpp"

namespace viscontact::report {

/// A picture of the `kind` kSvg, kPdf or kPng with two panels over the gap: the shift of each row
/// beside the common shift [L], and the relative residuals with the common shift. `wall` names the
/// wall in the title. Throws Error(kExternalProgram) if gnuplot is missing or fails.
std::string plot_wall_shift(const fitting::WallShift& shift, const std::string& wall, TextKind kind,
                            const StopToken& stop = {});

}  // namespace viscontact::report
