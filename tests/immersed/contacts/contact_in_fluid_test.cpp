// Contact of particles in a fluid: what gamma books, when a film lets go, walls, images, given
// motions, and steps that fail.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

Pair wall_of(const FluidSimulation& simulation, std::int32_t wall, std::int32_t particle) {
  return pair_of(simulation.state(), wall, particle);
}

/// A sphere that is held at the floor, with its surface at the threshold gap.
InFluid sphere_on_floor(double mass, double h, double threshold = 0.1) {
  auto system = in_fluid(1, 10, h, threshold);
  add_particle(system.state, {1 + threshold, 0, 0}, 1, mass);
  return system;
}

TEST(ContactInFluid, BooksTheWholeLoadWithAnyStep) {
  for (const double mass : {0.0, 1.0, 20.0})
    for (const double h : {0.5, 0.1, 0.003}) {
      SCOPED_TRACE(mass);
      auto system = sphere_on_floor(mass, h);
      system.setting.forces[0] = constant({-7, 0, 0});
      auto simulation = system.simulation(constant_drag(100));
      for (int step = 1; step <= 20; ++step) {
        simulation.step(1e9);
        const auto& state = simulation.state();
        EXPECT_NEAR(wall_of(simulation, -2, 0).gamma, -7 * state.time, 1e-12 * 7 * state.time);
        EXPECT_NEAR(state.particles.positions[0], 1.1, 1e-13);
      }
      EXPECT_LE(wall_of(simulation, -2, 0).gamma_error, 1e-9);
    }
}

TEST(ContactInFluid, SplittingLosesWhatTheFluidCarries) {
  // The drag takes its share h R/m of the load in each step, docs/physics.md (6.4).
  const double h = 0.01, mass = 20, drag = 100;
  auto system = sphere_on_floor(mass, h);
  system.setting.fluid->coupling = Coupling::kSplitting;
  system.setting.forces[0] = constant({-7, 0, 0});
  auto simulation = system.simulation(constant_drag(drag));
  run(simulation, 1);
  const double share = 1 / (1 + h * drag / mass);
  EXPECT_NEAR(wall_of(simulation, -2, 0).gamma / -7, share, 0.03 * (1 - share) + 0.001);
}

/// Pushed for a time 1 with 7, then pulled with 14: released at 1.5.
TEST(ContactInFluid, GivesTheFilmBackAndLetsGoWithoutMass) {
  for (const double h : {0.5, 0.13, 0.01}) {
    SCOPED_TRACE(h);
    auto system = sphere_on_floor(0, h);
    system.setting.forces[0] = {{{1, {-7, 0, 0}}, {1e9, {14, 0, 0}}}};
    auto simulation = system.simulation(constant_drag(100));
    run(simulation, 3);
    EXPECT_EQ(wall_of(simulation, -2, 0).gamma, 0);
    // What is left of the pull moves the sphere, whatever the step in which it is released.
    EXPECT_NEAR(simulation.state().particles.positions[0], 1.1 + 1.5 * 14 / 100, 1e-12);
  }
}

TEST(ContactInFluid, GivesTheFilmBackAndLetsGoWithMass) {
  // From t = 1.5 on, m u' = 14 - R u. The error is of first order in the step of the release.
  const double mass = 5, drag = 4, end = 3;
  const double u = 14 / drag * (1 - std::exp(-drag / mass * 1.5));
  const double z = 1.1 + 14 / drag * 1.5 - mass / drag * u;
  const auto error = [&](double h) {
    auto system = sphere_on_floor(mass, h);
    system.setting.forces[0] = {{{1, {-7, 0, 0}}, {1e9, {14, 0, 0}}}};
    auto simulation = system.simulation(constant_drag(drag));
    run(simulation, end);
    return std::abs(simulation.state().particles.positions[0] - z);
  };
  EXPECT_LT(error(0.01), 0.02);
  EXPECT_LT(error(0.001), 0.002);
}

