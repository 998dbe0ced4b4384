// The sweep of a case of one sphere near a wall: it varies keys of the case, and each row has the
// smallest gap, the thinnest film and the distance from a reference of several models of motion
// (docs/file-formats.md). Lengths, masses and times are in the units of the case. The command
// `sweep` calls it. A wrong case or fit throws Error(kBadInput), a wrong choice of what varies
// Error(kWrongUsage), both before a row is computed. A model that fails throws nothing: its results
// are empty. A change must keep the names of the columns, which users' scripts read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::sweep {

/// What is computed at each point of the sweep.
struct SpherePlan {
  std::filesystem::path case_path;  ///< the case whose keys are varied
  lubrication::Fit fit;  ///< of the drag; scaled at each point; none if its `basis` is empty
  lubrication::OutsideInterval outside;  ///< drag outside the interval of the fit
  Points points;                         ///< at least one variation; `draws` is 0
  std::vector<std::string> models;       ///< names of models, at least one
  /// The model with which the others are compared, one of `models`; empty: that of
  /// reduced_model::reference_of().
  std::string reference;
};

/// The plan that the sections [sweep] and [fit] of a case ask for. Variations, fit and reference
/// are empty if the case does not give them. Throws Error(kBadInput) if a range in [sweep] is not
/// valid or the fit file cannot be read. Names of models and keys are not checked.
SpherePlan planned_sphere(const case_file::Case& c);

/// The study of a plan. Its results are, for each model, MODEL.minimal_gap [L],
/// MODEL.minimal_gap_time [T], MODEL.film [L] (thinnest film that a contact model computes),
/// MODEL.contact_from [T], MODEL.contact_until [T], MODEL.sup_gap_distance [L],
/// MODEL.l1_gap_distance [L T] and MODEL.l1_velocity_distance [L] (distances from the reference,
/// ModelComparison), MODEL.film_ratio [1] (thinnest film or smallest gap, over that of the
/// reference), MODEL.steps (a whole number), MODEL.solid_contact_from [T] and
/// MODEL.solid_contact_velocity [L/T] (empty if the solids do not touch). The results of a model
/// that fails are empty, and so are all distances and ratios if the reference fails; of the Errors
/// of a row only Error(kInterrupted) is thrown. `version` is that of Viscontact.
///
/// Reads the case. Throws Error(kBadInput) if the case cannot be read or has no [motion], if a
/// model is unknown, if the first or the last point of the plan gives no valid case, or if the fit
/// cannot be scaled to such a point. Throws Error(kWrongUsage) if nothing is varied, if the grid
/// has more than 1e12 points, if there is no fit, if the reference is not one of the models, if a
/// key or a model occurs twice, or if a key changes no row, because a sweep does not read it or
/// none of the models depends on it.
Study sphere_study(SpherePlan plan, const std::string& version);

}  // namespace viscontact::sweep
