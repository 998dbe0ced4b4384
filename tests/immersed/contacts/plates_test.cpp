// Plates with round ends that meet walls, discs and each other in a fluid, docs/physics.md (6.4),
// whose flow a stand-in replaces by drag: levers, finite turns, films and rebounds.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "tests/immersed/contacts/shapes_in_fluid.hpp"
#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

constexpr double kHalf = 1, kEnd = 0.1;

void add_plate(InFluid& system, const Vector& at, double angle, double mass) {
  add_shape(system.state, Shape::plate(kHalf, kEnd), at, angle, mass);
}

double gap_of(const FluidSimulation& simulation, std::size_t i, std::size_t j) {
  const auto& p = simulation.state().particles;
  return gap(p.placed_shape(i), p.placed_shape(j));
}

/// The sum of gamma of both ends of a plate at the floor.
double gamma_of_ends(const State& state) {
  double sum = 0;
  for (const auto& pair : state.walls)
    if (pair.first == -3) sum += pair.gamma;
  return sum;
}

class Plates : public ::testing::TestWithParam<double> {};  // density of the fluid
INSTANTIATE_TEST_SUITE_P(Densities, Plates, ::testing::Values(0.0, 1e-12));

// A plate that falls on one end turns about it: the contact has the lever of the end. It may not
// sink below the threshold gap by more than the tolerance, however far it turns in a step.
TEST_P(Plates, FallOnOneEndAndTurnAboutIt) {
  for (const double h : {0.05, 0.01}) {
    auto system = with_shapes(h, GetParam());
    add_plate(system, {10, 0.8, 0}, 0.6, 1);
    system.setting.forces[0] = constant({0, -1, 0});
    auto simulation = system.simulation(constant_drag(0.5));
    const double allowed = system.setting.solver.tolerance * kHalf;
    EXPECT_GT(largest_turn_of_landing(simulation, 6, allowed), h / 10);
    // In the end it lies flat, and the films of both ends share the weight.
    EXPECT_NEAR(simulation.state().particles.angles[0], 0, 2e-6);
    EXPECT_NEAR(simulation.state().particles.angular_velocities[0], 0, 1e-6);
    EXPECT_NEAR(force_of_walls(simulation, h), 1, 1e-6);
  }
}

// Without mass the load at the contact is shared by the levers of force and contact: a plate with
// the drag c of each component, whose end is held at the floor, turns at w = -l cos(angle)/(c (1 +
// (l cos(angle))^2)) under a unit force on its middle.
TEST(PlateContact, TurnAboutAnEndAtTheRateOfTheLever) {
  auto system = with_shapes(1e-4);
  const double angle = 0.5, l = kHalf - kEnd;
  add_plate(system, {10, kGap + kEnd + l * std::sin(angle), 0}, angle, 0);
  system.setting.forces[0] = constant({0, -1, 0});
  auto simulation = system.simulation(constant_drag(2));
  EXPECT_TRUE(simulation.step(1).converged);
  const double lever = l * std::cos(angle);
  const auto& p = simulation.state().particles;
  // The end stays: v - w l cos(angle) = 0 for the end that is lower, at -l from the middle.
  EXPECT_NEAR(p.angular_velocities[0], -lever / (2 * (1 + lever * lever)), 1e-6);
  EXPECT_NEAR(p.velocities[1], lever * p.angular_velocities[0], 1e-9);
  // The film books the whole load of the contact.
  EXPECT_NEAR(gamma_of_ends(simulation.state()), -1e-4 * 1 / (1 + lever * lever), 1e-9);
}

