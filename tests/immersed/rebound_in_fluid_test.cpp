// Rebounds of solids in a fluid, docs/physics.md (6.11): the coefficient of one sphere against the
// first integral of its motion, spheres that stay, what every impact must keep, and restarts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/contact_dynamics/impacts/scene.hpp"
#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particle_runs/io/restart.hpp"

namespace viscontact::particles {
namespace {

constexpr double kDry = 0.97;
constexpr double kPi = std::numbers::pi;

/// Units of a system: the numbers of the tests are in units of these.
struct Units {
  double length = 1, mass = 1, time = 1;
};

/// A sphere of radius 1 with the velocity -1 and the gap `gap` to the floor, around which the drag
/// is k/q at all gaps with k = 1, so that its mass is its Stokes number. Contact is made at the gap
/// 0.1, and the solids touch where k/q has absorbed ln 10 more, at 0.01.
InFluid sphere_in_film(double stokes, double gap, double h, const Units& units = {}) {
  auto system = in_fluid(1, 50 * units.length, h * units.time, 0.1 * units.length);
  const double viscosity = units.mass / (units.length * units.time) / (6 * kPi);
  system.setting.fluid->viscosity = viscosity;
  system.setting.laws.film.gamma_min = -std::log(10.0) * units.mass * units.length / units.time;
  system.setting.laws.restitution.coefficient = kDry;
  add_particle(system.state, {(1 + gap) * units.length, 0, 0}, units.length, stokes * units.mass,
               {-units.length / units.time, 0, 0});
  return system;
}

Resistance film_drag(const Units& units = {}) {
  const double k = units.mass * units.length / units.time;
  return [k, r = units.length](const Particles& p) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Constant(1, 1, k / (p.positions[0] - r));
  };
}

/// Of a sphere that starts at the gap 1: its velocity when it is there again, over that at the
/// start; 0 if it is not there until the time 60. The rebounds are added to `rebounds`.
double coefficient(InFluid system, const Units& units, std::vector<Rebound>& rebounds) {
  auto simulation = system.simulation(film_drag(units));
  double before = 0, velocity = 0;
  while (simulation.state().time < 60 * units.time) {
    EXPECT_TRUE(simulation.step(1e9 * units.time).converged);
    const auto& p = simulation.state().particles;
    const auto& more = simulation.rebounds();
    rebounds.insert(rebounds.end(), more.begin(), more.end());
    const double gap = p.positions[0] / units.length - 1;
    const double u = p.velocities[0] / units.length * units.time;
    EXPECT_GE(gap, 0.1 - 1e-9);
    if (gap >= 1 && u > 0) return velocity + (u - velocity) * (1 - before) / (gap - before);
    before = gap;
    velocity = u;
  }
  return 0;
}

/// Does so many steps, each of which must converge. Returns how often solids rebound in them.
std::size_t rebounds_in(FluidSimulation& simulation, int steps) {
  std::size_t rebounds = 0;
  for (int step = 0; step < steps; ++step) {
    EXPECT_TRUE(simulation.step(1e9).converged);
    rebounds += simulation.rebounds().size();
  }
  return rebounds;
}

TEST(ReboundInFluid, OfASphereIsThatOfTheFirstIntegral) {
  // (4.14) with the drag k/q at all gaps, which the fluid resolves above 0.1. It is of first order
  // in the step, and the film and the solids are exact, so that the error vanishes with the step.
  for (const double stokes : {27.0, 50.0, 152.0}) {
    SCOPED_TRACE(stokes);
    const double expected = kDry - (1 + kDry) * std::log(100.0) / stokes;
    std::vector<double> errors;
    for (const double h : {0.01, 0.005, 0.0025}) {
      std::vector<Rebound> rebounds;
      errors.push_back(coefficient(sphere_in_film(stokes, 1, h), {}, rebounds) - expected);
      ASSERT_EQ(rebounds.size(), 1U);
      EXPECT_EQ(rebounds[0].first, -2);
      const double before = 1 - std::log(10.0) / stokes;  // at the gap 0.1
      EXPECT_NEAR(rebounds[0].approach_velocity, -before, 3 * h);
      // In the step of an impact the drag, at most 10, is not counted or counted twice.
      EXPECT_NEAR(rebounds[0].solid_impulse, stokes - std::log(100.0), 10 * h);
    }
    // A step of 0.01 is a tenth of the gap of contact, in which the drag takes 0.1/St of the speed.
    EXPECT_LT(std::abs(errors[0]), 0.3 / stokes);
    EXPECT_LT(std::abs(errors[2]), 0.3 / stokes / 4);
  }
}

TEST(ReboundInFluid, OfASlowSphereEndsInTheFluid) {
  // No solids touch below St = ln 100 = 4.6. Below 6.98 they give back less than ln 10, which it
  // takes to pull the film open to the gap of contact. Below 9.35 the fluid stops the sphere on the
  // way to the gap at which it started.
  const double film = std::log(10.0);
  for (const double stokes : {2.0, 4.5, 6.0, 9.2}) {
    SCOPED_TRACE(stokes);
    auto system = sphere_in_film(stokes, 1, 0.002);
    auto simulation = system.simulation(film_drag());
    std::vector<Rebound> rebounds;
    while (simulation.state().time < 30) {
      EXPECT_TRUE(simulation.step(1e9).converged);
      const auto& more = simulation.rebounds();
      rebounds.insert(rebounds.end(), more.begin(), more.end());
    }
    const double solid = stokes - 2 * film;
    const double left = kDry * solid - film;  // momentum at the gap of contact
    const auto& state = simulation.state();
    const double gamma = pair_of(state, -2, 0).gamma;
    ASSERT_EQ(rebounds.size(), solid > 0 ? 1U : 0U);
    if (stokes < film) continue;  // it stops above the gap of contact
    EXPECT_NEAR(gamma, solid > 0 ? std::min(left, 0.0) : film - stokes, 0.02 * stokes);
    for (const auto& rebound : rebounds)
      EXPECT_NEAR(rebound.velocity, std::max(left, 0.0) / stokes, 0.02);
    const double gap = solid > 0 ? 0.1 * std::exp(std::max(left, 0.0)) : 0.1;
    EXPECT_NEAR(state.particles.positions[0] - 1, gap, left > 0 ? 0.02 : 1e-9);
    EXPECT_NEAR(state.particles.velocities[0], 0, 1e-2);
  }
}

TEST(ReboundInFluid, DoesNotDependOnTheUnits) {
  std::vector<Rebound> rebounds;
  const double expected = coefficient(sphere_in_film(27, 1, 0.02), {}, rebounds);
  Random random(4);
  for (int i = 0; i < 8; ++i) {
    const Units units{random.decades(-5, 5), random.decades(-5, 5), random.decades(-5, 5)};
    std::vector<Rebound> found;
    EXPECT_NEAR(coefficient(sphere_in_film(27, 1, 0.02, units), units, found), expected, 1e-9);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(found[0].time / units.time / rebounds[0].time, 1, 1e-9);
    EXPECT_NEAR(found[0].solid_impulse / (units.mass * units.length / units.time) /
                    rebounds[0].solid_impulse,
                1, 1e-9);
  }
}

/// A disc that flies to the floor of a box without drag, whose contact is made at the gap 0.
InFluid flying_disc(double h, double dry, double gamma_min) {
  auto system = in_fluid(2, 20, h, 0);
  system.setting.laws.film.gamma_min = gamma_min;
  system.setting.laws.restitution.coefficient = dry;
  return system;
}

constexpr double kNoDrag = 1e-10;  // the stand-in fluid needs a resistance > 0

TEST(ReboundInFluid, OfADiscWithoutDragIsTheDryOneWhereverTheStepsLie) {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const double gap = random.decades(-2, 0.5), h = random.decades(-2, 0.5) * gap;
    const double gamma_min = random.chance(0.5) ? 0 : -random.uniform(0, 0.3);
    auto system = flying_disc(h, 0.7, gamma_min);
    if (random.chance(0.5)) system.setting.fluid->coupling = Coupling::kSplitting;
    add_particle(system.state, {10, 1 + gap, 0}, 1, 1, {0.3, -1, 0});
    auto simulation = system.simulation(constant_drag(kNoDrag));
    run(simulation, 2.3 * gap);
    const double e = 0.7 + 1.7 * gamma_min;  // (4.13)
    const auto& p = simulation.state().particles;
    EXPECT_NEAR(p.velocities[1], e, 1e-8) << i;
    EXPECT_NEAR(p.velocities[0], 0.3, 1e-8) << i;
    EXPECT_NEAR(p.positions[1] - 1, e * 1.3 * gap, 1e-8 * (1 + gap)) << i;
    EXPECT_EQ(pair_of(simulation.state(), -3, 0).gamma, 0);
  }
}

