// The sweep of a case of one sphere near a wall (docs/file-formats.md), in the units of the case.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::sweep {

struct SpherePlan {
  std::filesystem::path case_path;  ///< whose keys are varied
  /// The fit of the drag, which is scaled to each point; none if its `basis` is empty.
  lubrication::Fit fit;
  lubrication::OutsideInterval outside;  ///< which drag is used outside the gaps of the fit
  Points points;                         ///< with at least one variation; `draws` is 0
  std::vector<std::string> models;       ///< at least one
  /// The model with which the others are compared, one of `models`. If it is empty, it is the usual
  /// reference (reduced_model::usual_reference()) if that is one of `models`, or else the first.
  std::string reference;
};

/// The plan that the sections [sweep] and [fit] of a case ask for. Variations, fit and reference
/// are empty if the case does not give them; if the case names no models, they are those of
/// reduced_model::sweep_models(). Throws Error(kBadInput) if a range in [sweep] is not valid or the
/// fit file cannot be read. sphere_study() checks models and keys.
SpherePlan planned_sphere(const case_file::Case& c);

/// The study of a plan. Its results are, for each model, MODEL.minimal_gap [L],
/// MODEL.minimal_gap_time [T], MODEL.film_from_gamma [L] (as in a comparison), MODEL.contact_from
/// [T], MODEL.contact_until [T], MODEL.sup_gap_distance [L], MODEL.l1_gap_distance [L T] and
/// MODEL.l1_velocity_distance [L] (largest difference of the gap and integrals over time of the
/// differences of gap and velocity to the reference), MODEL.film_ratio [1] (thinnest film or
/// smallest gap, over that of the reference), MODEL.steps (a whole number),
/// MODEL.solid_contact_from [T] and MODEL.solid_contact_velocity [L/T] (empty if the solids do not
/// touch). The results of a model that fails are empty, and so are all distances and ratios if the
/// reference fails; of the Errors of a row only Error(kInterrupted) is thrown. `version` is the
/// version of Viscontact, for the head of the file.
///
/// Reads the case. Throws Error(kBadInput) if the case cannot be read or has no [motion], if a
/// model is unknown, if the first or the last point of the plan gives no valid case, or if the fit
/// cannot be scaled to such a point. Throws Error(kWrongUsage) if nothing is varied, if the grid
/// has more than 1e12 points, if there is no fit, if the reference is not one of the models, if a
/// key or a model occurs twice, or if a key changes no row, because a sweep does not read it or
/// none of the models depends on it. If the ranges are in the case, a fault of the ranges or their
/// keys is an Error(kBadInput).
Study sphere_study(SpherePlan plan, const std::string& version);

}  // namespace viscontact::sweep