TEST(ContactInFluid, OfASphereThatFallsHasTheImpulseOfTheFilmBelowTheThreshold) {
  // R = k/q: k ln(D_c/q0) is what the fluid carries above the threshold gap, gamma the rest of the
  // load and of the momentum, docs/physics.md (4.2).
  const double k = 30, q0 = 1, threshold = 0.1, f = -100, end = 2;
  const Resistance drag = [k](const Particles& p) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Constant(1, 1, k / (p.positions[0] - 1));
  };
  for (const double mass : {0.0, 20.0}) {
    SCOPED_TRACE(mass);
    const auto error = [&](double h) {
      auto system = in_fluid(1, 10, h, threshold);
      add_pushed(system, {1 + q0, 0, 0}, 1, mass, {f, 0, 0});
      auto simulation = system.simulation(drag);
      run(simulation, end);
      const double exact = f * end - k * std::log(threshold / q0);
      return std::abs(wall_of(simulation, -2, 0).gamma / exact - 1);
    };
    EXPECT_LT(error(0.01), 0.02);
    EXPECT_LT(error(0.001), 0.002);
  }
}

TEST(ContactInFluid, StopsAtSolidContact) {
  auto system = sphere_on_floor(0, 0.1);
  system.setting.laws.film.gamma_min = -2;
  system.setting.forces[0] = {{{1, {-7, 0, 0}}, {1e9, {7, 0, 0}}}};
  auto simulation = system.simulation(constant_drag(100));
  run(simulation, 1);
  EXPECT_EQ(wall_of(simulation, -2, 0).gamma, -2);
  EXPECT_EQ(wall_of(simulation, -2, 0).gamma_error, 0);
  // The film gives back 2, and then the sphere leaves.
  run(simulation, 1 + 2.0 / 7 + 1);
  EXPECT_EQ(wall_of(simulation, -2, 0).gamma, 0);
  EXPECT_NEAR(simulation.state().particles.positions[0], 1.1 + 7.0 / 100, 1e-12);
}

/// Files list a contact without a film, whose gamma is 0, as long as it holds.
TEST(ContactInFluid, OfSolidsAtTheThresholdGapIsListed) {
  auto system = sphere_on_floor(0, 0.1);
  system.setting.laws.film.gamma_min = 0;
  system.setting.forces[0] = {{{1, {-7, 0, 0}}, {1e9, {7, 0, 0}}}};
  auto simulation = system.simulation(constant_drag(100));
  run(simulation, 1);
  const auto contacts = contacts_of(simulation.setting(), simulation.state());
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].gamma, 0);
  EXPECT_NEAR(contacts[0].gap, 0.1, 1e-12);
  run(simulation, 2);
  EXPECT_TRUE(contacts_of(simulation.setting(), simulation.state()).empty());
}

TEST(ContactInFluid, WithoutThresholdGapTouches) {
  auto system = sphere_on_floor(0, 0.1, 0);
  system.state.particles.positions[0] = 1.02;
  system.setting.forces[0] = constant({-7, 0, 0});
  auto simulation = system.simulation(constant_drag(100));
  const auto report = run(simulation, 2);
  EXPECT_TRUE(report.converged);
  EXPECT_NEAR(simulation.state().particles.positions[0], 1, 1e-12);
  EXPECT_NEAR(wall_of(simulation, -2, 0).gamma, -7 * 2 + 100 * 0.02, 1e-11);
}

TEST(ContactInFluid, ThatIsClosedByLessThanTheToleranceIsNotPushedOpen) {
  auto system = sphere_on_floor(0, 1e-6);
  system.state.particles.positions[0] -= 4e-7;  // the tolerance is 1e-6, of which half is allowed
  system.setting.forces[0] = constant({-1, 0, 0});
  auto simulation = system.simulation(constant_drag(100));
  simulation.step(1e9);
  EXPECT_NEAR(simulation.state().particles.velocities[0], 0, 1e-14);
  EXPECT_NEAR(wall_of(simulation, -2, 0).gamma, -1e-6, 1e-18);
}

TEST(ContactInFluid, LeavesTheSideOfACylinderAlone) {
  // The side is closer than the threshold gap, and no particle on the axis can leave it.
  auto system = in_fluid(1, 10, 0.1, 0.1);
  system.setting.domain = CylinderDomain{1.05, 10};
  add_pushed(system, {5, 0, 0}, 1, 0, {-10, 0, 0});
  auto simulation = system.simulation(constant_drag(100));
  const auto report = simulation.step(1e9);
  EXPECT_TRUE(contacts_of(simulation.setting(), simulation.state()).empty());
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.contacts, 0);
  EXPECT_NEAR(simulation.state().particles.positions[0], 4.99, 1e-14);
}