TEST(ReboundInFluid, OfThreeDiscsWithoutDragIsTheDryOne) {
  // Oblique impacts one after the other, in steps so short that no step has two of them.
  const auto add_discs = [](State& state) {
    add_particle(state, {4, 10, 0}, 1, 1, {1, 0, 0});
    add_particle(state, {7, 10.5, 0}, 1, 3);
    add_particle(state, {12, 11, 0}, 1, 1);
  };
  auto system = flying_disc(0.005, 0.9, 0);
  add_discs(system.state);
  auto simulation = system.simulation(constant_drag(kNoDrag));
  std::size_t impacts = 0;
  while (simulation.state().time < 9 - 1e-9) {
    simulation.step(9);
    impacts += simulation.rebounds().size();
  }
  Scene scene{no_particles(2), {}};
  add_discs(scene.state);
  scene.setting.laws = system.setting.laws;
  scene.setting.time_step = 0.005;
  Simulation dry(scene.setting, scene.state, 1);
  EXPECT_EQ(rebounds_until(9, dry).size(), impacts);
  EXPECT_EQ(impacts, 2U);
  for (std::size_t i = 0; i < 6; ++i) {
    // The normal is that at the beginning of the step of the impact: of first order.
    EXPECT_NEAR(simulation.state().particles.velocities[i], dry.state().particles.velocities[i],
                0.005);
    EXPECT_NEAR(simulation.state().particles.positions[i], dry.state().particles.positions[i],
                0.02);
  }
}

