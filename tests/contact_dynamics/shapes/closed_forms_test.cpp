// Ellipses and plates without a fluid: closed forms of rolling, rocking, rest, impacts and films.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/contact_dynamics/shapes/shapes.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

const Shape kEllipse = Shape::ellipse(2, 1);
constexpr double kMass = 1.5;

/// kEllipse at rest with its lowest point on the floor.
State tilted_on_floor(double angle) {
  State state = no_particles(2);
  add_shape(state, kEllipse, {0, kEllipse.support({std::sin(angle), std::cos(angle)})}, angle,
            kMass);
  return state;
}

/// The time from the first to the third passage of the last particle through its angle 0.
double period_of(Simulation& simulation) {
  const double h = simulation.setting().time_step;
  std::vector<double> passages;
  double before = simulation.state().particles.angles.back();
  while (passages.size() < 3 && simulation.state().time < 20) {
    const auto report = simulation.step(100);
    expect_converged(report);
    const double now = simulation.state().particles.angles.back();
    if (before * now < 0) passages.push_back(report.time - h * now / (now - before));
    before = now;
  }
  return passages.size() < 3 ? 0 : passages[2] - passages[0];
}

// Its contact moves along the flat side by 50 lengths a radian. A step that does not see this gives
// the normal force a wrong arm: without a limit of that motion a single step added 0.5 of the
// energy, with it 1e-3.
TEST(ThinEllipse, ThatFallsFlatGainsLittleEnergy) {
  const auto thin = Shape::ellipse(1, 0.02);
  for (const double friction : {0.0, 0.4}) {
    SCOPED_TRACE(friction);
    const double angle = 1.2, height = thin.support({std::sin(angle), std::cos(angle)});
    State state = no_particles(2);
    add_shape(state, thin, {0, height + 1e-4}, angle, kMass);
    Simulation simulation(on_floor(1.6e-3, friction), state, 1);
    const double at_start = energy_in_gravity(simulation.state().particles);
    double before = at_start;
    bool is_divided = false;
    while (simulation.state().time < 0.8) {
      const auto report = simulation.step(1);
      expect_converged(report);
      is_divided = is_divided || report.parts > 1;
      const double now = energy_in_gravity(simulation.state().particles);
      ASSERT_LT(now - before, 3e-3 * at_start) << "t = " << report.time;
      before = now;
    }
    EXPECT_TRUE(is_divided);
    EXPECT_LT(before, 1.01 * at_start);  // it rises again on its other end
  }
}

// The radius of curvature of the flat side is a^2/b = 4, the centre is 1 above the floor, and the
// weight times their difference is the stiffness. Without slip the centre moves by b = 1 for each
// radian. The second order in h and in the amplitude of 1e-4 are the errors: 4 times less with half
// of the step.
TEST(RockingEllipse, HasTheClosedPeriodToSecondOrder) {
  const double inertia = kEllipse.inertia(kMass), stiffness = kMass * kGravity * (4 - 1);
  for (const bool rolls : {false, true}) {
    SCOPED_TRACE(rolls);
    const double period =
        2 * std::numbers::pi * std::sqrt((inertia + (rolls ? kMass : 0)) / stiffness);
    std::vector<double> errors;
    for (const double h : {1.6e-2, 8e-3}) {
      auto setting = on_floor(h, rolls ? 10.0 : 0.0);
      setting.solver.tolerance = 1e-12;
      Simulation simulation(setting, tilted_on_floor(1e-4), 1);
      errors.push_back(period_of(simulation) / period - 1);
      // Without friction no force acts along the floor.
      if (!rolls) {
        EXPECT_EQ(simulation.state().particles.velocities[0], 0);
      }
    }
    EXPECT_NEAR(errors[1], 0, 1e-4);
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.2);
  }
}

/// The centre of an ellipse that has rolled from the top of an equal one at 0 and has the angle:
/// its mirror image in the common tangent.
Vector rolled(double angle) {
  const Vector2 normal = {-std::sin(angle / 2), std::cos(angle / 2)};
  const double distance = 2 * kEllipse.support(normal);
  return {distance * normal[0], distance * normal[1], 0};
}

