// The plots of the report. One without curves has nothing to show.
#pragma once

#include <optional>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/fit_uncertainty.hpp"
#include "viscontact/report/report_plot.hpp"

namespace viscontact {

/// The table's drag factor with the fit, and below it their relative difference beside the table's
/// own error estimates.
Plot plot_fit(const ForceTable& table, const Fit& fit);

/// q(t) of all trajectories, on a linear scale.
Plot plot_gaps(const std::vector<Trajectory>& trajectories);

/// q(t) on a logarithmic scale; where a contact model is in contact, the film thickness that its
/// gamma stands for, dashed.
Plot plot_gaps_logarithmic(const std::vector<Trajectory>& trajectories, const Motion& motion,
                           const LubricationForce& force);

/// gamma(t) of the contact models.
Plot plot_gamma(const std::vector<Trajectory>& trajectories);

/// What the solids carry over time.
Plot plot_solid_force(const std::vector<Trajectory>& trajectories);

/// f_ext(t) from 0 to the end.
Plot plot_external_force(const ExternalForce& force, double end_time);

/// The thinnest film of each model, recovered from gamma for contact models, beside the published
/// value if the case has one.
Plot plot_minimal_gaps(const Comparison& comparison, const std::optional<PublishedGap>& published);

/// Bands of the inertialess gap over time, relative to the fit's own.
Plot plot_uncertainty(const FitUncertainty& uncertainty);

}  // namespace viscontact