// A plate that lies on the floor slides with Coulomb's friction at both ends. Friction acts below
// the centre, and therefore the end in front has the larger load.
TEST(PlateContact, SlidesOnBothEnds) {
  const double drag = 0.5, load = 4, pull = 2, mu_s = 0.3, h = 0.05;
  auto system = with_shapes(h);
  system.setting.laws.film.gamma_min = 0;
  system.setting.laws.friction = FrictionLaw{mu_s};
  add_plate(system, {10, kEnd + kGap, 0}, 0, 0);
  system.setting.forces[0] = constant({pull, -load, 0});
  auto simulation = system.simulation(constant_drag(drag));
  EXPECT_TRUE(run(simulation, 2 * h).converged);
  const auto& p = simulation.state().particles;
  // Impulses are exact to 1e-10 of the impulses at work.
  EXPECT_NEAR(p.positions[0], 10 + 2 * h * (pull - mu_s * load) / drag, 1e-9);
  EXPECT_NEAR(p.angles[0], 0, 1e-9);
  const auto contacts = contacts_of(simulation.setting(), simulation.state());
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_NEAR(contacts[0].normal_force + contacts[1].normal_force, load, 1e-9);
  EXPECT_NEAR(std::abs(contacts[0].normal_force - contacts[1].normal_force),
              mu_s * load * kEnd / (kHalf - kEnd), 1e-8);
  for (const auto& contact : contacts)
    EXPECT_NEAR(contact.tangential_force[0], -mu_s * contact.normal_force, 1e-9);
}

// With friction enough, the point of the lower end that touches the floor stays where it is while
// the plate falls over.
TEST(PlateContact, TurnsAboutAnEndThatSticks) {
  const double h = 1e-4, angle = 0.7;
  auto system = with_shapes(h);
  system.setting.laws.film.gamma_min = 0;
  system.setting.laws.friction = FrictionLaw{5};
  const double spine = kHalf - kEnd;
  add_plate(system, {10, kEnd + kGap + spine * std::sin(angle), 0}, angle, 0);
  system.setting.forces[0] = constant({0, -3, 0});
  auto simulation = system.simulation(constant_drag(0.5));
  EXPECT_TRUE(run(simulation, h).converged);
  const auto& p = simulation.state().particles;
  const double omega = p.angles[0] / h - angle / h;
  EXPECT_LT(omega, -1);
  // The lowest point is at -spine (cos, sin) - (0, kEnd) from the centre.
  const double below = -spine * std::sin(angle) - kEnd;
  EXPECT_NEAR((p.positions[0] - 10) / h - omega * below, 0, 1e-7);
}

// Two plates of the mirrored angle that are pushed against each other meet with their ends, keep
// their gap while they turn, and are the mirror image of each other.
TEST_P(Plates, MeetEachOtherWithTheirEnds) {
  auto system = with_shapes(0.02, GetParam());
  add_plate(system, {10, 9, 0}, 0.8, 1);
  add_plate(system, {10, 11, 0}, -0.8, 1);
  system.setting.forces[0] = constant({0, 1, 0});
  system.setting.forces[1] = constant({0, -1, 0});
  auto simulation = system.simulation(constant_drag(0.5));
  bool has_met = false;
  // Later their sides meet, which are no contact of ends.
  while (simulation.state().time < 1.5 - 0.01) {
    EXPECT_TRUE(simulation.step(10).converged);
    const double gap = gap_of(simulation, 0, 1);
    const double allowed = system.setting.solver.tolerance * kHalf;
    EXPECT_GT(gap, kGap - allowed) << simulation.state().time;
    has_met = has_met || gap < kGap + allowed;
    const auto& p = simulation.state().particles;
    EXPECT_NEAR(p.angles[0], -p.angles[1], 1e-9);
    EXPECT_NEAR(p.positions[1] + p.positions[3], 20, 1e-9);
  }
  EXPECT_TRUE(has_met);
  EXPECT_NEAR(largest_overlap(system.setting, simulation.state()), 0, 1e-9);
  EXPECT_LT(pair_of(simulation.state(), 0, 1).gamma, 0);
}

