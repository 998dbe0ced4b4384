// Coulomb's friction of contacts in a fluid with a given resistance: closed forms of one disc at a
// wall, films that give way, walls that move, and the law and the invariances of many discs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

/// Impulses are exact to 1e-10 of the impulses at work (SolverSettings::impulse_tolerance), and so
/// are slips and what follows from both; all numbers are of the order of 1 to 10.
constexpr double kExact = 1e-9;

constexpr double kDrag = 5, kTurning = 2, kRadius = 0.5, kThreshold = 0.05;

/// Drag of the centre and of the turning of each disc.
Eigen::MatrixXd drag_of_discs(const Particles& p) {
  const auto size = static_cast<Eigen::Index>(3 * p.count());
  Eigen::VectorXd diagonal(size);
  for (Eigen::Index i = 0; i < size; ++i) diagonal[i] = i % 3 == 2 ? kTurning : kDrag;
  return diagonal.asDiagonal();
}

/// A disc at the threshold gap above the floor, pressed on it with `load` and pulled with `pull`.
InFluid disc_on_floor(double mu_s, double h, double load, double pull, double mass = 0) {
  auto system = in_fluid(2, 10, h, kThreshold);
  system.setting.laws.film.gamma_min = 0;
  system.setting.laws.friction = FrictionLaw{mu_s};
  add_pushed(system, {5, kRadius + kThreshold, 0}, kRadius, mass, {pull, -load, 0});
  return system;
}

TEST(FrictionInFluid, OfADiscThatSlidesIsCoulombs) {
  const double mu_s = 0.3, load = 7, pull = 20;
  for (const double h : {0.1, 0.013}) {
    auto system = disc_on_floor(mu_s, h, load, pull);
    auto simulation = system.simulation(drag_of_discs);
    const auto report = run(simulation, 0.5);
    EXPECT_TRUE(report.converged);
    const auto& p = simulation.state().particles;
    EXPECT_NEAR(p.positions[0], 5 + 0.5 * (pull - mu_s * load) / kDrag, kExact);
    EXPECT_NEAR(p.positions[1], kRadius + kThreshold, 1e-13);
    // Friction acts on the lowest point, and turns the disc clockwise.
    EXPECT_NEAR(p.angular_velocities[0], -mu_s * load * kRadius / kTurning, kExact);
    const auto contacts = contacts_of(simulation.setting(), simulation.state());
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_EQ(contacts[0].friction, ContactFriction::kSlides);
    EXPECT_NEAR(contacts[0].normal_force, load, kExact);
    EXPECT_NEAR(contacts[0].tangential_force[0], -mu_s * load, kExact);
  }
}

TEST(FrictionInFluid, OfADiscThatSticksLetsItRoll) {
  // pull - T = R u and T r = R_r u/r.
  const double pull = 4, u = pull / (kDrag + kTurning / (kRadius * kRadius));
  auto system = disc_on_floor(0.5, 0.1, 7, pull);
  auto simulation = system.simulation(drag_of_discs);
  EXPECT_TRUE(run(simulation, 1).converged);
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(p.positions[0], 5 + u, kExact);
  EXPECT_NEAR(p.angular_velocities[0], -u / kRadius, kExact);
  const auto contacts = contacts_of(simulation.setting(), simulation.state());
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].friction, ContactFriction::kSticks);
  EXPECT_NEAR(contacts[0].tangential_force[0], -(pull - kDrag * u), kExact);
}

/// The limit between both is mu_s load = T of the disc that rolls.
TEST(FrictionInFluid, SticksUpToTheBoundOfItsLoad) {
  const double load = 7, pull = 4, u = pull / (kDrag + kTurning / (kRadius * kRadius));
  const double limit = (pull - kDrag * u) / load;
  for (const double share : {0.999, 1.001}) {
    auto system = disc_on_floor(share * limit, 0.1, load, pull);
    auto simulation = system.simulation(drag_of_discs);
    run(simulation, 0.3);
    const auto contacts = contacts_of(simulation.setting(), simulation.state());
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_EQ(contacts[0].friction,
              share < 1 ? ContactFriction::kSlides : ContactFriction::kSticks);
  }
}

