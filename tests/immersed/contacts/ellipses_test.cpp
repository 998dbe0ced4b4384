// Ellipses that meet walls, discs, plates and each other in a fluid, docs/physics.md (6.4), whose
// flow a stand-in replaces by drag: levers, finite turns, rolling, films and rebounds.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/immersed/contacts/shapes_in_fluid.hpp"
#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

constexpr double kLong = 1, kShort = 0.5;

void add_ellipse(InFluid& system, const Vector& at, double angle, double mass) {
  add_shape(system.state, Shape::ellipse(kLong, kShort), at, angle, mass);
}

/// Height of the centre above the lowest point at this angle.
double height_at(double angle) {
  return std::hypot(kLong * std::sin(angle), kShort * std::cos(angle));
}

/// Its derivative by the angle.
double slope_at(double angle) {
  return (kLong * kLong - kShort * kShort) * std::sin(angle) * std::cos(angle) / height_at(angle);
}

class Ellipses : public ::testing::TestWithParam<double> {};  // density of the fluid
INSTANTIATE_TEST_SUITE_P(Densities, Ellipses, ::testing::Values(0.0, 1e-12));

// The gap after a turn of more than 1 rad says nothing: the ellipse would be left in the floor.
TEST(EllipseInALongStep, ThatTurnsTooFarOnTheFloorIsAnError) {
  auto system = with_shapes(0.2);
  add_ellipse(system, {10, 1.0, 0}, 0.6, 1);
  system.setting.forces[0] = constant({0, -1000, 0});
  auto simulation = system.simulation(constant_drag(0.5));
  EXPECT_THAT(failure(ErrorKind::kNotConverged,
                      [&] {
                        while (simulation.state().time < 1) simulation.step(1);
                      }),
              Names("ellipse 0", "1 rad"));
}

// Falling onto the floor, it tips over its lowest point, keeps its gap in steps of 0.1 rad and
// more, and comes to lie flat.
TEST_P(Ellipses, LandAndComeToLieFlat) {
  for (const double h : {0.2, 0.05}) {
    auto system = with_shapes(h, GetParam());
    add_ellipse(system, {10, 1.2, 0}, 1.2, 1);
    system.setting.forces[0] = constant({0, -1, 0});
    auto simulation = system.simulation(constant_drag(0.5));
    const double allowed = system.setting.solver.tolerance * kLong;
    EXPECT_GT(largest_turn_of_landing(simulation, 24, allowed), h / 2);
    // It swings, and the swing falls by e in the time 2 I/c = 1.25, so that e^-16 is left of it.
    EXPECT_NEAR(simulation.state().particles.angles[0], 0, 2e-5);
    EXPECT_NEAR(simulation.state().particles.positions[1], kShort + kGap, 2 * allowed);
    EXPECT_NEAR(force_of_walls(simulation, h), 1, 2e-5);
  }
}

/// The angle at `end` of an ellipse with the drag c of each component and the weight 1 that lies on
/// the floor: with the slope s of its height, s (omega s + v) = 0 and the force N of the floor it
/// turns at omega = -N s/c, N = 1/(1 + s^2).
double angle_on_floor(double angle, double drag, double end) {
  constexpr int kSteps = 20'000;
  const double h = end / kSteps;
  const auto rate = [&](double at) {
    const double slope = slope_at(at);
    return -slope / (drag * (1 + slope * slope));
  };
  for (int n = 0; n < kSteps; ++n) angle += h * rate(angle + h / 2 * rate(angle));
  return angle;
}