/// kEllipse that is fixed, and one that has rolled on it.
Simulation one_on_another(double h, double angle) {
  State state = no_particles(2);
  add_shape(state, kEllipse, {0, 0}, 0, kMass);
  add_shape(state, kEllipse, rolled(angle), angle, kMass);
  auto setting = setting_of(h, 10);
  setting.gravity = {0, -kGravity, 0};
  setting.given_motions[0] = {};
  setting.solver.tolerance = 1e-12;
  return {setting, state, 1};
}

// A rocking stone: its stiffness is the weight times r_1 r_2/(r_1 + r_2) less the height of the
// centre over the contact, 2 - 1. An amplitude of 1e-3 changes the period by 8e-7 of it, and the
// step by 3e-6.
TEST(RockingEllipse, RollsOnAnEqualOne) {
  const double period =
      2 * std::numbers::pi * std::sqrt((kEllipse.inertia(kMass) + kMass) / (kMass * kGravity));
  auto simulation = one_on_another(4e-3, 1e-3);
  EXPECT_NEAR(period_of(simulation) / period, 1, 5e-6);
}

TEST(RollingEllipses, StayMirrorImages) {
  std::vector<double> errors;
  for (const double h : {2e-3, 1e-3}) {
    auto simulation = one_on_another(h, 0.3);
    double error = 0, least = 1;
    run(simulation, 2, [&](const StepReport& report) {
      expect_converged(report);
      const auto& p = simulation.state().particles;
      least = std::min(least, p.angles[1]);
      error = std::max(error, norm(p.position(1) - rolled(p.angles[1])));
    });
    EXPECT_NEAR(least, -0.3, 0.01);  // it rolls to the other side
    errors.push_back(error);
  }
  // Displacements along the tangent at the beginning of a step are of first order.
  EXPECT_LT(errors[1], 1e-4);
  EXPECT_LT(errors[1], 0.6 * errors[0]);
}

// A cam with a flat follower: the height of the plane over the centre of the ellipse is the support
// in the direction of its normal, and the torque on the cam is the load times the derivative of
// this height by the angle.
TEST(Cam, LiftsAPlaneByItsSupport) {
  const double h = 1e-3, spin = 2, load = 50, mass = 0.5;
  State state = no_particles(2);
  add_shape(state, kEllipse, {0, 0}, 0, kMass, {}, spin);
  auto setting = setting_of(h, 0);
  Plane plane = plane_at_rest({0, 1, 0}, {0, -1, 0});
  plane.load = PlaneLoad{constant({load, 0, 0}), mass};
  setting.planes = {plane};
  setting.given_motions[0].angular_velocity = constant({0, 0, spin});
  setting.solver.tolerance = 1e-9;
  Simulation simulation(setting, state, 1);
  const auto height = [](double angle) {
    return kEllipse.support({std::sin(angle), std::cos(angle)});
  };
  run(simulation, 1.5, [&](const StepReport& report) {
    expect_converged(report);
    const auto& now = simulation.state();
    const double angle = now.particles.angles[0], lifted = height(angle) - 1;
    EXPECT_NEAR(-now.planes[0].displacement, lifted, 1e-9);
    // The plane has the acceleration of the support; force and torque are means of the step, which
    // differ from those in its middle by the second order of h, and of its ends by the first.
    if (now.steps < 3) return;
    const double before = angle - spin * h;
    const double acceleration =
        (height(angle) - 2 * height(before) + height(before - spin * h)) / (h * h);
    const double force = load + mass * acceleration;
    const double slope = (height(before + 1e-6) - height(before - 1e-6)) / 2e-6;
    EXPECT_NEAR(now.given_loads[0].force[1], -force, 1e-4 * load);
    EXPECT_NEAR(now.given_loads[0].torque[2], -force * slope, 1e-4 * load);
  });
}

const Shape kPlate = Shape::plate(1, 0.1);
constexpr double kSpine = 0.9;  // half of its length

TEST(FallingPlate, LandsFlatOnBothEnds) {
  State state = no_particles(2);
  add_shape(state, kPlate, {0.3, 0.6}, 0, kMass);
  auto setting = on_floor(1e-3, 0.5);
  Simulation simulation(setting, state, 1);
  run(simulation, 1, expect_converged);
  const auto& now = simulation.state();
  EXPECT_NEAR(now.particles.position(0)[1], 0.1, 1e-6);
  EXPECT_NEAR(now.particles.angles[0], 0, 1e-9);
  EXPECT_NEAR(energy_of_motion(now.particles), 0, 1e-15);
  const auto contacts = contacts_of(setting, now);
  ASSERT_EQ(contacts.size(), 2U);
  for (const auto& contact : contacts)
    EXPECT_NEAR(contact.normal_force, kMass * kGravity / 2, 1e-6 * kMass * kGravity);
}