TEST(FrictionInFluid, BeginsWhereTheFilmHasGivenWay) {
  const double mu_s = 0.3, load = 7, pull = 20, gamma_min = -2, end = 1;
  for (const double h : {0.1, 0.017}) {
    auto system = disc_on_floor(mu_s, h, load, pull);
    system.setting.laws.film.gamma_min = gamma_min;
    auto simulation = system.simulation(drag_of_discs);
    EXPECT_TRUE(run(simulation, end).converged);
    // The film takes up 2 in the time 2/7, whatever the step; friction acts with the rest.
    const double impulse = mu_s * (load * end + gamma_min);
    EXPECT_NEAR(simulation.state().particles.positions[0], 5 + (pull * end - impulse) / kDrag,
                kExact);
    EXPECT_EQ(pair_of(simulation.state(), -3, 0).gamma, gamma_min);
    const auto contacts = contacts_of(simulation.setting(), simulation.state());
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_NEAR(contacts[0].tangential_force[0], -mu_s * load, kExact);
  }
}

TEST(FrictionInFluid, OfAFilmIsNone) {
  auto smooth = disc_on_floor(0.3, 0.1, 7, 20);
  smooth.setting.laws.film.gamma_min.reset();
  auto simulation = smooth.simulation(drag_of_discs);
  run(simulation, 1);
  EXPECT_NEAR(simulation.state().particles.positions[0], 5 + 20 / kDrag, 1e-12);
  EXPECT_EQ(simulation.state().particles.angular_velocities[0], 0);
}

/// With a mass: m u' = pull - mu_s load - R u.
TEST(FrictionInFluid, ActsOnMassesToo) {
  const double mu_s = 0.3, load = 7, pull = 20, mass = 4, end = 1;
  const double final_speed = (pull - mu_s * load) / kDrag;
  const double x = 5 + final_speed * (end - mass / kDrag * (1 - std::exp(-kDrag / mass * end)));
  const auto error = [&](double h) {
    auto system = disc_on_floor(mu_s, h, load, pull, mass);
    add_rotation(system.state.particles);
    auto simulation = system.simulation(drag_of_discs);
    run(simulation, end);
    return std::abs(simulation.state().particles.positions[0] - x);
  };
  // Particles in contact take implicit steps, which are of first order.
  EXPECT_NEAR(error(0.01) / error(0.001), 10, 0.5);
  EXPECT_LT(error(0.001), 1e-3);
}

TEST(FrictionInFluid, OfAWallThatMovesDragsADisc) {
  const double mu_s = 0.3, load = 7, wall = 3;
  for (const double period : {0.0, 1.0}) {
    auto system = disc_on_floor(mu_s, 0.1, load, 0);
    SideVelocities sides;
    sides[2].value = {wall, 0};  // the bottom
    sides[2].period = period;
    sides[2].amplitude = 0.5;
    system.setting.fluid->boundary = sides;
    auto simulation = system.simulation(drag_of_discs);
    EXPECT_TRUE(run(simulation, 0.1).converged);
    // It slides as long as u + r omega < wall, with friction mu_s load.
    const double u = mu_s * load / kDrag, omega = mu_s * load * kRadius / kTurning;
    ASSERT_LT(u + kRadius * omega, wall);
    EXPECT_NEAR(simulation.state().particles.positions[0], 5 + 0.1 * u, kExact);
    EXPECT_NEAR(simulation.state().particles.angular_velocities[0], omega, kExact);
    // More friction makes it stick to the wall.
    system.setting.laws.friction->coefficient = 100;
    auto sticking = system.simulation(drag_of_discs);
    run(sticking, 0.1);
    const auto& p = sticking.state().particles;
    const double speed =
        wall * (1 + (period > 0 ? 0.5 * std::sin(2 * std::numbers::pi * 0.05 / period) : 0));
    EXPECT_NEAR((p.positions[0] - 5) / 0.1 + kRadius * p.angular_velocities[0], speed, kExact);
  }
}