// Free plates and discs at a distance keep linear and angular momentum in a contact: each impulse
// acts on both at one point. Drag is nearly 0.
TEST(PlateContact, KeepTheAngularMomentumOfAPair) {
  auto system = with_shapes(0.01);
  add_plate(system, {10, 10, 0}, 0.3, 1);
  add_plate(system, {10.6, 10.8, 0}, -0.9, 2);
  auto& p = system.state.particles;
  p.velocities = {0, 1, 0, -1};
  const double before = angular_momentum_with_spin(p);
  system.setting.laws.film.gamma_min = 0;
  auto simulation = system.simulation(constant_drag(1e-9));
  bool has_met = false;
  for (int n = 0; n < 60; ++n) {
    EXPECT_TRUE(simulation.step(10).converged);
    has_met = has_met || pair_of(simulation.state(), 0, 1).impulse > 0;
  }
  EXPECT_TRUE(has_met);
  // The contact acts at the places of the beginning of the step, which moves the centres apart from
  // the line of the impulse by the way of a step.
  EXPECT_NEAR(angular_momentum_with_spin(simulation.state().particles), before, 0.02);
  EXPECT_GT(std::abs(simulation.state().particles.angular_velocities[0]), 0.1);
}

// The ends are as wide as a disc of their radius: a plate on end is a disc for the film's law.
TEST(PlateContact, HaveTheFilmsOfTheirRoundEnds) {
  auto system = with_shapes(0.01);
  add_plate(system, {10, kGap + kHalf, 0}, std::numbers::pi / 2, 1);
  system.setting.forces[0] = constant({0, -1, 0});
  system.setting.laws.film.viscosity = 1;
  system.setting.laws.film.roughness = kGap / 10;
  auto simulation = system.simulation(constant_drag(1e-3));
  for (int n = 0; n < 30000 && simulation.state().time < 200; ++n) simulation.step(1e9);
  const double expected = impulse_of_film(FilmShape::kDiscs, 1, kEnd,
                                          std::numeric_limits<double>::infinity(), kGap, kGap / 5);
  EXPECT_NEAR(gamma_of_ends(simulation.state()), expected, 1e-9 * std::abs(expected));
}

// Plain contact with restitution: a plate that falls on its end without turning rebounds with e_d.
TEST_P(Plates, ReboundFromTheFloor) {
  auto system = with_shapes(0.01, GetParam());
  add_plate(system, {10, kGap + kHalf + 0.101, 0}, std::numbers::pi / 2, 1);
  system.state.particles.velocities = {0, -1};
  system.setting.laws.film.gamma_min = 0;
  system.setting.laws.restitution.coefficient = 0.6;
  auto simulation = system.simulation(constant_drag(1e-6));
  run(simulation, 0.3);
  EXPECT_NEAR(simulation.state().particles.velocities[1], 0.6, 1e-3);
}

// On a hinge the impact turns a plate back with e_d of its rate; the hinge takes the rest. A stop
// gives nothing back.
TEST_P(Plates, ReboundOnAHingeAndRestOnAStop) {
  const auto after = [&](double lowest_angle) {
    const double h = 0.005, angle = 0.4, l = kHalf - kEnd;
    auto system = with_shapes(h, GetParam());
    // The other end meets the floor at the angle 0.
    const Vector at = {10, kGap + kEnd, 0};
    add_plate(system, at + l * Vector{std::cos(angle), std::sin(angle), 0}, angle, 1);
    Hinge hinge;
    hinge.at = at + Vector{0, 1, 0};
    hinge.lowest_angle = lowest_angle;
    auto& p = system.state.particles;
    // The hinge is above the wall, so that only one end can meet it.
    p.positions[1] += 1;
    p.angles[0] = -std::asin(1 / (2 * l)) + angle;
    const Vector middle = hinge.at + l * Vector{std::cos(p.angles[0]), std::sin(p.angles[0]), 0};
    p.positions = {middle[0], middle[1]};
    hinge.point = {0, {-l, 0, 0}};
    system.setting.links.hinges = {hinge};
    const double rate = -1;
    p.angular_velocities = {rate};
    p.velocities = {-rate * (middle[1] - hinge.at[1]), rate * (middle[0] - hinge.at[0])};
    system.setting.laws.film.gamma_min = 0;
    system.setting.laws.restitution.coefficient = 0.5;
    auto simulation = system.simulation(constant_drag(1e-6));
    run(simulation, 0.6);
    const auto& now = simulation.state().particles;
    EXPECT_LT(norm(now.position(0) -
                   l * Vector{std::cos(now.angles[0]), std::sin(now.angles[0]), 0} - hinge.at),
              1e-4);
    return now.angular_velocities[0];
  };
  EXPECT_NEAR(after(-10), 0.5, 5e-3);
  const double l = kHalf - kEnd;
  EXPECT_NEAR(after(-std::asin(1 / (2 * l)) + 0.1), 0, 1e-6);
}

