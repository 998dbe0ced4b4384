// The models `inertial`, with which all others are compared, and `inertial_rough`: the motion with
// inertia and the whole drag by CVODE, physics.md (4.1), (4.14), in any consistent units.
#pragma once

#include <array>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// Of the gap.
inline constexpr ModelParameter kRelativeTolerance = {
    "inertial.relative_tolerance",
    "relative tolerance of the gap in inertial",
    "1",
    {[](double v) { return v >= 1e-13 && v <= 1e-2; }, "from 1e-13 to 1e-2"},
    [](const Motion&, double) { return 1e-9; },
    false,
    "1e-9"};
/// The parameters of simulate_inertial().
inline constexpr std::array kInertialParameters = {kReferenceTimeStep, kRelativeTolerance};

/// Integrates m du/dt = f_ext - R(q) u, dq/dt = u (physics.md (4.1)) with CVODE, in the form of
/// inertial_equation.hpp, for the gap q, the mass m, the resistance R and the external force f_ext.
///
/// The unknown is s = ln(q/r), with the radius r. The equation is stiff, because the film damps at
/// the rate R/m; errors of s decay in the film and do not add up. The first integral of the
/// equation holds by construction, so that it cannot be used to check this model.
///
/// CVODE stops and restarts where f_ext or its slope jumps. The rows are at the multiples of
/// reference.time_step, at the jumps, and where u = 0 (the extrema of q). The error of s that is
/// allowed in a step is 0.1 inertial.relative_tolerance, and in free flight 3e-5 times this
/// tolerance, because the film damps errors too slowly there. If the film would stop a fall at the
/// time t within 1e-12 t, which no step can resolve, the gap is set to the smallest gap at once.
///
/// Throws Error(kNotConverged) if CVODE gives up or the film gets too thin for a double,
/// Error(kBadInput) if the gap leaves the interval of `force`, if there would be more than 1e8 rows
/// or if a parameter has no value, and Error(kInterrupted) at a stop.
Trajectory simulate_inertial(const Motion& motion, const lubrication::LubricationForce& force);

/// The parameters of simulate_inertial_rough().
inline constexpr std::array kInertialRoughParameters = {kReferenceTimeStep, kRelativeTolerance,
                                                        kRestitution};

/// The motion of simulate_inertial(), but with solids that touch at the gap r1 + r2, the heights of
/// the roughness. There the velocity u becomes -e_d u (4.14), where e_d is the restitution. If e_d
/// = 0, or if a flight without drag would last less than 1e-6 end_time, the sphere rests on the
/// solids until the force pulls it. Without roughness the result is that of simulate_inertial().
///
/// The velocity of approach in Trajectory::rebounds is the largest one towards the solids since the
/// last rebound. The velocity after the impact is the one that the sphere would have without an
/// external force as it gets back to the gap at which it was that fast, and 0 if the film stops it
/// before. A sphere that is stopped may hit the solids again; these impacts are not listed.
///
/// Throws the errors of simulate_inertial() and of check_start_outside_roughness(), and with
/// roughness Error(kNotConverged) if f_ext has too many periods (ExternalForce::sign_changes()).
Trajectory simulate_inertial_rough(const Motion& motion,
                                   const lubrication::LubricationForce& force);

/// Throws Error(kBadInput) unless the initial gap is greater than the heights of the roughness r1 +
/// r2.
void check_start_outside_roughness(const Motion& motion);

}  // namespace viscontact::reduced_model