TEST(ReboundInFluid, OfARowIsThatOfPoissonAllAtOnce) {
  // Three equal discs that touch: all contacts are decided together, (5.15). With e_d = 1 the first
  // keeps -1/3 of its velocity.
  auto system = flying_disc(0.1, 1, 0);
  add_particle(system.state, {4, 10, 0}, 1, 1, {1, 0, 0});
  add_particle(system.state, {7, 10, 0}, 1, 1);
  add_particle(system.state, {9, 10, 0}, 1, 1);
  auto simulation = system.simulation(constant_drag(kNoDrag));
  run(simulation, 1.5);
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(p.velocities[0], -1.0 / 3, 1e-8);
  EXPECT_NEAR(p.velocities[2], 2.0 / 3, 1e-8);
  EXPECT_NEAR(p.velocities[4], 2.0 / 3, 1e-8);
}

TEST(ReboundInFluid, KeepsMomentumAndLosesEnergy) {
  // A cloud in a periodic box without drag. Velocities do not change between impacts.
  Random random(8);
  for (const double gamma_min : {0.0, -0.02})
    for (const double dry : {0.6, 1.0}) {
      auto system = flying_disc(0.02, dry, gamma_min);
      system.state = random_cloud(
          2, 25, 9, [&] { return random.uniform(0.5, 1); }, random);
      // A gap that is closed by more than this is opened, which takes work.
      system.setting.solver.tolerance = 1e-10;
      auto& p = system.state.particles;
      double furthest = 0;
      for (const double x : p.positions) furthest = std::max(furthest, std::abs(x) + 1.01);
      system.setting.domain = BoxDomain{{-furthest, -furthest}, {furthest, furthest}, {true, true}};
      for (auto& v : p.velocities) v = random.uniform(-1, 1);
      auto simulation = system.simulation(constant_drag(kNoDrag));
      const auto momentum_before = momentum(p);
      double energy = kinetic_energy(p);
      std::size_t impacts = 0;
      for (int step = 0; step < 200; ++step) {
        EXPECT_TRUE(simulation.step(1e9).converged) << step;
        impacts += simulation.rebounds().size();
        const auto& now = simulation.state().particles;
        EXPECT_NEAR(norm(momentum(now) - momentum_before), 0, 1e-7);
        // The film of a pair that turns pulls along a normal that has turned, which may add a
        // little energy in steps without an impact.
        const bool only_solids = gamma_min == 0 || !simulation.rebounds().empty();
        EXPECT_LE(kinetic_energy(now) / energy - 1, only_solids ? 1e-9 : 1e-6) << step;
        energy = kinetic_energy(now);
      }
      EXPECT_GT(impacts, 30U);
    }
}

