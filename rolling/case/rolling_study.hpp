// A sweep over the motions of a sphere along a plane, with one fit of the drag.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/rolling/case/rolling_case.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::rolling {

/// What is computed at each point of the sweep.
struct RollingPlan {
  std::filesystem::path case_path;  ///< the case whose keys are varied
  /// Fit of the drag (motions::PairFit), which is scaled to each point.
  std::filesystem::path fit_path;
  sweep::Points points;             ///< with at least one variation; `draws` is 0
  std::vector<std::string> models;  ///< names of rolling_models(); empty: those of the case
};

/// The plan that the sections [sweep] and [fit] of a case ask for. Its variations and its path of
/// the fit are empty if the case lacks these sections; `models` is empty. Throws Error(kBadInput)
/// if a range in [sweep] is not valid.
RollingPlan planned_rolling(const RollingCase& c);

/// The study of a plan. Its results are, for each model, MODEL.gap [L], MODEL.smallest_gap [L],
/// MODEL.position [L], MODEL.angle [radians], MODEL.velocity [L/T], MODEL.angular_velocity [1/T],
/// MODEL.slip [L/T], MODEL.contact (0: no solid contact, 1: rolling, 2: sliding) and
/// MODEL.contact_time [T] (empty if the solids never touch), which RollingEnd defines. A model that
/// fails leaves its columns empty, and the column `failure` says why. `version` is the version of
/// Viscontact, for the head of the file.
///
/// Reads the case and the fit. Throws Error(kBadInput) if one of them cannot be read, if the first
/// or the last point gives no valid case, or if the fit is not that of a sphere above a plane.
/// Throws Error(kWrongUsage) if nothing is varied, if the grid has more than 1e12 points, if a key
/// is varied twice, would need another fit or changes no model, or if a model is not known or is
/// given twice. If the ranges are in the case, a fault of the ranges is an Error(kBadInput).
sweep::Study rolling_study(RollingPlan plan, const std::string& version);

}  // namespace viscontact::rolling