TEST(ContactInFluid, OfADrivenAndAFreeParticlePushesTheFreeOne) {
  auto system = in_fluid(2, 20, 0.1, 0.05);
  add_particle(system.state, {5, 10, 0}, 1, 0);
  add_particle(system.state, {7.1, 10, 0}, 1, 0);
  system.setting.given_motions[0].velocity = constant({1, 0, 0});
  auto simulation = system.simulation(constant_drag(10));
  run(simulation, 1);
  const auto& state = simulation.state();
  EXPECT_NEAR(state.particles.positions[0], 6, 1e-13);
  EXPECT_NEAR(state.particles.positions[2], 6 + 2.05, 1e-12);
  // The pair opens by 0.05 before it touches: 0.95 of way with the drag 10.
  EXPECT_NEAR(pair_of(state, 0, 1).gamma, -9.5, 1e-10);
}

TEST(ContactInFluid, OfTwoDrivenParticlesOrOfOneAndAWallIsLeftOut) {
  auto system = in_fluid(2, 20, 0.1, 0.05);
  add_particle(system.state, {1.02, 10, 0}, 1, 0);
  add_particle(system.state, {3.03, 10, 0}, 1, 0);
  for (const std::int32_t k : {0, 1})
    system.setting.given_motions[k].velocity = constant({0, 1, 0});
  for (const auto coupling : {Coupling::kConstrained, Coupling::kSplitting}) {
    system.setting.fluid->coupling = coupling;
    auto simulation = system.simulation(constant_drag(10));
    const auto report = simulation.step(1e9);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.contacts, 0);
    EXPECT_NEAR(simulation.state().particles.positions[3], 10.1, 1e-13);
  }
}

TEST(ContactInFluid, AcrossAPeriod) {
  auto system = in_fluid(2, 10, 0.1, 0.05);
  system.setting.domain = BoxDomain{{0, 0}, {10, 10}, {true, true}};
  add_pushed(system, {1.1, 5, 0}, 1, 0, {-10, 0, 0});
  add_pushed(system, {8.9, 5, 0}, 1, 0, {10, 0, 0});
  auto simulation = system.simulation(constant_drag(10));
  run(simulation, 2);
  const auto& state = simulation.state();
  ASSERT_EQ(state.pairs.size(), 1);
  EXPECT_NE(state.pairs[0].image, 0);
  // The gap of 0.2 closes to 0.05 with the speed 2, and then each pushes with 10.
  EXPECT_NEAR(state.pairs[0].gamma, -10 * (2 - 0.075), 1e-10);
}

TEST(ContactInFluid, OnARoundWallDoesNotLetADiscThrough) {
  // A disc slides along the inside of a circle under its weight.
  auto system = in_fluid(2, 20, 0.05, 0.05);
  system.setting.domain = DiscDomain{{0, 0, 0}, 5};
  const double angle = -std::numbers::pi / 6, way = 5 - 1 - 0.05;
  add_pushed(system, {way * std::cos(angle), way * std::sin(angle), 0}, 1, 0, {0, -10, 0});
  auto simulation = system.simulation(constant_drag(10));
  while (simulation.state().time < 2) {
    simulation.step(2);
    const auto& p = simulation.state().particles;
    EXPECT_LE(norm(p.position(0)), way * (1 + 1e-9));
  }
  // Sliding: way d(angle)/dt = -cos(angle), an error of first order in the step.
  const auto& p = simulation.state().particles;
  const double gudermann = std::asinh(std::tan(angle)) - 2 / way;
  EXPECT_NEAR(std::atan2(p.positions[1], p.positions[0]), std::atan(std::sinh(gudermann)), 0.01);
  // gamma is the impulse of the weight along the normal, the integral of 10 sin(angle) dt.
  double load = 0;
  constexpr int kParts = 1000;
  for (int i = 0; i < kParts; ++i)
    load += 10 * std::tanh(std::asinh(std::tan(angle)) - (i + 0.5) * 2 / kParts / way) * 2 / kParts;
  EXPECT_NEAR(pair_of(simulation.state(), -1, 0).gamma, load, 0.02 * std::abs(load));
}

