// The plots of the report of one sphere: lengths, masses and times are in the units of the case. A
// plot without curves has nothing to show, and report.cpp, the only user, leaves it out. A change
// must keep the names of the plots, which are names of files. Used by report.cpp.
#pragma once

#include <optional>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/fit_uncertainty.hpp"
#include "viscontact/report/page.hpp"

namespace viscontact::report {

/// The drag factor of the table and of the fit; in a second panel the relative difference of the
/// two beside the table's error estimates.
Plot plot_fit(const lubrication::MotionTable& table, const lubrication::Fit& fit);

/// The gap q(t) of all trajectories, on a linear scale.
Plot plot_gaps(const std::vector<reduced_model::Trajectory>& trajectories);

/// The gap q(t) on a logarithmic scale. While a contact model is in contact, the recovered film is
/// drawn as a dashed line.
Plot plot_gaps_logarithmic(const std::vector<reduced_model::Trajectory>& trajectories,
                           const reduced_model::Motion& motion,
                           const lubrication::LubricationForce& force);

/// The force of the fluid on the sphere over time, of film and resolved drag together. The scale is
/// that of the external force and of the models whose force is no mean over a step; what contact
/// models have above it, in the steps of impacts, is cut off.
Plot plot_lubrication_force(const std::vector<reduced_model::Trajectory>& trajectories);

/// gamma(t) of the contact models.
Plot plot_gamma(const std::vector<reduced_model::Trajectory>& trajectories);

/// The force of the solid contact over time.
Plot plot_solid_force(const std::vector<reduced_model::Trajectory>& trajectories);

/// The external force f_ext(t) from 0 to `end_time` [T].
Plot plot_external_force(const reduced_model::ExternalForce& force, double end_time);

/// The thinnest film of each model (for contact models the recovered film), beside the published
/// value if the case has one.
Plot plot_minimal_gaps(const reduced_model::Comparison& comparison,
                       const std::optional<case_file::PublishedGap>& published);

/// The uncertainty of the gap over time in the motion without inertia, as bands relative to the gap
/// that the fit gives.
Plot plot_uncertainty(const reduced_model::FitUncertainty& uncertainty);

}  // namespace viscontact::report