// The steps are of first order in their length: half of it halves the error, but for terms of
// second order, which are below a tenth.
TEST(EllipseContact, TurnsOnTheFloorAsTheEquationSays) {
  const double drag = 2, start = 1.3, end = 3;
  const double exact = angle_on_floor(start, drag, end);
  const auto error = [&](double h) {
    auto system = with_shapes(h);
    add_ellipse(system, {10, height_at(start) + kGap, 0}, start, 0);
    system.setting.forces[0] = constant({0, -1, 0});
    auto simulation = system.simulation(constant_drag(drag));
    EXPECT_TRUE(run(simulation, end).converged);
    EXPECT_NEAR(gap_to_floor(simulation), kGap, system.setting.solver.tolerance * kLong);
    return simulation.state().particles.angles[0] - exact;
  };
  const double coarse = error(0.05), fine = error(0.025);
  EXPECT_LT(std::abs(fine), 0.01);
  EXPECT_NEAR(coarse / fine, 2, 0.2);
}

// With friction enough, the material point at the floor stays where it is: the ellipse rolls, and
// its contact point moves by the length of the outline that it has rolled on.
TEST(EllipseContact, RollsByTheLengthOfItsOutline) {
  const double torque = -0.8, start = 0.1, end = 4;
  const auto off = [&](double h) {
    auto system = with_shapes(h);
    system.setting.laws.film.gamma_min = 0;
    system.setting.laws.friction = FrictionLaw{50};
    add_ellipse(system, {10, height_at(start) + kGap, 0}, start, 0);
    system.setting.forces[0] = constant({0, -4, 0});
    system.setting.torques[0] = constant({0, 0, 4 * torque});
    auto simulation = system.simulation(constant_drag(0.5));
    const auto contact_of = [&] {
      const auto shape = simulation.state().particles.placed_shape(0);
      const PlanePosition floor{{0, 0, 0}, {0, 1, 0}};
      return WallContacts(floor, shape).at(0, floor, shape).on_obstacle[0];
    };
    const auto parameter_of = [&] {  // of the lowest point on the outline
      const double angle = simulation.state().particles.angles[0];
      return std::atan2(-kShort * std::cos(angle), -kLong * std::sin(angle));
    };
    const double place = contact_of();
    double rolled = 0, before = parameter_of();
    while (simulation.state().time < end - h / 2) {
      EXPECT_TRUE(simulation.step(end).converged);
      double now = parameter_of();
      now += 2 * std::numbers::pi * std::round((before - now) / (2 * std::numbers::pi));
      // Simpson's rule errs by the fourth power of the turn of the step.
      const Shape shape = Shape::ellipse(kLong, kShort);
      rolled +=
          (now - before) / 6 *
          (shape.at(before).speed + 4 * shape.at((before + now) / 2).speed + shape.at(now).speed);
      before = now;
    }
    EXPECT_GT(std::abs(rolled), 2);
    return contact_of() - place - rolled;
  };
  const double coarse = off(0.02), fine = off(0.01);
  EXPECT_LT(std::abs(fine), 0.05);
  EXPECT_NEAR(coarse / fine, 2, 0.2);
}

/// Without mass the load is shared by the levers of force and contact, as with plates.
TEST(EllipseContact, TurnsAtTheRateOfTheLever) {
  const double angle = 0.5;
  auto system = with_shapes(1e-4);
  add_ellipse(system, {10, height_at(angle) + kGap, 0}, angle, 0);
  system.setting.forces[0] = constant({0, -1, 0});
  auto simulation = system.simulation(constant_drag(2));
  EXPECT_TRUE(simulation.step(1).converged);
  const double slope = slope_at(angle);
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(p.angular_velocities[0], -slope / (2 * (1 + slope * slope)), 1e-4);
  EXPECT_NEAR(pair_of(simulation.state(), -3, 0).gamma, -1e-4 / (1 + slope * slope), 1e-8);
}