// A hinge holds the end of a plate where a fixed disc touches it: no force of this contact moves
// the plate, which turns about the hinge as if the disc were not there.
TEST_P(Plates, OnAHingeAtTheirContactTurnAsWithoutIt) {
  const auto angle_with = [&](bool has_disc) {
    auto system = with_shapes(0.01, GetParam());
    const double l = kHalf - kEnd;
    add_plate(system, {10 + l, 10, 0}, 0, 1);
    if (has_disc) {
      add_disc(system, {10, 10 - kEnd - 0.1 - kGap, 0}, 1, {});
      add_missing_shapes(system.state.particles);
      system.setting.given_motions[1] = {};
    }
    Hinge hinge;
    hinge.at = {10, 10, 0};
    hinge.point = {0, {-l, 0, 0}};
    system.setting.links.hinges = {hinge};
    system.setting.torques[0] = constant({0, 0, 1});
    system.setting.laws.film.gamma_min = 0;
    auto simulation = system.simulation(constant_drag(0.5));
    EXPECT_TRUE(run(simulation, 0.5).converged);
    return simulation.state().particles.angles[0];
  };
  EXPECT_GT(angle_with(false), 0.05);
  EXPECT_NEAR(angle_with(true), angle_with(false), 1e-9);
}

// A disc of the mass 0.5 and the velocity 1 meets a plate that rests on its stop, 0.7 from the
// hinge: the stop takes the moment (1 + e_d) 0.5 0.7 of the whole impact, and the plate stays.
TEST_P(Plates, OnAStopGiveItTheWholeImpact) {
  for (const double dry : {0.0, 0.5, 1.0}) {
    auto system = with_shapes(0.01, GetParam());
    const double l = kHalf - kEnd, angle = std::numbers::pi / 2;
    add_plate(system, {10, 10 + l, 0}, angle, 1);
    add_disc(system, {10 - kEnd - 0.1 - kGap - 0.055, 10.7, 0}, 0.5, {1, 0, 0});
    add_missing_shapes(system.state.particles);
    Hinge hinge;
    hinge.at = {10, 10, 0};
    hinge.point = {0, {-l, 0, 0}};
    hinge.lowest_angle = angle;
    system.setting.links.hinges = {hinge};
    system.setting.laws.film.gamma_min = 0;
    system.setting.laws.restitution.coefficient = dry;
    auto simulation = system.simulation(constant_drag(1e-9));
    double moment = 0;
    while (simulation.state().time < 0.195) {
      simulation.step(1e9);
      moment += 0.01 * simulation.state().link_forces[2];
    }
    EXPECT_NEAR(moment, (1 + dry) * 0.5 * 0.7, 1e-6) << dry;
    EXPECT_NEAR(simulation.state().particles.angles[0], angle, 1e-6);
  }
}

// Plates that are pressed on each other come to lie flat, with both of their ends at the threshold
// gap.
TEST_P(Plates, ThatLieOnEachOtherKeepBothEndsApart) {
  for (const double tilt : {0.0, 0.01, 0.3}) {
    auto system = with_shapes(0.01, GetParam());
    add_plate(system, {10, 10, 0}, 0, 1);
    add_plate(system, {10.1, 10 + kGap + 2 * kEnd + 0.02 + std::sin(tilt), 0}, tilt, 1);
    system.setting.forces[0] = constant({0, 20, 0});
    system.setting.forces[1] = constant({0, -20, 0});
    system.setting.laws.film.gamma_min = 0;
    auto simulation = system.simulation(constant_drag(0.1));
    for (int n = 0; n < 300; ++n) {
      EXPECT_TRUE(simulation.step(1e9).converged) << tilt << " at " << simulation.state().time;
      EXPECT_GE(gap_of(simulation, 0, 1), kGap - 1e-5) << tilt;
    }
    const auto& p = simulation.state().particles;
    // Both ends are at the threshold gap to the tolerance.
    EXPECT_NEAR(std::remainder(p.angles[0] - p.angles[1], std::numbers::pi), 0, 1e-5) << tilt;
  }
}