// With a step of 1e-7 the plate turns by less than 1e-7 in the impact, and its gap and arms change
// by as much.
TEST(FallingPlate, TurnsAboutTheEndThatItFallsOn) {
  constexpr double kAngle = 0.4, kFall = 1.3, kSmall = 1e-6;
  const double inertia = kPlate.inertia(kMass);
  for (const bool rubs : {false, true}) {
    SCOPED_TRACE(rubs);
    State state = no_particles(2);
    const Vector2 end = {-kSpine * std::cos(kAngle), -kSpine * std::sin(kAngle)};
    add_shape(state, kPlate, {0, 0.1 - end[1]}, kAngle, kMass, {0, -kFall});
    auto setting = on_floor(1e-7, rubs ? 100.0 : 0.0);
    setting.gravity = {};
    Simulation simulation(setting, state, 1);
    expect_converged(simulation.step(1));
    const auto& p = simulation.state().particles;
    const Vector2 arm = {end[0], end[1] - 0.1};  // of the point that touches
    // Angular momentum about this point, or, without friction, the vertical impulse at it.
    const double spin = rubs ? kMass * arm[0] * kFall / (inertia + kMass * dot(arm, arm))
                             : arm[0] * kFall / (1 / kMass + arm[0] * arm[0] / inertia) / inertia;
    EXPECT_NEAR(p.angular_velocities[0], spin, kSmall);
    EXPECT_NEAR(p.velocity(0)[1], -spin * arm[0], kSmall);
    EXPECT_NEAR(p.velocity(0)[0], rubs ? spin * arm[1] : 0, kSmall);
  }
}

// Two plates that lie on each other bear the weight of the upper one at two places, whose moments
// about its centre cancel each other.
TEST(StackedPlates, BearAtBothEndsOfTheirOverlap) {
  State state = no_particles(2);
  add_shape(state, kPlate, {0, 0.1}, 0, kMass);
  add_shape(state, kPlate, {0.5, 0.3}, std::numbers::pi, kMass);
  const auto setting = on_floor(1e-3, 0.5);
  Simulation simulation(setting, state, 1);
  run(simulation, 0.2, expect_converged);
  EXPECT_NEAR(energy_of_motion(simulation.state().particles), 0, 1e-15);
  double sum = 0;
  int between = 0;
  for (const auto& contact : contacts_of(setting, simulation.state()))
    if (contact.first >= 0) {
      ++between;
      sum += contact.normal_force;
    }
  EXPECT_EQ(between, 2);
  EXPECT_NEAR(sum, kMass * kGravity, 1e-6 * kMass * kGravity);
}

// An ellipse whose flat side is wider than the bowl in which it lies rests on two places.
TEST(EllipseInABowl, RestsOnTwoPlaces) {
  const Shape wide = Shape::ellipse(1.6, 0.6);
  State state = no_particles(2);
  add_shape(state, wide, {0, -1.1}, 0, kMass);
  auto setting = setting_of(1e-3, 0);
  setting.domain = DiscDomain{{}, 2};
  setting.gravity = {0, -kGravity, 0};
  Simulation simulation(setting, state, 1);
  run(simulation, 2, expect_converged);
  const auto& now = simulation.state();
  EXPECT_NEAR(now.particles.angles[0], 0, 1e-6);
  EXPECT_NEAR(energy_of_motion(now.particles), 0, 1e-12);
  const auto contacts = contacts_of(setting, now);
  ASSERT_EQ(contacts.size(), 2U);
  for (const auto& contact : contacts) {
    EXPECT_GT(std::abs(contact.normal[0]), 0.3);
    EXPECT_NEAR(contact.normal_force * contact.normal[1], kMass * kGravity / 2,
                1e-6 * kMass * kGravity);
  }
}