TEST(ReboundInFluid, HeightsConvergeWithTheStepAndTheBallComesToRest) {
  // A ball that falls from the height 1 under the gravity 2 with hardly any drag.
  const double dry = 0.8;
  const auto heights = [&](double h) {
    auto system = in_fluid(1, 50, h, 0);
    system.setting.laws.film.gamma_min = 0;
    system.setting.laws.restitution.coefficient = dry;
    system.setting.gravity = {-2, 0, 0};
    add_particle(system.state, {2, 0, 0}, 1, 3);
    auto simulation = system.simulation(constant_drag(kNoDrag));
    std::vector<double> found;
    double highest = 0;
    const double stops = (1 + dry) / (1 - dry);
    while (simulation.state().time < 1.5 * stops) {
      simulation.step(1e9);
      if (!simulation.rebounds().empty()) {
        found.push_back(highest);
        highest = 0;
      }
      highest = std::max(highest, simulation.state().particles.positions[0] - 1);
      EXPECT_GE(simulation.state().particles.positions[0], 1 - 1e-6);
    }
    EXPECT_NEAR(simulation.state().particles.positions[0], 1, 1e-6);
    EXPECT_NEAR(simulation.state().particles.velocities[0], 0, 1e-6);
    return found;
  };
  std::vector<double> errors;
  for (const double h : {0.01, 0.0025}) {
    const auto found = heights(h);
    ASSERT_GT(found.size(), 4U);
    double largest = 0;
    for (const int k : {1, 2, 3})
      largest =
          std::max(largest, std::abs(found[static_cast<std::size_t>(k)] - std::pow(dry, 2 * k)));
    errors.push_back(largest);
  }
  // Of first order: in the step of an impact the velocity at its end is that of the whole step.
  EXPECT_LT(errors[0], 0.04);
  EXPECT_LT(errors[1], 0.01);
}

TEST(ReboundInFluid, DoesNotOccurUnderALoadOrWithoutMomentum) {
  // Spheres that are pressed to the floor and to each other, at rest and settling so slowly that a
  // step is far longer than the time in which the drag stops them.
  for (const double gamma_min : {0.0, -0.4})
    for (const double drag : {0.1, 1e4})
      for (const double gap : {0.0, 0.3}) {
        SCOPED_TRACE(drag);
        auto system = in_fluid(1, 50, 0.1, 0.05);
        system.setting.laws.film.gamma_min = gamma_min;
        system.setting.laws.restitution.coefficient = 1;
        add_pushed(system, {1.05 + gap * 1e-3, 0, 0}, 1, 2, {-3, 0, 0});
        add_pushed(system, {3.10 + gap * 2e-3, 0, 0}, 1, 1, {-3, 0, 0});
        auto simulation = system.simulation(constant_drag(drag));
        EXPECT_EQ(rebounds_in(simulation, 300), 0U);
        EXPECT_NEAR(simulation.state().particles.positions[0], 1.05, 1e-4);
        EXPECT_NEAR(simulation.state().particles.positions[1], 3.10, 1e-4);
      }
}

TEST(ReboundInFluid, OfAWallThatComesIsRelativeToIt) {
  // A disc at rest, hit by a plane at the velocity 1, leaves it at e_d.
  auto system = flying_disc(0.03, 0.7, 0);
  add_particle(system.state, {10, 6, 0}, 1, 1);
  auto plane = plane_at_rest({10, 4.5, 0}, {0, 1, 0});
  plane.velocity = constant({0, 1, 0});
  system.setting.planes = {plane};
  auto simulation = system.simulation(constant_drag(kNoDrag));
  run(simulation, 2);
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(p.velocities[1], 1.7, 1e-8);
  EXPECT_NEAR(p.positions[1], 6 + 1.5 * 1.7, 1e-7);
}

TEST(ReboundInFluid, OfADrivenDiscThatComesIsRelativeToIt) {
  // A disc at rest, hit by a driven disc at the velocity 1, leaves it at e_d. Later on the driven
  // disc pushes it against the drag 1 at the velocity 1, which is a load.
  for (const bool pushes : {false, true})
    for (const auto coupling : {Coupling::kConstrained, Coupling::kSplitting}) {
      auto system = flying_disc(0.03, 0.7, 0);
      system.setting.fluid->coupling = coupling;
      add_particle(system.state, {10, 4, 0}, 1, 1, {0, 1, 0});
      add_particle(system.state, {10, pushes ? 6 : 6.5, 0}, 1, 1, {0, pushes ? 1.0 : 0.0, 0});
      system.setting.given_motions[0].velocity = constant({0, 1, 0});
      auto simulation = system.simulation(constant_drag(pushes ? 1 : kNoDrag));
      std::size_t rebounds = 0;
      while (simulation.state().time < 2) {
        EXPECT_TRUE(simulation.step(2).converged);
        rebounds += simulation.rebounds().size();
      }
      const auto& p = simulation.state().particles;
      EXPECT_EQ(rebounds, pushes ? 0U : 1U);
      EXPECT_NEAR(p.velocities[3], pushes ? 1 : 1.7, 1e-8);
      EXPECT_NEAR(p.positions[3], pushes ? 8 : 6.5 + 1.5 * 1.7, 1e-7);
    }
}

