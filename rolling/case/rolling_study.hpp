// The sweep of a sphere that moves along a plane and turns: the state of each model at the end of
// the motion, from one fit of all motions of the pair. Lengths, masses and times are in the units
// of the case. `sweep` calls it. A change must keep the names of the columns, which users' scripts
// read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/motions/pair_fit.hpp"
#include "viscontact/rolling/case/rolling_case.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::rolling {

/// What is computed at each point.
struct RollingPlan {
  std::filesystem::path case_path;  ///< the case whose keys are varied
  std::filesystem::path fit_path;   ///< fit of a pair, scaled to each point
  sweep::Points points;             ///< at least one variation, no draws
  std::vector<std::string> models;  ///< names of rolling_models(); empty: those of the case
};

/// The plan of the section [sweep] and the fit of a case. Variations and fit are empty if the case
/// does not give them. Throws Error(kBadInput) if a range in [sweep] is not valid.
RollingPlan planned_rolling(const RollingCase& c);

/// The study of a plan. Its results are, for each model, MODEL.gap [L], MODEL.smallest_gap [L],
/// MODEL.position [L], MODEL.angle [radians], MODEL.velocity [L/T], MODEL.angular_velocity [1/T],
/// MODEL.slip [L/T], MODEL.contact and MODEL.contact_time [T]; RollingEnd defines them. Those of a
/// model that fails are empty. `version` is that of Viscontact.
///
/// Reads the case and the fit. Throws Error(kBadInput) if the first or the last point gives no
/// valid case, or if the fit is not that of a sphere above a plane. Throws Error(kWrongUsage) if
/// nothing is varied, if a key is varied twice or changes the tables of the fit, or if a model is
/// not known or is given twice.
sweep::Study rolling_study(RollingPlan plan, const std::string& version);

}  // namespace viscontact::rolling
