// The model `viscous_contact` by the time steps of docs/physics.md (4.5) and (4.10), and the list
// of all models.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/terms.hpp"
#include "viscontact/reduced_model/models/contact/contact_step.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/rolling/rolling_resistance.hpp"

namespace viscontact::rolling {
namespace {

/// The 2 x 2 system (M/h + R) v = M v_before/h + forces + friction (1, -r) for the velocities v,
/// with M = diag(mass, moment of inertia), the matrix R of the resistances, the step h and the
/// radius r.
class ImplicitStep {
 public:
  ImplicitStep(const RollingMotion& motion, const RollingResistance& r, double radius, double step)
      : a_(motion.mass / step + r.slide),
        b_(-r.slide_roll),
        c_(motion.moment_of_inertia / step + r.roll),
        radius_(radius) {}

  RollingVelocity solve(const RollingForce& f) const {
    const double determinant = a_ * c_ - b_ * b_;
    return {(c_ * f.force - b_ * f.torque) / determinant,
            (a_ * f.torque - b_ * f.force) / determinant};
  }
  /// The change of the slip at the end of the step per force of friction [T/M].
  double compliance() const { return slip_of(solve({1, -radius_}), radius_); }

 private:
  double a_, b_, c_, radius_;
};

}  // namespace

RollingTrajectory roll_with_viscous_contact(const RollingMotion& motion,
                                            const motions::PairFit& fit) {
  assert(motion.mass > 0 && motion.moment_of_inertia > 0 && motion.initial_gap > 0);
  assert(motion.friction >= 0 && motion.roughness >= 0 && fit.radius > 0);
  const RollingFluid fluid(fit);
  const double radius = fit.radius;
  // k is the coefficient of 1/q in the resistance of a sphere near a plane. The film thickness is
  // q0 exp(gamma/k), where gamma is minus the impulse that the film has absorbed.
  const double k = 6 * std::numbers::pi * fit.viscosity * radius * radius, q0 = motion.initial_gap;
  const double gamma_min = motion.roughness > 0 ? std::min(0.0, k * std::log(motion.roughness / q0))
                                                : -std::numeric_limits<double>::infinity();
  const int count = reduced_model::step_count(motion.end_time, motion.time_step);
  const auto wall = lubrication::second_wall_of(fit.entries.at(motions::PairEntry::kSqueeze).fit);
  const double last =
      reduced_model::motion_ends_at(wall ? wall->largest_gap : lubrication::kNoWall);
  reduced_model::ContactState normal = {motion.initial_gap, motion.normal_velocity, 0};
  RollingRow row;
  row.gap = motion.initial_gap;
  row.normal_velocity = motion.normal_velocity;
  row.velocity = motion.velocity;
  row.angular_velocity = motion.angular_velocity;
  RollingTrajectory rows = {row};
  rows.reserve(static_cast<std::size_t>(count) + 1);
  for (int n = 0; n < count; ++n) {
    motion.stop.throw_if_stop_requested();
    const double time = reduced_model::step_time(n + 1, count, motion.end_time, motion.time_step);
    const double step = time - row.time;
    const auto contact =
        reduced_model::contact_step(normal, step * motion.normal_force,
                                    {motion.mass, gamma_min, step}, reduced_model::NoDrag{});
    normal = contact.state;
    const bool ends = normal.gap >= last;  // at the wall opposite
    if (ends) normal.gap = last;
    // In contact the gap of the row is the film thickness that gamma stands for.
    row.gap = normal.gap > 0 ? normal.gap : q0 * std::exp(normal.gamma / k);
    const ImplicitStep implicit(motion, fluid.at(std::min(row.gap, fluid.largest_gap())), radius,
                                step);
    const RollingForce known = {
        motion.mass / step * (row.velocity - motion.plane_velocity) + motion.force,
        motion.moment_of_inertia / step * row.angular_velocity + motion.torque};
    auto velocity = implicit.solve(known);
    row.contact_force = contact.solid / step;
    row.friction_force = 0;
    row.contact = SolidContact::kNone;
    if (row.contact_force > 0) {
      const auto friction = coulomb(slip_of(velocity, radius), implicit.compliance(),
                                    motion.friction * row.contact_force);
      row.friction_force = friction.force;
      row.contact = friction.contact;
      velocity =
          implicit.solve({known.force + friction.force, known.torque - radius * friction.force});
    }
    row.velocity = velocity.move + motion.plane_velocity;
    row.angular_velocity = velocity.turn;
    row.normal_velocity = normal.velocity;
    row.position += step * row.velocity;
    row.angle += step * row.angular_velocity;
    row.time = time;
    // An infinite velocity makes the position or the angle infinite or NaN, so that velocities need
    // no check.
    if (!(std::isfinite(row.gap) && std::isfinite(row.position) && std::isfinite(row.angle) &&
          std::isfinite(row.contact_force) && std::isfinite(row.friction_force)))
      throw Error(ErrorKind::kNotConverged,
                  "a number of the motion leaves the range of a double at time {:.6g}", time);
    rows.push_back(row);
    if (ends) break;
  }
  return rows;
}

RollingEnd end_of(const RollingTrajectory& trajectory, const RollingMotion& motion, double radius) {
  assert(!trajectory.empty() && radius > 0);
  RollingEnd end;
  end.last = trajectory.back();
  end.smallest_gap = std::ranges::min_element(trajectory, {}, &RollingRow::gap)->gap;
  end.slip = end.last.velocity - motion.plane_velocity - radius * end.last.angular_velocity;
  for (const auto& row : trajectory)
    end.largest_speed = std::max(
        end.largest_speed, std::hypot(row.velocity - motion.plane_velocity, row.normal_velocity));
  const auto contact = std::ranges::find_if(
      trajectory, [](const RollingRow& row) { return row.contact != SolidContact::kNone; });
  if (contact != trajectory.end()) end.contact_time = contact->time;
  return end;
}

const std::vector<RollingModel>& rolling_models() {
  static const std::vector<RollingModel> models = {
      {"smooth", "lubrication at every gap, no solid contact", roll_smooth},
      {"rough", "lubrication, and solid contact with friction at the height of the roughness",
       roll_rough},
      {"viscous_contact",
       "viscous contact, with friction once the film is thinner than the roughness",
       roll_with_viscous_contact}};
  return models;
}

}  // namespace viscontact::rolling
