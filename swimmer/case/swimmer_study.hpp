// A sweep over the strokes of a swimmer, with one fit of the resistance matrices.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/sweep/study.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"

namespace viscontact::swimmer {

/// The study of the case at `case_path`. If the case has the section [stroke], the results are
/// displacement [L], energy [M L^2/T^2], energy_at_constant_power [M L^2/T^2] and efficiency [1] in
/// a period (SwimSums). If the case has the section [optimal], the results of the stroke of least
/// energy have the same names with the prefix "optimal.". At each point `fit` is scaled to
/// viscosity and radii of the case. A stroke that fails leaves its columns empty, and the column
/// `failure` says why. `version` is the version of Viscontact, for the head of the file.
///
/// Throws Error(kBadInput) if the case cannot be read, if the first or the last point gives no
/// valid case, if the radii of the case have other ratios than those of `fit`, or if they differ
/// and the scaled fit has another container than the case. Throws Error(kWrongUsage) if nothing is
/// varied, if the grid has more than 1e12 points, if a key is varied twice or is not
/// fluid.viscosity or a key of [stroke] or [optimal], or if the case has no stroke. If the ranges
/// are in the case, a fault of the ranges is an Error(kBadInput).
sweep::Study swimmer_study(const std::filesystem::path& case_path, sweep::Points points,
                           const ResistanceFit& fit, const std::string& version);

}  // namespace viscontact::swimmer