/// The sphere of the first test in a fluid with inertia.
InFluid with_inertia(InFluid system) {
  system.setting.fluid->density = 1e-12;  // no buoyancy; > 0: the solver has the masses
  system.setting.fluid->start = FlowStart::kRest;
  return system;
}

TEST(ReboundInFluid, WithInertiaIsThatOfTheFirstIntegral) {
  for (const double stokes : {9.2, 27.0, 152.0}) {
    SCOPED_TRACE(stokes);
    const double expected = std::max(0.0, kDry - (1 + kDry) * std::log(100.0) / stokes);
    for (const double h : {0.01, 0.0025}) {
      std::vector<Rebound> rebounds;
      EXPECT_NEAR(coefficient(with_inertia(sphere_in_film(stokes, 1, h)), {}, rebounds), expected,
                  60 * h / stokes);
      EXPECT_EQ(rebounds.size(), 1U);
    }
  }
}

TEST(ReboundInFluid, InTheFirstStepWithInertiaIsCountedOnce) {
  // The sphere is at the gap of contact when the motion begins. The film takes ln 10 twice.
  for (const double stokes : {27.0, 152.0})
    for (const auto coupling : {Coupling::kConstrained, Coupling::kSplitting}) {
      auto system = with_inertia(sphere_in_film(stokes, 0.1, 0.001));
      system.setting.fluid->coupling = coupling;
      auto simulation = system.simulation(constant_drag(kNoDrag));
      EXPECT_EQ(rebounds_in(simulation, 30), 1U);
      EXPECT_NEAR(simulation.state().particles.velocities[0],
                  kDry - (1 + kDry) * std::log(10.0) / stokes, 1e-9);
      EXPECT_EQ(pair_of(simulation.state(), -2, 0).gamma, 0);
    }
}

TEST(ReboundInFluid, AfterAShorterStepWithInertiaKeepsItsImpulse) {
  // Steps that end at frames are shorter, and impulses act for the length of the step before.
  auto system = with_inertia(sphere_in_film(50, 0.5, 0.03));
  auto simulation = system.simulation(constant_drag(kNoDrag));
  std::vector<Rebound> rebounds;
  for (const double end : {0.1, 0.2, 0.3, 0.38, 0.405, 0.5, 0.6})
    while (simulation.state().time < end - 1e-9) {
      EXPECT_TRUE(simulation.step(end).converged);
      const auto& more = simulation.rebounds();
      rebounds.insert(rebounds.end(), more.begin(), more.end());
    }
  ASSERT_EQ(rebounds.size(), 1U);
  EXPECT_NEAR(rebounds[0].time, 0.4, 1e-9);
  const double e = kDry - (1 + kDry) * std::log(10.0) / 50;
  EXPECT_NEAR(simulation.state().particles.velocities[0], e, 1e-8);
  EXPECT_NEAR(simulation.state().particles.positions[0], 1.1 + 0.2 * e, 1e-8);
}

TEST(ReboundInFluid, GoesOnFromARestartWithTheSameBits) {
  for (const bool has_inertia : {false, true}) {
    SCOPED_TRACE(has_inertia);
    auto system = sphere_in_film(40, 0.2, 0.013);
    system.setting.gravity = {-1, 0, 0};
    if (has_inertia) system = with_inertia(system);
    auto whole = system.simulation(film_drag());
    std::size_t rebounds = 0;
    for (int step = 0; step < 250; ++step) {
      auto continued = system;
      continued.state = whole.state_to_save();
      auto simulation = continued.simulation(film_drag());
      simulation.step(1e9);
      whole.step(1e9);
      rebounds += whole.rebounds().size();
      ASSERT_EQ(write_restart(simulation.state_to_save()), write_restart(whole.state_to_save()))
          << step;
    }
    EXPECT_GE(rebounds, 2U);
  }
}

}  // namespace
}  // namespace viscontact::particles