/// A disc at the right wall of a shear flow, whose walls have the velocity (s y, 0): along the wall
/// that is 0; one at the top has the velocity s y.
TEST(FrictionInFluid, OfWallsOfAShearFlowIsThatOfTheirVelocityAlongThem) {
  for (const bool is_top : {true, false}) {
    auto system = in_fluid(2, 10, 0.1, kThreshold);
    system.setting.laws.film.gamma_min = 0;
    system.setting.laws.friction = FrictionLaw{50};
    system.setting.fluid->boundary = LinearFlow{{0, 0.2, 0, 0}};
    const double at = 10 - kRadius - kThreshold;
    if (is_top)
      add_pushed(system, {5, at, 0}, kRadius, 0, {0, 7, 0});
    else
      add_pushed(system, {at, 5, 0}, kRadius, 0, {7, 0, 0});
    auto simulation = system.simulation(drag_of_discs);
    run(simulation, 0.1);
    const auto& p = simulation.state().particles;
    const double along = is_top ? (p.positions[0] - 5) / 0.1 : (p.positions[1] - 5) / 0.1;
    // The surface velocity at the highest point is u - r omega, at the rightmost one v + r omega.
    EXPECT_NEAR(along + (is_top ? -1 : 1) * kRadius * p.angular_velocities[0], is_top ? 2 : 0,
                kExact);
  }
}

TEST(FrictionInFluid, KeepsTheTorqueOfAPair) {
  // Two discs of unequal size, pressed on each other and sheared: forces of the contact have
  // neither a sum nor a torque.
  auto system = in_fluid(2, 10, 0.1, kThreshold);
  system.setting.laws.film.gamma_min = 0;
  system.setting.laws.friction = FrictionLaw{0.3};
  add_pushed(system, {5, 5, 0}, 0.5, 0, {9, 3, 0});
  const double apart = 0.5 + 0.8 + kThreshold;
  add_pushed(system, {5 + apart, 5, 0}, 0.8, 0, {-9, -2, 0});
  auto simulation = system.simulation(drag_of_discs);
  simulation.step(0.1);
  const auto& p = simulation.state().particles;
  // Drag is minus what acts on each disc.
  const double v0 = (p.positions[1] - 5) / 0.1 * kDrag - 3,
               v1 = (p.positions[3] - 5) / 0.1 * kDrag + 2;
  EXPECT_GT(std::abs(v0), 0.1);
  EXPECT_NEAR(v0 + v1, 0, kExact);
  EXPECT_NEAR(
      (p.angular_velocities[0] + p.angular_velocities[1]) * kTurning + (v1 - v0) / 2 * apart, 0,
      kExact);
}

/// Discs that are pushed into a corner, in a random order, mirrored or not.
struct Heap {
  double mu_s = 0.5, gamma_min = 0;
  bool is_mirrored = false, is_reversed = false;
  double unit_of_length = 1, unit_of_force = 1;
  double mass = 0;
  bool is_split = false, has_inertia = false;
};

InFluid heap(const Heap& of) {
  const double l = of.unit_of_length, f = of.unit_of_force, width = 5 * l;
  auto system = in_fluid(2, width, 0.1, kThreshold * l);
  system.setting.laws.film.gamma_min = of.gamma_min * f;
  system.setting.laws.friction = FrictionLaw{of.mu_s};
  Random random(3);
  std::vector<std::pair<Vector, double>> discs;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      discs.push_back({{0.6 + 1.15 * column + 0.02 * row, 0.6 + 1.12 * row + 0.01 * column, 0},
                       random.uniform(0.4, 0.5)});
  if (of.is_reversed) std::ranges::reverse(discs);
  for (auto [x, radius] : discs) {
    if (of.is_mirrored) x[0] = 5 - x[0];
    add_pushed(system, l * x, l * radius, 0, {(of.is_mirrored ? -1 : 1) * 2.0 * f, -5.0 * f, 0});
  }
  return system;
}

/// Drag in the units of a heap.
Resistance drag_in_units(const Heap& of) {
  return [of](const Particles& p) -> Eigen::MatrixXd {
    const double l = of.unit_of_length, f = of.unit_of_force;
    Eigen::MatrixXd drag = drag_of_discs(p);
    for (Eigen::Index i = 0; i < drag.rows(); ++i) drag(i, i) *= i % 3 == 2 ? f * l : f / l;
    return drag;
  };
}

