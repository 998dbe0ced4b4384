// The sphere that moves along a plane and turns, beside exact solutions.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/common/failure.hpp"
#include "viscontact/rolling/rolling_motion.hpp"
#include "viscontact/rolling/rolling_resistance.hpp"

namespace viscontact::rolling {
namespace {

using motions::PairEntry;

const motions::PairFit& plane() {
  static const auto fit =
      motions::read_pair_fit(std::string(VISCONTACT_SOURCE_FOLDER) + "/data/fits/pairs/plane.json");
  return fit;
}

/// A sphere of radius 1 in a fluid of viscosity 1, as the fit has it, on an incline.
RollingMotion on_incline(double incline) {
  RollingMotion motion;
  motion.mass = 2;
  motion.moment_of_inertia = 0.8;
  motion.initial_gap = 0.5;
  motion.force = 20 * std::sin(incline);
  motion.normal_force = -20 * std::cos(incline);
  motion.roughness = 1e-3;
  motion.friction = 0.3;
  motion.end_time = 20;
  motion.time_step = 0.01;
  return motion;
}

/// Velocities at which the fluid balances a force and a torque at a gap.
RollingVelocity balanced(double gap, double force, double torque) {
  const auto r = RollingFluid(plane()).at(gap);
  const double determinant = r.slide * r.roll - r.slide_roll * r.slide_roll;
  return {(r.roll * force + r.slide_roll * torque) / determinant,
          (r.slide_roll * force + r.slide * torque) / determinant};
}

TEST(RollingFluid, HasSlopesThatAreTheDerivativesOfItsValues) {
  const RollingFluid fluid(plane());
  for (const double gap : {1e-4, 1e-3, 0.1, 0.9}) {
    constexpr double kStep = 1e-5;
    const auto after = fluid.at(gap * std::exp(kStep)), before = fluid.at(gap * std::exp(-kStep));
    const auto slope = fluid.slopes(gap);
    EXPECT_NEAR(slope.slide, (after.slide - before.slide) / (2 * kStep), 1e-6);
    EXPECT_NEAR(slope.roll, (after.roll - before.roll) / (2 * kStep), 1e-6);
    EXPECT_NEAR(slope.slide_roll, (after.slide_roll - before.slide_roll) / (2 * kStep), 1e-6);
  }
}

TEST(RollingFluid, NeedsFourEntries) {
  auto fit = plane();
  fit.entries.erase(PairEntry::kRoll);
  EXPECT_THAT(bad_input([&] { RollingFluid fluid(fit); }), Names("roll"));
}

TEST(SmoothSphere, MovesAtTheVelocitiesThatBalanceTheForceAtItsGap) {
  const auto motion = on_incline(0.4);
  const auto rows = roll_smooth(motion, plane());
  ASSERT_EQ(rows.size(), 2001U);
  const auto& last = rows.back();
  // The film thins as exp(-t F/(6 pi mu r^2)), so slowly that inertia changes the velocities by
  // m / (resistance times the time of thinning) of their rate, which is below 1e-3 here.
  const auto expected = balanced(last.gap, motion.force, 0);
  EXPECT_NEAR(last.velocity / expected.move, 1, 1e-3);
  EXPECT_NEAR(last.angular_velocity / expected.turn, 1, 1e-3);
  EXPECT_EQ(last.contact, SolidContact::kNone);
  EXPECT_LT(last.gap, 1e-5);
  EXPECT_LT(last.velocity, rows[1000].velocity);
}

TEST(SmoothSphere, KeepsTheBalanceOfMomentumAlongThePlane) {
  auto motion = on_incline(0.4);
  motion.end_time = 2;
  motion.time_step = 1e-3;
  const auto rows = roll_smooth(motion, plane());
  const RollingFluid fluid(plane());
  // Simpson's rule over the force of the fluid: its error is of order time_step^4.
  double impulse = 0, moment = 0;
  for (std::size_t i = 0; i + 2 < rows.size(); i += 2)
    for (const auto& [row, weight] :
         {std::pair(rows[i], 1.0), std::pair(rows[i + 1], 4.0), std::pair(rows[i + 2], 1.0)}) {
      const auto force = fluid_force(fluid.at(row.gap), {row.velocity, row.angular_velocity});
      impulse += weight * motion.time_step / 3 * (force.force + motion.force);
      moment += weight * motion.time_step / 3 * force.torque;
    }
  EXPECT_NEAR(impulse, motion.mass * rows.back().velocity, 1e-7);
  EXPECT_NEAR(moment, motion.moment_of_inertia * rows.back().angular_velocity, 1e-7);
}

TEST(RoughSphere, RollsWithoutSlipBelowTheThresholdAndSlidesAboveIt) {
  const auto r = RollingFluid(plane()).at(1e-3);
  const double resistance = r.slide - 2 * r.slide_roll + r.roll;  // of rolling without slip
  // Without slip the friction is T = r_torque: -r T = (roll - slide_roll) w, so the threshold of
  // the incline is the one at which |T| = mu_s N.
  const double share = (r.roll - r.slide_roll) / resistance;  // |T| over the force
  const double threshold = std::atan(0.3 / share);
  for (const double incline :
       {0.9 * threshold, 0.999 * threshold, 1.001 * threshold, 1.1 * threshold}) {
    SCOPED_TRACE(incline / threshold);
    const auto motion = on_incline(incline);
    const auto rows = roll_rough(motion, plane());
    const auto& last = rows.back();
    EXPECT_DOUBLE_EQ(last.gap, 1e-3);
    EXPECT_DOUBLE_EQ(last.contact_force, -motion.normal_force);
    if (incline < threshold) {
      EXPECT_EQ(last.contact, SolidContact::kRolling);
      EXPECT_NEAR(last.angular_velocity, motion.force / resistance, 1e-8);
      EXPECT_NEAR(last.velocity, last.angular_velocity, 1e-12);
      EXPECT_NEAR(last.friction_force, -share * motion.force, 1e-7);
    } else {
      EXPECT_EQ(last.contact, SolidContact::kSliding);
      const double friction = -0.3 * last.contact_force;
      EXPECT_NEAR(last.friction_force, friction, 1e-12);
      const auto expected = balanced(1e-3, motion.force + friction, -friction);
      EXPECT_NEAR(last.velocity / expected.move, 1, 1e-8);
      EXPECT_NEAR(last.angular_velocity / expected.turn, 1, 1e-8);
    }
  }
}

TEST(RoughSphere, IsCarriedByAPlaneThatSlides) {
  auto motion = on_incline(0);
  motion.plane_velocity = 0.7;
  motion.end_time = 60;
  for (const auto& model : rolling_models()) {
    const auto last = model.run(motion, plane()).back();
    EXPECT_NEAR(last.velocity, 0.7, 1e-6) << model.name;
    EXPECT_NEAR(last.angular_velocity, 0, 1e-6) << model.name;
  }
}

TEST(RoughSphere, ThatStartsInContactSlidesUntilTheSlipHasEnded) {
  // Hardly any fluid: on a floor slip ends at r w0 / (3.5 mu_s g) for a solid sphere.
  auto fit = plane();
  constexpr double kThin = 1e-9;
  for (auto& [which, entry] : fit.entries)
    entry.fit = lubrication::with_viscosity(entry.fit, kThin);
  fit.viscosity = kThin;
  auto motion = on_incline(0);
  motion.initial_gap = motion.roughness;
  motion.angular_velocity = 10;
  motion.end_time = 2;
  const double g = 20 / motion.mass, slip_ends = 10 / (3.5 * 0.3 * g);
  const auto rows = roll_rough(motion, fit);
  for (const auto& row : rows) {
    if (row.time < slip_ends - 0.011) {
      EXPECT_NEAR(row.velocity, 0.3 * g * row.time, 1e-6);
    }
    if (row.time > slip_ends + 0.011) {
      EXPECT_EQ(row.contact, SolidContact::kRolling);
      EXPECT_NEAR(row.velocity, 10 / 3.5, 1e-6);
      EXPECT_NEAR(row.angular_velocity, 10 / 3.5, 1e-6);
    }
  }
}

TEST(RoughSphere, ThatAForceLiftsLeavesTheRoughnessAfterTheImpact) {
  // Heavy enough to reach the roughness against the film and the force.
  auto motion = on_incline(0.4);
  motion.mass = 500;
  motion.moment_of_inertia = 200;
  motion.normal_velocity = -1;
  motion.normal_force = 3;
  motion.end_time = 4;
  const auto rows = roll_rough(motion, plane());
  ASSERT_EQ(rows.size(), 401U);
  const auto lowest = std::ranges::min_element(rows, {}, &RollingRow::gap);
  EXPECT_NEAR(lowest->gap, motion.roughness, 0.01 * motion.roughness);
  for (const auto& row : rows) {
    EXPECT_EQ(row.contact, SolidContact::kNone);
    EXPECT_EQ(row.contact_force, 0);
  }
  // From any row after the impact the motion is that of smooth surfaces.
  const auto from = lowest + 20;
  auto rest = motion;
  rest.initial_gap = from->gap;
  rest.normal_velocity = from->normal_velocity;
  rest.velocity = from->velocity;
  rest.angular_velocity = from->angular_velocity;
  rest.end_time = motion.end_time - from->time;
  const auto last = roll_smooth(rest, plane()).back();
  EXPECT_GT(rows.back().gap, motion.roughness);
  EXPECT_NEAR(rows.back().gap / last.gap, 1, 1e-6);
  EXPECT_NEAR(rows.back().velocity / last.velocity, 1, 1e-6);
  EXPECT_NEAR((rows.back().position - from->position) / last.position, 1, 1e-6);
}

TEST(RoughSphere, ThatMovesAwayFromItsContactTouchesAgainLater) {
  auto motion = on_incline(0.4);
  motion.initial_gap = motion.roughness;
  motion.normal_velocity = 5;
  motion.end_time = 20;
  const auto rows = roll_rough(motion, plane());
  EXPECT_EQ(rows.front().contact, SolidContact::kNone);
  EXPECT_GT(rows.at(1).gap, motion.roughness);
  EXPECT_NE(rows.back().contact, SolidContact::kNone);
}

TEST(ViscousContact, ConvergesToTheRoughSphereInItsFinalStateAndHasItsFriction) {
  for (const double incline : {0.3, 1.0}) {
    const auto motion = on_incline(incline);
    const auto rough = roll_rough(motion, plane()).back();
    const auto contact = roll_with_viscous_contact(motion, plane()).back();
    EXPECT_EQ(contact.contact, rough.contact);
    EXPECT_NEAR(contact.velocity / rough.velocity, 1, 1e-9);
    EXPECT_NEAR(contact.angular_velocity / rough.angular_velocity, 1, 1e-9);
    EXPECT_NEAR(contact.gap / rough.gap, 1, 1e-12);
  }
}

TEST(ViscousContact, HasFrictionOnceTheFilmIsAsThinAsTheRoughness) {
  auto motion = on_incline(0.3);
  motion.initial_gap = 0.5;
  motion.time_step = 1e-3;
  // Until t = -gamma_min / (normal force) the film carries the weight.
  const double k = 6 * std::numbers::pi;
  const double touches = k * std::log(motion.initial_gap / motion.roughness) / -motion.normal_force;
  const auto rows = roll_with_viscous_contact(motion, plane());
  const auto first = std::ranges::find_if(
      rows, [](const RollingRow& row) { return row.contact != SolidContact::kNone; });
  ASSERT_NE(first, rows.end());
  EXPECT_NEAR(first->time, touches, 0.02);
}

TEST(ViscousContact, FailsIfItsContactForceLeavesTheRangeOfADouble) {
  // The impulse, 1e300, is a double, but not the force, 1e310. All other numbers of the row are.
  auto motion = on_incline(0);
  motion.mass = 1e200;
  motion.normal_velocity = -1e100;
  motion.time_step = motion.end_time = 1e-10;
  failure(ErrorKind::kNotConverged, [&] { (void)roll_with_viscous_contact(motion, plane()); });
}

TEST(Rolling, OutOfTheGapsOfTheFitIsRefused) {
  auto motion = on_incline(0);
  motion.normal_force = 50;
  EXPECT_THAT(bad_input([&] { (void)roll_smooth(motion, plane()); }), Names("gap 1"));
}

}  // namespace
}  // namespace viscontact::rolling