// Two free ellipses that are pushed together keep the momentum, and the angular momentum but
// for the way of a step. Drag is nearly 0.
TEST(EllipseContact, KeepsTheMomentumOfAPair) {
  for (const double friction : {0.0, 0.4}) {
    const auto change = [&](double h) {
      auto system = with_shapes(h);
      add_ellipse(system, {10, 10, 0}, 0.3, 1);
      add_ellipse(system, {10.6, 11.6, 0}, -0.9, 2);
      auto& p = system.state.particles;
      p.velocities = {0, 1, 0, -1};
      system.setting.laws.film.gamma_min = 0;
      if (friction > 0) system.setting.laws.friction = FrictionLaw{friction};
      const double before = angular_momentum_with_spin(p);
      auto simulation = system.simulation(constant_drag(1e-9));
      bool has_met = false;
      while (simulation.state().time < 0.8 - h / 2) {
        EXPECT_TRUE(simulation.step(10).converged);
        has_met = has_met || pair_of(simulation.state(), 0, 1).impulse > 0;
      }
      EXPECT_TRUE(has_met);
      const auto& after = simulation.state().particles;
      for (std::size_t d = 0; d < 2; ++d)
        EXPECT_NEAR(
            after.masses[0] * after.velocities[d] + after.masses[1] * after.velocities[2 + d],
            d == 0 ? 0 : -1, 1e-8);
      EXPECT_GT(std::abs(after.angular_velocities[0]), 0.1);
      return angular_momentum_with_spin(after) - before;
    };
    const double coarse = change(0.01), fine = change(0.0025);
    EXPECT_LT(std::abs(coarse), 0.02);
    EXPECT_LT(std::abs(fine), 0.4 * std::abs(coarse) + 1e-8);
  }
}

// Plain contact with restitution: an ellipse that falls without turning rebounds; the rate of its
// gap afterwards is e_d times that before, wherever it touches.
TEST_P(Ellipses, ReboundFromTheFloor) {
  for (const double angle : {0.0, 0.5, std::numbers::pi / 2}) {
    auto system = with_shapes(0.001, GetParam());
    add_ellipse(system, {10, kGap + height_at(angle) + 0.0101, 0}, angle, 1);
    system.state.particles.velocities = {0, -1};
    system.setting.laws.film.gamma_min = 0;
    system.setting.laws.restitution.coefficient = 0.6;
    auto simulation = system.simulation(constant_drag(1e-6));
    run(simulation, 0.014);
    const auto& p = simulation.state().particles;
    const double rate = p.velocities[1] - slope_at(angle) * p.angular_velocities[0];
    EXPECT_NEAR(rate, 0.6, 0.01) << angle;
    // The impulse acts at the lever: I omega = -s p with p = m (v + 1).
    EXPECT_NEAR(p.inertias[0] * p.angular_velocities[0],
                -slope_at(angle) * p.masses[0] * (p.velocities[1] + 1), 0.01);
  }
}

// Nearly a disc, it has the motion and the film of the disc, with roughness, friction, a floor and
// a second particle above it. Gaps of discs are linear in the step, those of ellipses are not,
// which differ by the square of the way across the normal; the pull of 1e-4 makes it 1e-8.
TEST(EllipseContact, OfAnEllipseThatIsNearlyADiscIsThatOfTheDisc) {
  const auto state_with = [](const Shape& shape) {
    auto system = with_shapes(0.02);
    add_shape(system.state, shape, {10, 1.05, 0}, 0.4, 1);
    add_shape(system.state, Shape::disc(0.5), {10, 2.6, 0}, 0, 1);
    for (const int k : {0, 1}) system.setting.forces[k] = constant({1e-4, -1, 0});
    system.setting.torques[1] = constant({0, 0, 0.02});
    system.setting.laws.film.viscosity = 0.01;
    system.setting.laws.film.roughness = kGap / 10;
    system.setting.laws.friction = FrictionLaw{0.3};
    auto simulation = system.simulation(constant_drag(0.5));
    EXPECT_TRUE(run(simulation, 1).converged);
    return simulation.state();
  };
  const State disc = state_with(Shape::disc(1)), ellipse = state_with(Shape::ellipse(1, 1 + 1e-9));
  const auto floor = pair_of(disc, -3, 0), pair = pair_of(disc, 0, 1);
  EXPECT_LT(floor.gamma, 0);
  EXPECT_LT(pair.gamma, 0);
  constexpr double kError = 1e-7;
  EXPECT_NEAR(pair_of(ellipse, -3, 0).gamma, floor.gamma, kError);
  EXPECT_NEAR(pair_of(ellipse, 0, 1).gamma, pair.gamma, kError);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(ellipse.particles.positions[i], disc.particles.positions[i], kError);
  EXPECT_NEAR(ellipse.particles.angles[0], disc.particles.angles[0], kError);
}