/// Coulomb's law at every contact of every step, measured at the velocities of the step: by
/// positions before and after it.
void expect_coulomb(const Heap& of, int steps) {
  auto system = heap(of);
  const double l = of.unit_of_length, f = of.unit_of_force;
  auto simulation = system.simulation(drag_in_units(of));
  int sliding = 0, sticking = 0;
  for (int step = 0; step < steps; ++step) {
    const auto before = simulation.state();
    const auto report = simulation.step(1e9);
    EXPECT_TRUE(report.converged) << step;
    EXPECT_LE(report.residual, 1e-8);
    EXPECT_LE(largest_overlap(simulation.setting(), simulation.state()), 1e-9);
    const auto& after = simulation.state();
    const auto& p = before.particles;
    for (const auto& contact : contacts_of(simulation.setting(), after)) {
      const auto& lists = contact.first < 0 ? after.walls : after.pairs;
      const auto pair = std::ranges::find_if(lists, [&](const Pair& one) {
        return one.first == contact.first && one.second == contact.second;
      });
      ASSERT_NE(pair, lists.end());
      const auto& memory = after.memories.of(pair->memory);
      const double solid_load = memory[Remembered::kSolidLoad];
      const double friction = norm(memory.friction());
      EXPECT_LE(friction, of.mu_s * solid_load * (1 + 1e-12) + kExact * f);
      if (!(solid_load > 1e-6 * f)) continue;
      // The slip, with the normal at the beginning of the step.
      const auto moved = [&](std::int32_t k) {
        return after.particles.position(index_of(k)) - p.position(index_of(k));
      };
      const auto turn = [&](std::int32_t k) {
        return after.particles.angles[index_of(k)] - (p.angles.empty() ? 0 : p.angles[index_of(k)]);
      };
      const auto j = contact.second;
      Vector normal, slip = moved(j);
      const double r_j = p.radii[index_of(j)];
      double arm_j = r_j;
      if (contact.first >= 0) {
        const auto i = contact.first;
        const Vector apart = p.position(index_of(j)) - p.position(index_of(i));
        normal = (1 / norm(apart)) * apart;
        const double r_i = p.radii[index_of(i)];
        arm_j = norm(apart) * r_j / (r_i + r_j);
        const double arm_i = norm(apart) - arm_j;
        slip = slip - moved(i) - turn(i) * arm_i * Vector{-normal[1], normal[0], 0};
      } else {
        normal = contact.normal;
      }
      slip = slip - turn(j) * arm_j * Vector{-normal[1], normal[0], 0};
      slip = slip - dot(slip, normal) * normal;
      if (friction < of.mu_s * solid_load * (1 - 1e-9)) {
        ++sticking;
        EXPECT_LE(norm(slip), 1e-8 * l) << step;
      } else if (norm(slip) > 1e-8 * l) {
        ++sliding;
        EXPECT_NEAR(dot(memory.friction(), slip), -friction * norm(slip),
                    1e-8 * friction * norm(slip));
      }
      EXPECT_LE(dot(memory.friction(), slip), kExact * f * l);
    }
  }
  EXPECT_GE(sliding, 3);
  EXPECT_GE(sticking, 3);
}

TEST(FrictionInFluid, OfAHeapIsCoulombsInEveryContact) {
  for (const double mu_s : {0.2, 0.5, 1.0}) {
    SCOPED_TRACE(mu_s);
    expect_coulomb({.mu_s = mu_s}, 20);
    expect_coulomb({.mu_s = mu_s, .gamma_min = -0.4}, 20);
    expect_coulomb({.mu_s = mu_s, .mass = 0.5, .is_split = true}, 20);
    expect_coulomb({.mu_s = mu_s, .mass = 0.5, .has_inertia = true}, 20);
  }
}

