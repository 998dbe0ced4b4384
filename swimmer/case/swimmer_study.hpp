// The sweep over the strokes of a swimmer (spheres on a line whose distances change in time): its
// displacement, energy and efficiency at each point, from one fit of the resistance matrices.
// Lengths, masses and times are in the units of the case. The command `sweep` calls it. A wrong
// case or fit throws Error(kBadInput), a wrong choice of what varies Error(kWrongUsage), both
// before a row is computed. A change must keep the names of the columns, which users' scripts read.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/sweep/study.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"

namespace viscontact::swimmer {

/// The study of the case at `case_path`. Its results are displacement [L], energy [M L^2/T^2],
/// energy_at_constant_power [M L^2/T^2] and efficiency [1] in a period (SwimSums) if the case has
/// [stroke], and the same with the prefix "optimal." for the stroke of least energy if it has
/// [optimal]. At each point `fit` is scaled to viscosity and radii of the case. Results that cannot
/// be computed at a point are empty there. `version` is that of Viscontact.
///
/// Reads the case. Throws Error(kBadInput) if the first or the last point gives no valid case, if
/// the radii of the case have other ratios than those of `fit`, or if the scaled fit has another
/// container. Throws Error(kWrongUsage) if nothing is varied, if a key is varied twice or would
/// need another fit, or if the case has no stroke.
sweep::Study swimmer_study(const std::filesystem::path& case_path, sweep::Points points,
                           const ResistanceFit& fit, const std::string& version);

}  // namespace viscontact::swimmer