// The tip is curved as a disc of the radius b^2/a: an ellipse on its tip has the film of this disc.
TEST(EllipseContact, HasTheFilmOfItsRadiusOfCurvature) {
  auto system = with_shapes(0.01);
  add_ellipse(system, {10, kGap + kLong, 0}, std::numbers::pi / 2, 1);
  system.setting.forces[0] = constant({0, -1, 0});
  system.setting.laws.film.viscosity = 1;
  system.setting.laws.film.roughness = kGap / 10;
  auto simulation = system.simulation(constant_drag(1e-3));
  // Until the film is spent: 0.01 times the force 1 a step, and |gamma_min| is below 32.
  for (int n = 0; n < 3200; ++n) simulation.step(1e9);
  const double tip = kShort * kShort / kLong;
  const double expected = impulse_of_film(FilmShape::kDiscs, 1, tip,
                                          std::numeric_limits<double>::infinity(), kGap, kGap / 5);
  EXPECT_NEAR(pair_of(simulation.state(), -3, 0).gamma, expected, 1e-9 * std::abs(expected));
}

// Across a round wall both tips are held. A push along the ellipse is borne by one of them.
TEST_P(Ellipses, MeetARoundWallWithBothTips) {
  auto system = with_shapes(0.02, GetParam());
  system.setting.domain = DiscDomain{{0, 0, 0}, kLong + 0.03};
  add_ellipse(system, {0.005, 0, 0}, 0.2, 1);
  system.setting.forces[0] = constant({0.3, -1, 0});
  auto simulation = system.simulation(constant_drag(0.5));
  const double allowed = system.setting.solver.tolerance * kLong;
  const PlanePosition wall{{0, 0, 0}, {}, kLong + 0.03};
  for (int n = 0; n < 150; ++n) {
    EXPECT_TRUE(simulation.step(100).converged);
    EXPECT_GT(gap(wall, simulation.state().particles.placed_shape(0)), kGap - allowed);
  }
  EXPECT_EQ(simulation.state().walls.size(), 2U);
}

// With coupling = splitting the masses alone share the impulse.
TEST(EllipseContact, ProjectsVelocitiesWithSplitting) {
  const double angle = 0.5, h = 1e-4;
  auto system = with_shapes(h);
  system.setting.fluid->coupling = Coupling::kSplitting;
  add_ellipse(system, {10, height_at(angle) + kGap, 0}, angle, 1);
  system.state.particles.velocities = {0, -1};
  system.setting.laws.film.gamma_min = 0;
  auto simulation = system.simulation(constant_drag(1e-9));
  EXPECT_TRUE(simulation.step(h).converged);
  const auto& p = simulation.state().particles;
  const double s = slope_at(angle), inertia = p.inertias[0];
  // v = -1 + p, omega = -s p/I, and v = s omega. The slope changes by about h in the step.
  const double impulse = 1 / (1 + s * s / inertia);
  EXPECT_NEAR(p.positions[1] - height_at(angle) - kGap, h * (impulse - 1), 1e-3 * h);
  EXPECT_NEAR(p.angles[0] - angle, -h * s * impulse / inertia, 1e-3 * h);
}