TEST(FrictionInFluid, OfAHeapContinuesWithTheSameBits) {
  const Heap of{.gamma_min = -0.4, .mass = 0.5};
  const auto run_in_parts = [&](bool is_stopped) {
    auto system = heap(of);
    auto simulation = system.simulation(drag_of_discs);
    for (int step = 0; step < 4; ++step) simulation.step(1e9);
    if (!is_stopped) {
      for (int step = 0; step < 4; ++step) simulation.step(1e9);
      return simulation.state();
    }
    system.state = simulation.state();
    auto again = system.simulation(drag_of_discs);
    for (int step = 0; step < 4; ++step) again.step(1e9);
    return again.state();
  };
  const auto whole = run_in_parts(false), parts = run_in_parts(true);
  EXPECT_EQ(whole.particles.positions, parts.particles.positions);
  EXPECT_EQ(whole.particles.angles, parts.particles.angles);
  EXPECT_EQ(whole.walls, parts.walls);
}

/// Three discs of one body on the floor: four normal and tangential impulses more than the body has
/// motions.
TEST(FrictionInFluid, OfABodyWithMoreContactsThanMotionsIsThatOfItsLoad) {
  const double mu_s = 0.3, load = 6, pull = 9, h = 0.1;
  for (const bool sticks : {false, true}) {
    auto system = in_fluid(2, 10, h, kThreshold);
    system.setting.laws.film.gamma_min = 0;
    system.setting.laws.friction = FrictionLaw{sticks ? 2 : mu_s};
    for (int k = 0; k < 3; ++k)
      add_pushed(system, {3.0 + 1.2 * k, kRadius + kThreshold, 0}, kRadius, 0,
                 {pull / 3, -load / 3, 0});
    add_rotation(system.state.particles);
    add_rigid_body(system.state.particles, {{0, 1, 2}});
    auto simulation = system.simulation(drag_of_discs);
    EXPECT_TRUE(run(simulation, 2 * h).converged);
    const auto& p = simulation.state().particles;
    const double u = sticks ? 0 : (pull - mu_s * load) / (3 * kDrag);
    EXPECT_NEAR(p.positions[0], 3 + 2 * h * u, kExact);
    EXPECT_NEAR(p.positions[1], kRadius + kThreshold, kExact);
  }
}

/// A disc on the floor that turns about a hinge at the height of the floor's contact: the line of
/// friction passes through the hinge, so that friction has no lever and no work.
TEST(FrictionInFluid, ThatPassesThroughAHingeIsNone) {
  const double load = 7, pull = 4, lever = 3;
  for (const double h : {1e-3, 0.1}) {
    auto system = disc_on_floor(0.5, h, load, pull);
    Hinge hinge;
    hinge.at = {5 - lever, kThreshold, 0};
    hinge.point = {0, hinge.at - system.state.particles.position(0)};
    add_rotation(system.state.particles);
    system.setting.links.hinges = {hinge};
    auto simulation = system.simulation(drag_of_discs);
    const auto report = run(simulation, 3 * h);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.residual, 1e-8);
    EXPECT_NEAR(simulation.state().particles.positions[0], 5, kExact);
    const auto contacts = contacts_of(simulation.setting(), simulation.state());
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_NEAR(contacts[0].normal_force, load + pull * kRadius / lever, kExact);
    EXPECT_EQ(norm(contacts[0].tangential_force), 0);
  }
}

/// A body of two discs on a hinge that falls on the floor: in the step in which it meets the floor
/// it turns by another angle than without contact, and the hinge and the body hold all the same.
TEST(ConstrainedInFluid, BodiesAndHingesHoldWhereAContactStopsTheirTurn) {
  const double load = 30;
  auto system = in_fluid(2, 20, 0.1, kThreshold);
  system.setting.laws.film.gamma_min = 0;
  add_pushed(system, {4, 3, 0}, kRadius, 0, {0, -load, 0});
  add_pushed(system, {6, 3, 0}, kRadius, 0, {0, -load, 0});
  add_rotation(system.state.particles);
  add_rigid_body(system.state.particles, {{0, 1}});
  const auto hinge = hinge_of_body(system.state.particles, {3, 3, 0});
  system.setting.links.hinges = {hinge};
  auto simulation = system.simulation(drag_of_discs);
  int in_contact = 0;
  for (int n = 0; n < 20; ++n) {
    EXPECT_TRUE(simulation.step(1e9).converged);
    const auto& p = simulation.state().particles;
    for (const auto& contact : contacts_of(simulation.setting(), simulation.state()))
      in_contact += contact.normal_force > 0 ? 1 : 0;
    // The tolerance of lengths is 1e-6 mean radii, and links are held to a thousandth of it.
    EXPECT_NEAR(norm(p.position(0) - hinge.at), 1, 1e-9) << n;
    EXPECT_NEAR(norm(p.position(1) - hinge.at), 3, 1e-9) << n;
    EXPECT_NEAR(norm(p.position(1) - p.position(0)), 2, 1e-9) << n;
    EXPECT_GE(p.positions[3], kRadius + kThreshold - 1e-6) << n;
  }
  EXPECT_GE(in_contact, 3);
}

