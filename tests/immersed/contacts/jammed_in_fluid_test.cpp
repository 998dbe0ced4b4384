// Friction in a fluid where Coulomb's law has no solution, and contacts of bodies that turn: what a
// step leaves then, and which steps converge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

constexpr double kThreshold = 0.05;

/// A drag of 5 against motions and of 2 against turning, for each disc.
Eigen::MatrixXd drag_of_discs(const Particles& p) {
  const auto size = static_cast<Eigen::Index>(3 * p.count());
  Eigen::VectorXd diagonal(size);
  for (Eigen::Index i = 0; i < size; ++i) diagonal[i] = i % 3 == 2 ? 2 : 5;
  return diagonal.asDiagonal();
}

/// A disc of radius 1 in the corner of a floor, which moves towards the wall with the velocity
/// `belt`, and a wall. It is pressed on the floor with 5 and on the wall with 1.
InFluid disc_in_corner(double mu_s, double belt) {
  constexpr double kWidth = 8;
  auto system = in_fluid(2, kWidth, 0.1, kThreshold);
  system.setting.laws.film.gamma_min = 0;
  system.setting.laws.friction = FrictionLaw{mu_s};
  SideVelocities sides;
  sides[2].value = {belt, 0};  // the bottom
  system.setting.fluid->boundary = sides;
  add_pushed(system, {kWidth - 1 - kThreshold, 1 + kThreshold, 0}, 1, 0, {1, -5, 0});
  return system;
}

/// With mu_s >= 1 the friction of each wall presses the disc on the other one with more than it
/// takes from it. If it slides on both, N_wall = 1 + mu_s N_floor and N_floor = 5 + mu_s N_wall
/// have no solution > 0; nor has any other state of the contacts. The loads of the solution without
/// friction, 5 and 1, then bound the friction.
TEST(JammedInFluid, FrictionIsBoundedByTheLoadsOfASolutionWithoutFriction) {
  constexpr double kMu = 1.5;
  for (const double belt : {3.0, 1e-3}) {
    SCOPED_TRACE(belt);
    auto system = disc_in_corner(kMu, belt);
    auto simulation = system.simulation(drag_of_discs);
    for (int step = 0; step < 60; ++step) {
      const auto report = simulation.step(1e9);
      EXPECT_FALSE(report.converged) << step;
      EXPECT_TRUE(report.has_given_loads) << step;
      EXPECT_LE(report.largest_overlap, 1e-6) << step;
      const auto contacts = contacts_of(simulation.setting(), simulation.state());
      ASSERT_EQ(contacts.size(), 2U);
      for (const auto& contact : contacts) {
        const bool is_floor = contact.normal[1] > 0.5;
        EXPECT_NEAR(contact.gap, kThreshold, 1e-6) << step;
        EXPECT_LE(contact.normal_force, (is_floor ? 5 + kMu : 1 + 5 * kMu) + 1e-6) << step;
        if (belt > 1) {  // the disc slides on both
          EXPECT_NEAR(contact.normal_force, is_floor ? 5 + kMu : 1 + 5 * kMu, 1e-6) << step;
        }
      }
    }
  }
}

TEST(JammedInFluid, StepsHaveNoGivenLoadsWhereCoulombsLawHasASolution) {
  // The disc slides on both: N_floor (1 - mu_s^2) = 5 + mu_s.
  constexpr double kMu = 0.5;
  auto system = disc_in_corner(kMu, 3);
  auto simulation = system.simulation(drag_of_discs);
  for (int step = 0; step < 20; ++step) {
    const auto report = simulation.step(1e9);
    EXPECT_TRUE(report.converged) << step;
    EXPECT_FALSE(report.has_given_loads) << step;
    for (const auto& contact : contacts_of(simulation.setting(), simulation.state())) {
      const double on_floor = (5 + kMu) / (1 - kMu * kMu);
      EXPECT_NEAR(contact.normal_force, contact.normal[1] > 0.5 ? on_floor : 1 + kMu * on_floor,
                  1e-8);
    }
  }
}

/// Bodies of two discs that random forces press on the floor, and tip over. Contacts decide how far
/// a body turns in a step, and its finite turn changes the gaps for which the contacts were solved.
TEST(ContactInFluid, OfBodiesThatTurnConvergesInEachStep) {
  constexpr int kBodies = 12, kSteps = 30;
  constexpr double kDrag = 12;
  for (const double mu_s : {0.0, 0.5, 1.5}) {
    SCOPED_TRACE(mu_s);
    Random random(1);
    int touching = 0;
    for (int n = 0; n < kBodies; ++n) {
      auto system = in_fluid(2, 20, 0.05, kThreshold);
      system.setting.laws.film.gamma_min = 0;
      if (mu_s > 0) system.setting.laws.friction = FrictionLaw{mu_s};
      const auto add = [&](const Vector& at, double radius) {
        add_pushed(system, at, radius, 0, {random.uniform(-10, 10), -random.uniform(10, 30), 0});
      };
      add({9, 1.2, 0}, 1);
      add({11.2, 1.2 + random.uniform(0, 1.5), 0}, 0.9);
      add_rotation(system.state.particles);
      add_rigid_body(system.state.particles, {{0, 1}});
      auto simulation = system.simulation(constant_drag(kDrag));
      for (int step = 0; step < kSteps; ++step) {
        EXPECT_TRUE(simulation.step(1e9).converged) << n << " " << step;
        for (const auto& contact : contacts_of(simulation.setting(), simulation.state()))
          touching += contact.normal_force > 0 ? 1 : 0;
      }
    }
    EXPECT_GT(touching, kBodies * kSteps / 2);
  }
}

}  // namespace
}  // namespace viscontact::particles