// gamma is minus the impulse that the film has absorbed; the film then holds the ellipse until a
// pull has given it back: 0.5 s with 4, and then 1 s with half of it.
TEST(FilmOfAnEllipse, GivesBackWhatItHasAbsorbed) {
  State state = no_particles(2);
  add_shape(state, kEllipse, {0, 1}, 0, kMass);
  auto setting = setting_of(1e-2, 0);
  setting.laws.film.gamma_min = -100;
  setting.planes = {plane_at_rest({}, {0, 1, 0})};
  setting.forces[0] = {{{0.5, {0, -4, 0}}, {10, {0, 2, 0}}}};
  Simulation simulation(setting, state, 1);
  run(simulation, 0.5, expect_converged);
  EXPECT_NEAR(pair_of(simulation.state(), -1, 0).gamma, -2, 1e-9);
  run(simulation, 1.4, expect_converged);
  EXPECT_NEAR(pair_of(simulation.state(), -1, 0).gamma, -0.2, 1e-9);
  EXPECT_NEAR(simulation.state().particles.position(0)[1], 1, 1e-9);
  run(simulation, 1.6, expect_converged);
  EXPECT_EQ(pair_of(simulation.state(), -1, 0).gamma, 0);
  EXPECT_GT(simulation.state().particles.position(0)[1], 1);
}

/// gamma_min of a rough surface follows from the radius of curvature at the contact.
TEST(FilmOfAnEllipse, HasTheRadiusOfCurvature) {
  for (const double angle : {0.0, std::numbers::pi / 2}) {
    State state = no_particles(2);
    add_shape(state, kEllipse, {0, angle == 0 ? 1.0 : 2.0}, angle, kMass);
    auto setting = setting_of(1e-2, 0);
    setting.laws.film.gamma_min.reset();
    setting.laws.film.viscosity = 1e-3;
    setting.laws.film.roughness = 1e-3;
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    setting.forces[0] = constant({0, -100, 0});
    Simulation simulation(setting, state, 1);
    run(simulation, 2, expect_converged);
    const double radius = angle == 0 ? 4 : 0.5;  // a^2/b, b^2/a
    EXPECT_NEAR(pair_of(simulation.state(), -1, 0).gamma,
                setting.laws.film.lowest_gamma(radius, std::numeric_limits<double>::infinity()),
                1e-9);
  }
}

// The plate hangs on a hinge at one end of its spine, and comes to lie on a disc that is fixed.
TEST(HingedPlate, LiesOnADisc) {
  State state = no_particles(2);
  add_shape(state, kPlate, {kSpine, 0}, 0, kMass);
  add_shape(state, Shape::disc(0.3), {1, -1}, 0, 1);
  auto setting = setting_of(1e-3, 0.3);
  setting.gravity = {0, -kGravity, 0};
  setting.given_motions[1] = {};
  Hinge hinge;
  hinge.point = {0, {-kSpine, 0, 0}};
  setting.links.hinges = {hinge};
  Simulation simulation(setting, state, 1);
  run(simulation, 3, expect_converged);
  const auto& now = simulation.state();
  // The distance of the centre of the disc from the line of the plate is the sum of the radii.
  const double angle = now.particles.angles[0];
  EXPECT_NEAR(std::sin(angle) + std::cos(angle), 0.4, 1e-6);
  EXPECT_NEAR(energy_of_motion(now.particles), 0, 1e-12);
}

// A body of two plates that cross falls on the floor and rests on two ends.
TEST(BodyOfPlates, RestsOnTwoEnds) {
  State state = no_particles(2);
  const double angle = 0.7;
  add_shape(state, kPlate, {0, 1.2}, angle, kMass);
  add_shape(state, kPlate, {0, 1.2}, std::numbers::pi - angle, kMass);
  add_rigid_body(state.particles, {{0, 1}});
  const auto setting = on_floor(1e-3, 0.3);
  Simulation simulation(setting, state, 1);
  run(simulation, 1, expect_converged);
  const auto& now = simulation.state();
  EXPECT_NEAR(now.particles.position(0)[1], 0.1 + kSpine * std::sin(angle), 1e-6);
  const auto contacts = contacts_of(setting, now);
  ASSERT_EQ(contacts.size(), 2U);
  for (const auto& contact : contacts)
    EXPECT_NEAR(contact.normal_force, kMass * kGravity, 1e-6 * kMass * kGravity);
}

}  // namespace
}  // namespace viscontact::particles