TEST(ContactInFluid, HeapOnAFloorCarriesItsWeight) {
  // Two discs on the floor between the walls, one on top: statically determinate.
  for (const double mass : {0.0, 1.0}) {
    auto system = in_fluid(2, 8, 0.1, 0);
    system.setting.domain = BoxDomain{{0, 0}, {4.4, 8}};
    add_pushed(system, {1, 1, 0}, 1, mass, {0, -1, 0});
    add_pushed(system, {3.4, 1, 0}, 1, mass, {0, -2, 0});
    add_pushed(system, {2.2, 1 + std::sqrt(4 - 1.44), 0}, 1, mass, {0, -3, 0});
    auto simulation = system.simulation(constant_drag(50));
    const auto report = run(simulation, 1);
    EXPECT_TRUE(report.converged);
    EXPECT_LT(report.residual, 1e-6);
    EXPECT_LT(report.impulse_residual, 1e-9);
    const double floor = wall_of(simulation, -3, 0).gamma + wall_of(simulation, -3, 1).gamma;
    EXPECT_NEAR(floor, -6, 1e-9);
    // The top disc presses both sides apart: 3/2 tan(alpha), sin(alpha) = 0.6.
    EXPECT_NEAR(wall_of(simulation, -1, 0).gamma, -1.5 * 0.75, 1e-9);
    EXPECT_NEAR(wall_of(simulation, -2, 1).gamma, -1.5 * 0.75, 1e-9);
  }
}

TEST(ContactInFluid, AStepThatFailsLeavesTheState) {
  auto system = in_fluid(2, 8, 0.1, 0.02);
  add_pushed(system, {1.03, 1.03, 0}, 1, 1, {-1, -1, 0});
  add_pushed(system, {3.1, 1.03, 0}, 1, 0, {-2, -1, 0});
  auto simulation = system.simulation(constant_drag(5));
  for (int step = 0; step < 5; ++step) simulation.step(1e9);
  const auto before = write_restart(simulation.state());
  const auto forces = simulation.fluid_forces();
  int failures = 0;
  for (int question = 0;; ++question) {
    system.fluid->placements = system.fluid->solutions = 0;
    system.fluid->fails_at = question;
    try {
      simulation.step(1e9);
      break;
    } catch (const Error&) {
      ++failures;
      ASSERT_EQ(write_restart(simulation.state()), before);
      ASSERT_EQ(simulation.fluid_forces(), forces);
    }
  }
  EXPECT_GE(failures, 4);  // place, without contact, contacts, with contact
}

TEST(ContactInFluid, HasNoImpactsOfAnEarlierRunWithoutAFluid) {
  auto system = in_fluid(2, 8, 0.1, 0.02);
  add_pushed(system, {1.03, 1.03, 0}, 1, 1, {-1, -1, 0});
  system.state.earlier_step = 0.1;
  system.state.impact_impulses = {{-1, {0, 1, 0}, {0, 1, 0}}};
  EXPECT_TRUE(system.simulation(constant_drag(5)).state().impact_impulses.empty());
}

TEST(ContactInFluid, GoesOnFromARestartWithTheSameBits) {
  const Resistance drag = [](const Particles& p) -> Eigen::MatrixXd {
    Eigen::VectorXd diagonal(static_cast<Eigen::Index>(3 * p.count()));
    for (Eigen::Index i = 0; i < diagonal.size(); ++i)
      diagonal[i] = 5 + 2 * std::sin(p.positions[static_cast<std::size_t>(i / 3 * 2)]);
    return diagonal.asDiagonal();
  };
  auto system = in_fluid(2, 10, 0.05, 0.02);
  add_pushed(system, {2, 1.5, 0}, 1, 1, {-1, -3, 0});
  add_pushed(system, {5, 3.0, 0}, 1, 0, {-4, -2, 0});
  add_pushed(system, {7.5, 5, 0}, 1, 0.3, {-2, -5, 0});
  auto whole = system.simulation(drag);
  for (int step = 0; step < 60; ++step) {
    auto continued = system;
    continued.state = whole.state();
    auto simulation = continued.simulation(drag);
    simulation.step(1e9);
    whole.step(1e9);
    ASSERT_EQ(write_restart(simulation.state()), write_restart(whole.state())) << step;
  }
  EXPECT_LT(pair_of(whole.state(), -3, 0).gamma, 0);
}

}  // namespace
}  // namespace viscontact::particles
