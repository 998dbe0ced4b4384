// Force and torque of fluid and solids on a sphere, their Jacobian, and the tolerances.
#include "viscontact/reduced_model/rolling/rolling_equation.hpp"

#include <algorithm>
#include <cmath>

namespace viscontact::reduced_model {
namespace {

Motion normal_motion(const RollingMotion& motion) {
  return {.mass = motion.mass,
          .initial_gap = motion.initial_gap,
          .initial_velocity = motion.normal_velocity,
          .end_time = motion.end_time,
          .external_force = ExternalForce({{motion.end_time, motion.normal_force}})};
}

/// The fluid, which throws if the sphere starts above the gaps of the fit.
RollingFluid fluid_around(const RollingMotion& motion, const lubrication::PairFit& fit) {
  const RollingFluid fluid(fit);
  (void)fluid.at(motion.initial_gap);
  return fluid;
}

}  // namespace

RollingEquation::RollingEquation(const RollingMotion& motion, const lubrication::PairFit& fit,
                                 double contact_gap)
    : motion_(motion),
      fluid_(fluid_around(motion, fit)),
      radius_(fit.radius),
      contact_gap_(contact_gap),
      normal_(normal_motion(motion)),
      squeeze_(fit.entries.at(lubrication::PairEntry::kSqueeze).fit,
               {.below = lubrication::BelowInterval::kLubricationLimit}),
      gap_equation_(normal_, squeeze_, motion.relative_tolerance) {}

RollingStateVector RollingEquation::initial_state() const {
  return {gap_equation_.state_of(motion_.initial_gap), motion_.velocity - motion_.plane_velocity,
          motion_.angular_velocity, 0, 0};
}

double RollingEquation::gap_of(std::span<const double> y) const {
  return solids.touches ? contact_gap_ : gap_equation_.gap_of(y[kLogGap]);
}

double RollingEquation::normal_velocity(double t, std::span<const double> y) const {
  return solids.touches ? 0 : gap_equation_.instant(t, gap_of(y), t).velocity;
}

double RollingEquation::contact_force() const {
  return solids.touches ? std::max(0.0, -motion_.normal_force) : 0;
}

double RollingEquation::slip(std::span<const double> y) const {
  return slip_of({y[kMove], y[kTurn]}, radius_);
}

/// Force and torque without those of the solids.
RollingForce RollingEquation::free_force(std::span<const double> y) const {
  const auto fluid = fluid_force(fluid_.at(gap_of(y)), {y[kMove], y[kTurn]});
  return {motion_.force + fluid.force, motion_.torque + fluid.torque};
}

double RollingEquation::compliance() const {
  return 1 / motion_.mass + radius_ * radius_ / motion_.moment_of_inertia;
}

/// The rate of the slip without friction.
double RollingEquation::slip_rate(std::span<const double> y) const {
  const auto free = free_force(y);
  return free.force / motion_.mass - radius_ * free.torque / motion_.moment_of_inertia;
}

double RollingEquation::friction_force(std::span<const double> y) const {
  switch (solids.contact) {
    case SolidContact::kRolling:
      return -slip_rate(y) / compliance();
    case SolidContact::kSliding:
      return -std::copysign(motion_.friction * contact_force(), solids.sliding_direction);
    case SolidContact::kNone:
      break;
  }
  return 0;
}

bool RollingEquation::can_roll(std::span<const double> y) {
  const auto friction = coulomb(slip_rate(y), compliance(), motion_.friction * contact_force());
  if (friction.contact == SolidContact::kRolling) return true;
  solids.sliding_direction = friction.force != 0 ? -friction.force : slip_rate(y);
  return false;
}

StiffSystem RollingEquation::system(const double& step_begin) const {
  const auto of_gap = gap_equation_.system(step_begin);
  StiffSystem system;
  system.dimension = kStates;
  system.tolerance_key = "rolling.relative_tolerance";
  system.derivative = [this, of_gap](double t, std::span<const double> y, std::span<double> f) {
    derivative(y, f);
    f[kLogGap] = 0;
    if (!solids.touches) of_gap.derivative(t, y.first(1), f.first(1));
  };
  system.jacobian = [this, of_gap](double t, std::span<const double> y, std::span<double> j) {
    jacobian(y, j);
    if (!solids.touches) of_gap.jacobian(t, y.first(1), j.first(1));
  };
  system.tolerance = [this, of_gap](double t, std::span<const double> y,
                                    std::span<double> allowed) {
    tolerance(y, allowed);
    of_gap.tolerance(t, y.first(1), allowed.first(1));
  };
  return system;
}

/// The derivatives of all components but the gap.
void RollingEquation::derivative(std::span<const double> y, std::span<double> f) const {
  const auto free = free_force(y);
  const double friction = friction_force(y);
  f[kMove] = (free.force + friction) / motion_.mass;
  f[kTurn] = (free.torque - radius_ * friction) / motion_.moment_of_inertia;
  f[kPosition] = y[kMove] + motion_.plane_velocity;
  f[kAngle] = y[kTurn];
}

/// All entries but that of the gap by the gap, which is 0 here; by columns.
void RollingEquation::jacobian(std::span<const double> y, std::span<double> j) const {
  std::ranges::fill(j, 0.0);
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return j[column * kStates + row];
  };
  const auto put = [&](std::size_t column, const RollingForce& change) {
    // Friction of rolling keeps the slip constant, whatever the other forces are.
    double friction = 0;
    if (solids.contact == SolidContact::kRolling)
      friction =
          -(change.force / motion_.mass - radius_ * change.torque / motion_.moment_of_inertia) /
          compliance();
    at(kMove, column) = (change.force + friction) / motion_.mass;
    at(kTurn, column) = (change.torque - radius_ * friction) / motion_.moment_of_inertia;
  };
  const double gap = gap_of(y);
  const auto r = fluid_.at(gap);
  put(kMove, fluid_force(r, {1, 0}));
  put(kTurn, fluid_force(r, {0, 1}));
  if (!solids.touches) put(kLogGap, fluid_force(fluid_.slopes(gap), {y[kMove], y[kTurn]}));
  at(kPosition, kMove) = 1;
  at(kAngle, kTurn) = 1;
}

/// The tolerances of all components but the gap. Those of the velocities refer to the largest
/// velocity that the forces can make, so that one that passes through 0 does not stop CVODE.
void RollingEquation::tolerance(std::span<const double> y, std::span<double> allowed) const {
  const auto r = fluid_.at(std::min(gap_of(y), fluid_.largest_gap()));
  const double move = std::abs(y[kMove]) + radius_ * std::abs(y[kTurn]) +
                      std::abs(motion_.force) / r.slide +
                      std::abs(motion_.torque) * radius_ / r.roll;
  const double scale = std::max(move, 1e-12 * radius_ / motion_.end_time);
  allowed[kMove] = motion_.relative_tolerance * scale;
  allowed[kTurn] = allowed[kMove] / radius_;
  allowed[kPosition] =
      motion_.relative_tolerance * (std::abs(y[kPosition]) + scale * motion_.end_time * 1e-3);
  allowed[kAngle] = allowed[kPosition] / radius_;
}

}  // namespace viscontact::reduced_model