// The load of a plate that lies on a fixed one is shared by its contacts as by the supports of a
// beam: the ends of the spines are at x = 9.1, 10.9 and 9.6, 11.4, so that the contacts are at 9.6
// and 10.9.
TEST_P(Plates, ShareALoadAsABeam) {
  auto system = with_shapes(0.01, GetParam());
  add_plate(system, {10, 10, 0}, 0, 1);
  add_plate(system, {10.5, 10 + kGap + 2 * kEnd + 0.01, 0}, 0, 1);
  system.setting.given_motions[0] = {};
  system.setting.forces[1] = constant({0, -20, 0});
  system.setting.laws.film.gamma_min = 0;
  auto simulation = system.simulation(constant_drag(0.1));
  EXPECT_TRUE(run(simulation, 0.5).converged);
  auto contacts = contacts_of(system.setting, simulation.state());
  ASSERT_EQ(contacts.size(), 2U);
  std::ranges::sort(contacts, {}, &CurrentContact::normal_force);
  EXPECT_NEAR(contacts[0].normal_force, 20 * (10.9 - 10.5) / (10.9 - 9.6), 1e-6);
  EXPECT_NEAR(contacts[1].normal_force, 20 * (10.5 - 9.6) / (10.9 - 9.6), 1e-6);
  EXPECT_NEAR(simulation.state().particles.angles[1], 0, 1e-9);
}

// Each end of a plate that lies on another one has a film, which books the load of this end.
// Without its load the plate, pulled in its middle, comes off without turning, as the mirror image
// of itself.
TEST_P(Plates, ThatLieOnEachOtherHaveAFilmAtEachEnd) {
  auto system = with_shapes(0.01, GetParam());
  add_plate(system, {10, 10, 0}, 0, 1);
  add_plate(system, {10.5, 10 + kGap + 2 * kEnd + 0.01, 0}, 0, 1);
  system.setting.given_motions[0] = {};
  system.setting.forces[1] = constant({0, -20, 0});
  auto simulation = system.simulation(constant_drag(0.1));
  std::map<std::int32_t, double> booked;
  for (int n = 0; n < 50; ++n) {
    EXPECT_TRUE(simulation.step(1e9).converged);
    for (const auto& pair : simulation.state().pairs) booked[pair.place] -= pair.impulse;
  }
  ASSERT_EQ(booked.size(), 2U);  // the end at x = 10.9 of the lower, and at 9.6 of the upper plate
  for (const auto& pair : simulation.state().pairs)
    EXPECT_NEAR(pair.gamma, booked[pair.place], 1e-9 * std::abs(pair.gamma)) << pair.place;
  EXPECT_NEAR(booked[0] / booked[3], (10.5 - 9.6) / (10.9 - 10.5), 1e-6);
}

TEST_P(Plates, ThatAreSymmetricComeOffWithoutTurning) {
  auto system = with_shapes(0.01, GetParam());
  add_plate(system, {10, 10, 0}, 0, 1);
  add_plate(system, {10, 10 + kGap + 2 * kEnd + 0.01, 0}, 0, 1);
  system.setting.given_motions[0] = {};
  system.setting.forces[1] = {{{0.2, {0, -20, 0}}, {1e300, {0, 20, 0}}}};
  auto simulation = system.simulation(constant_drag(0.1));
  EXPECT_TRUE(run(simulation, 1).converged);
  EXPECT_NEAR(simulation.state().particles.angular_velocities[1], 0, 1e-9);
  EXPECT_GT(simulation.state().particles.velocities[3], 0);
  for (const auto& pair : simulation.state().pairs) EXPECT_EQ(pair.gamma, 0);
}

}  // namespace
}  // namespace viscontact::particles
