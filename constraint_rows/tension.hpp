// The geometric stiffness of forces that links exert, docs/physics.md (5.21).
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "viscontact/constraint_rows/link_rows.hpp"
#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {

/// The share of the geometric stiffness K that is a spring in the step, (5.21). `kappa` is the time
/// for which forces act times K w, with the mobility w of its row. Without springs the step is
/// stable if kappa, summed over the links of a particle, is below 4. Below 0.05 the directions of
/// the beginning of the step are as good, and keep angular momentum exactly; above 0.1 everything
/// is a spring. In between the share is linear, because a change of the scheme at each oscillation
/// of a tension would change the energy. A particle may have up to 80 links.
inline double share_of_tension(double kappa) {
  constexpr double kNone = 0.05;
  return std::clamp(kappa / kNone - 1, 0.0, 1.0);
}

/// Rows of the geometric stiffness of the force `tension` [M L/T^2] that pulls two points together
/// along the line `apart` != 0 [L]. A row is a spring that is not extended, with `stiffness` > 0
/// and `value` and `compliance` 0. The first rows, only with a tension > 0, are displacements
/// across the line; then follow those of turns, rows_of_turn().
std::vector<LinkRow> rows_across(const LinkPart& first, const LinkPart& second, const Vector& apart,
                                 double tension, int dimension);

struct AxisStiffness {
  Vector axis{};
  double stiffness = 0;  ///< > 0 [M L^2/T^2]
};

/// The positive part of the geometric stiffness of `forces` on one unit, the sum of (F a) I - (F
/// a^T + a F^T)/2 over the forces F with the arms a, about axes at right angles.
std::vector<AxisStiffness> stiffness_of_turns(std::span<const ForceAtArm> forces, int dimension);

/// Rows of stiffness_of_turns() of a force on the point of `part`, each with one part. None without
/// an arm.
std::vector<LinkRow> rows_of_turn(const LinkPart& part, const Vector& force, int dimension);

/// Rows of the geometric stiffness of a hinge, spring, arm or distance of a membrane at the present
/// places with these `forces` [M L/T^2]; none for other links.
std::vector<LinkRow> rows_of_tension(const LinkEquations& link, std::span<const double> forces,
                                     const Particles& particles);

/// The part of stiffness_of_turns() of the `forces` on a body that is a spring in the step, times
/// LinkTimes::beta_across(): BodyLoad::stiffness [M L^2/T^2].
Matrix3 stiffness_in_step(const RigidBody& body, std::span<const ForceAtArm> forces,
                          const LinkTimes& times, int dimension);

/// Rate at which the value of a row changes with the present velocities [L/T, 1/T].
double rate_of(const LinkRow& row, const Particles& particles);

}  // namespace viscontact::particles
