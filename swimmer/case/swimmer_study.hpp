// The sweep over the strokes of a swimmer: its displacement, energy and efficiency at each point,
// from one fit of the resistance matrices. Lengths, masses and times are in the units of the case.
// `sweep` calls it. The names of the columns must stay, for users' scripts.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/sweep/study.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"

namespace viscontact::swimmer {

/// The study of the case at `case_path`. Its results are displacement [L], energy [M L^2/T^2],
/// energy_at_constant_power [M L^2/T^2] and efficiency [1] if the case has [stroke], and the same
/// with the prefix "optimal." if it has [optimal]. Each point uses `fit`, scaled to it.
/// `version` is that of Viscontact.
///
/// Reads the case. Throws Error(kBadInput) if the first or the last point gives no valid case, or
/// if the fit is that of other ratios of radii, or, scaled, of another container. Throws
/// Error(kWrongUsage) if nothing is varied, if a key is varied twice or changes the table, or if
/// the case has no stroke.
sweep::Study swimmer_study(const std::filesystem::path& case_path, sweep::Points points,
                           const ResistanceFit& fit, const std::string& version);

}  // namespace viscontact::swimmer