/// Ellipses, a plate and a disc that are pushed into a corner of two planes, with film, friction
/// and inertia. `place` maps a point of the scene, `turn` [rad] is added to all angles, lengths are
/// in `unit`, `mirror` is -1 for a mirrored scene, and `order` gives the number of each particle.
struct Scene {
  double turn = 0, unit = 1, mirror = 1;
  std::vector<std::size_t> order = {0, 1, 2, 3};

  Vector place(const Vector& x) const {
    const Vector m = {mirror * x[0], x[1], 0};
    return unit * Vector{std::cos(turn) * m[0] - std::sin(turn) * m[1],
                         std::sin(turn) * m[0] + std::cos(turn) * m[1], 0};
  }
  Vector direction(const Vector& x) const { return 1 / unit * place(x); }

  /// x, y and angle of all particles at the end, mapped back to the scene as it is by default.
  std::vector<double> result() const {
    InFluid system = in_fluid(2, 1, 0.02, 0.02 * unit);
    system.setting.domain = DiscDomain{{}, 100 * unit};
    system.setting.planes = {{{place({0, 0, 0}), direction({0, 1, 0})}, {}},
                             {{place({-2, 0, 0}), direction({1, 0, 0})}, {}}};
    system.setting.laws.film.gamma_min = -0.05 * unit;
    system.setting.laws.friction = FrictionLaw{0.3};
    system.setting.solver.tolerance = 1e-9;
    struct Body {
      Shape shape;
      Vector at;
      double angle;
    };
    const std::vector<Body> bodies = {{Shape::ellipse(1, 0.5), {-0.6, 1.2, 0}, 0.4},
                                      {Shape::ellipse(0.4, 0.8), {0.9, 0.9, 0}, 1.0},
                                      {Shape::plate(0.7, 0.2), {0.3, 2.3, 0}, -0.5},
                                      {Shape::disc(0.5), {-1.3, 2.6, 0}, 0}};
    std::vector<std::size_t> number(order.size());  // of each body
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto& body = bodies[order[k]];
      number[order[k]] = k;
      add_shape(system.state, body.shape.scaled(unit), place(body.at), mirror * body.angle + turn,
                1);
      system.setting.forces[static_cast<std::int32_t>(k)] =
          constant(unit * direction({-0.4, -1, 0}));
    }
    auto simulation = system.simulation([&](const Particles& p) -> Eigen::MatrixXd {
      auto matrix = constant_drag(0.5)(p);
      for (Eigen::Index k = 2; k < matrix.rows(); k += 3) matrix(k, k) *= unit * unit;
      return matrix;
    });
    EXPECT_TRUE(run(simulation, 1.2).converged);
    const auto& p = simulation.state().particles;
    std::vector<double> found;
    for (const auto k : number) {
      const Vector x = 1 / unit * p.position(k);
      found.push_back(mirror * (std::cos(turn) * x[0] + std::sin(turn) * x[1]));
      found.push_back(std::cos(turn) * x[1] - std::sin(turn) * x[0]);
      found.push_back(mirror * (p.angles[k] - turn));
    }
    return found;
  }
};

void expect_same(const Scene& scene, double error) {
  const auto expected = Scene{}.result(), found = scene.result();
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], error) << i;
}

// Rounding errors of 1e-16 grow by the condition of the contact problem, some 1e4, and gaps within
// half of the tolerance, 1e-9, count as closed.
constexpr double kSame = 1e-8;

TEST(EllipseContact, IsTheSameInAnotherOrder) { expect_same({.order = {3, 1, 0, 2}}, kSame); }
TEST(EllipseContact, IsTheSameMirrored) { expect_same({.mirror = -1}, kSame); }
TEST(EllipseContact, IsTheSameTurnedWithItsPlanes) {
  expect_same({.turn = std::numbers::pi / 6}, kSame);
}
TEST(EllipseContact, IsTheSameInOtherUnits) { expect_same({.unit = 1e-3}, kSame); }

}  // namespace
}  // namespace viscontact::particles
