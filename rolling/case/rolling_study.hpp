// The sweep of a sphere that moves along a plane and turns: a row has the state of each model at
// the end of the motion; all rows use one fit of the drag of the sphere near the plane. Lengths,
// masses and times are in the units of the case. The command `sweep` calls it. A wrong case or fit
// throws Error(kBadInput), a wrong choice of what varies Error(kWrongUsage), both before a row is
// computed. A model that fails throws nothing: its results are empty. A change must keep the names
// of the columns, which users' scripts read.
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
  sweep::Points points;             ///< at least one variation; `draws` is 0
  std::vector<std::string> models;  ///< names of rolling_models(); empty: those of the case
};

/// The plan that the sections [sweep] and [fit] of a case ask for; its variations and its fit are
/// empty if the case lacks these sections. Throws Error(kBadInput) if a range in [sweep] is not
/// valid.
RollingPlan planned_rolling(const RollingCase& c);

/// The study of a plan. Its results are, for each model, MODEL.gap [L], MODEL.smallest_gap [L],
/// MODEL.position [L], MODEL.angle [radians], MODEL.velocity [L/T], MODEL.angular_velocity [1/T],
/// MODEL.slip [L/T], MODEL.contact (SolidContact as a number: 0, 1, 2) and MODEL.contact_time [T]
/// (empty if the solids never touch); RollingEnd defines them. Those of a model that fails are
/// empty. `version` is that of Viscontact.
///
/// Reads the case and the fit. Throws Error(kBadInput) if the first or the last point gives no
/// valid case, or if the fit is not that of a sphere above a plane. Throws Error(kWrongUsage) if
/// nothing is varied, if a key is varied twice or would need another fit, or if a model is not
/// known or is given twice.
sweep::Study rolling_study(RollingPlan plan, const std::string& version);

}  // namespace viscontact::rolling