/// The walls of a strain flow move with (s x, -s y). A plate whose left end alone touches the floor
/// sticks to the point there, and not to the one below its centre.
TEST(FrictionInFluid, OfAPlateIsThatOfTheWallAtItsEnd) {
  const double strain = 0.4, h = 1e-4, half = 1, end = 0.1, angle = 0.5;
  auto system = in_fluid(2, 20, h, kThreshold);
  system.setting.laws.film.gamma_min = 0;
  system.setting.laws.friction = FrictionLaw{50};
  system.setting.fluid->boundary = LinearFlow{{strain, 0, 0, -strain}};
  const double spine = half - end;
  add_pushed(system, {10, end + kThreshold + spine * std::sin(angle), 0}, half, 0, {0, -3, 0});
  system.state.particles.shapes = {Shape::plate(half, end)};
  add_rotation(system.state.particles);
  system.state.particles.angles[0] = angle;
  auto simulation = system.simulation(drag_of_discs);
  EXPECT_TRUE(run(simulation, h).converged);
  const auto& p = simulation.state().particles;
  const double omega = (p.angles[0] - angle) / h;
  const double below = -spine * std::sin(angle) - end;
  // Positions over a step of 1e-4 have rounding errors of 1e-11.
  EXPECT_NEAR((p.positions[0] - 10) / h - omega * below, strain * (10 - spine * std::cos(angle)),
              1e-7);
}

std::vector<double> places_after(const Heap& of, int steps) {
  auto system = heap(of);
  auto simulation = system.simulation(drag_in_units(of));
  for (int step = 0; step < steps; ++step) simulation.step(1e9);
  std::vector<double> places;
  const auto& p = simulation.state().particles;
  for (std::size_t n = 0; n < p.count(); ++n) {
    const auto k = of.is_reversed ? p.count() - 1 - n : n;
    const double x = p.positions[2 * k] / of.unit_of_length;
    places.push_back(of.is_mirrored ? 5 - x : x);
    places.push_back(p.positions[2 * k + 1] / of.unit_of_length);
    places.push_back((of.is_mirrored ? -1 : 1) * p.angles[k]);
  }
  return places;
}

TEST(FrictionInFluid, OfAHeapIsTheSameMirroredInAnotherOrderAndInOtherUnits) {
  const auto expected = places_after({}, 8);
  for (const Heap& of : {Heap{.is_mirrored = true}, Heap{.is_reversed = true},
                         Heap{.unit_of_length = 3e-4, .unit_of_force = 2e5},
                         Heap{.unit_of_length = 7e5, .unit_of_force = 1e-7}}) {
    const auto places = places_after(of, 8);
    ASSERT_EQ(places.size(), expected.size());
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(places[i], expected[i], 1e-7) << i;
  }
}

TEST(FrictionInFluid, WithoutACoefficientIsNone) {
  const auto without = [] {
    auto system = heap({.mu_s = 0});
    system.setting.laws.friction.reset();
    auto simulation = system.simulation(drag_of_discs);
    for (int step = 0; step < 5; ++step) simulation.step(1e9);
    return simulation.state().particles.positions;
  }();
  auto system = heap({.mu_s = 0});
  auto simulation = system.simulation(drag_of_discs);
  for (int step = 0; step < 5; ++step) simulation.step(1e9);
  EXPECT_EQ(simulation.state().particles.positions, without);
}

}  // namespace
}  // namespace viscontact::particles
