// The plots of the report of one sphere, over gap q [L] or time t [T], in the units of the case.
#pragma once

#include <optional>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/fit_uncertainty.hpp"
#include "viscontact/report/page.hpp"

namespace viscontact::report {

// A contact model replaces the thin film by contact and computes gamma, minus the impulse that the
// film has absorbed [M L/T], from which the film's thickness is recovered. Each trajectory must
// have a row.

/// The drag of the table and of the fit over the gap, divided by Stokes' drag [1], and in a second
/// panel the relative difference of the two [1] beside the table's error estimates. Rows of the
/// table outside the fit's interval have no difference. Throws Error(kBadInput) if the fit's drag
/// is not positive at every gap of its interval.
Plot plot_fit(const lubrication::MotionTable& table, const lubrication::Fit& fit);

/// The gap q(t) of each trajectory, on a linear scale.
Plot plot_gaps(const std::vector<reduced_model::Trajectory>& trajectories);

/// The gap q(t) of each trajectory, on a logarithmic scale, which omits gaps that are 0. While a
/// contact model is in contact, its film is drawn as a broken line. `motion` is the motion of the
/// case, and `force` the drag of the fit. Throws Error(kBadInput) if a contact model refuses
/// `motion`.
Plot plot_gaps_logarithmic(const std::vector<reduced_model::Trajectory>& trajectories,
                           const reduced_model::Motion& motion,
                           const lubrication::LubricationForce& force);

/// The force of the fluid on the sphere [M L/T^2] over time. The vertical scale contains minus the
/// external force and the forces of models without contact. The forces of contact models are means
/// over a time step; those of steps with an impact may be larger than the scale and are then cut
/// off.
Plot plot_lubrication_force(const std::vector<reduced_model::Trajectory>& trajectories);

/// gamma(t) <= 0 of the contact models; other trajectories have no curve.
Plot plot_gamma(const std::vector<reduced_model::Trajectory>& trajectories);

/// The force >= 0 of the plane on the sphere [M L/T^2] over time while the solids touch. The scale
/// ends at 1.3 times the largest external force, so that impacts are cut off. Trajectories in which
/// no solids touch have no curve.
Plot plot_solid_force(const std::vector<reduced_model::Trajectory>& trajectories);

/// The external force f_ext(t) [M L/T^2] from 0 to `end_time` > 0.
Plot plot_external_force(const reduced_model::ExternalForce& force, double end_time);

/// The thinnest film of each model, which for a contact model is recovered from gamma, beside the
/// published value if the case has one. If no value is > 0, the result is a Plot without name and
/// panels.
Plot plot_minimal_gaps(const reduced_model::Comparison& comparison,
                       const std::optional<case_file::PublishedGap>& published);

/// How the errors of the fit change the gap of the motion without inertia, over time: intervals of
/// the gap, relative to the gap with the fit [1].
Plot plot_uncertainty(const reduced_model::FitUncertainty& uncertainty);

}  // namespace viscontact::report
