// Steps: contacts, restart, and how little they depend on their length.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/suspensions/spheres.hpp"
#include "viscontact/arrangement/arrangement.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/suspensions/cell/sheared_cell.hpp"

namespace viscontact::particles {
namespace {

constexpr double kPeriod = 8.5;

Setting setting_of(const StepKind& kind) {
  auto setting = sheared_cube(kPeriod, 1, kind);
  setting.time_step = 0.02;
  return setting;
}

const std::vector<StepKind> kKinds{
    {PairTerms::kNearContact, 1e-3, 0, 0},   {PairTerms::kNearContact, 0, 0, 0},
    {PairTerms::kNearContact, 0, 1e-2, 0.3}, {PairTerms::kTables, 0, 1e-2, 0.3},
    {PairTerms::kTables, 0, 0, 0},           {PairTerms::kNone, 0, 0, 0},
    {PairTerms::kNone, 0, 0, 0.3},
};

State start() {
  Random random(31);
  return random_spheres(kPeriod, 1, two_sizes(26), 0.011, random);
}

// The least gap of all pairs and images, by trial of all [L].
double least_distance(const State& state, double offset) {
  const suspensions::ShearedCell cell{{}, {kPeriod, kPeriod, kPeriod}, offset};
  const auto& p = state.particles;
  double least = kPeriod;
  for (std::size_t i = 0; i < p.count(); ++i)
    for (std::size_t j = i + 1; j < p.count(); ++j)
      least = std::min(least,
                       norm(cell.nearest(p.position(j) - p.position(i))) - p.radii[i] - p.radii[j]);
  return least;
}

double least_gap(const SuspensionSimulation& simulation) {
  return simulation.rheology().smallest_gap;
}

TEST(SuspensionStep, LeavesNoOverlap) {
  for (const auto& kind : kKinds) {
    SCOPED_TRACE(&kind - kKinds.data());
    const auto setting = setting_of(kind);
    SuspensionSimulation simulation(setting, start(), 1);
    std::size_t touched = 0;
    for (int n = 0; n < 60; ++n) {
      const auto report = simulation.step(10);
      EXPECT_TRUE(report.converged);
      const auto& rheology = simulation.rheology();
      touched = std::max(touched, rheology.contacts);
      const double contact = kind.roughness * 1;  // the least mean radius is 1
      EXPECT_GT(least_gap(simulation), contact - 1e-7);
      EXPECT_GE(rheology.dissipation, 0);
    }
    const bool has_contacts =
        kind.regularisation > 0 || kind.roughness > 0 || kind.pairs == PairTerms::kNone;
    EXPECT_EQ(touched > 0, has_contacts);
    EXPECT_NEAR(simulation.state().shear.strain, 1.2, 1e-12);
    EXPECT_NEAR(simulation.state().time, 1.2, 1e-12);
  }
}

// Spheres in a close-packed lattice, which cannot be sheared without growing, in a cell of
// `period`.
State close_packed(double& period) {
  const double lattice = 2.002 * std::sqrt(2);
  std::vector<Vector> places;
  for (int cell = 0; cell < 8; ++cell) {
    const Vector from{lattice * (cell % 2), lattice * (cell / 2 % 2), lattice * (cell / 4)};
    for (const Vector& x : {Vector{0, 0, 0}, Vector{0, 1, 1}, Vector{1, 0, 1}, Vector{1, 1, 0}})
      places.push_back(from + (lattice / 2) * x);
  }
  period = 2 * lattice;
  return spheres_at(places, std::vector<double>(places.size(), 1));
}

TEST(SuspensionStep, OfSpheresThatJamEndsTheRun) {
  for (const double friction : {0.0, 1.0}) {
    SCOPED_TRACE(friction);
    double period = 0;
    const State start = close_packed(period);
    auto setting = sheared_cube(period, 0);
    setting.lubrication->range = 0.2;
    setting.time_step = 0.02;
    if (friction > 0) setting.laws.friction = FrictionLaw{friction};
    SuspensionSimulation simulation(setting, start, 1);
    int steps = 0;
    const auto shear = [&] {
      for (; simulation.step(1).parts > 0; ++steps) EXPECT_GT(least_gap(simulation), -1e-7);
    };
    EXPECT_THROW(shear(), Error);
    // What was reached is kept.
    EXPECT_GT(simulation.state().time, 0);
    EXPECT_EQ(simulation.state().steps, static_cast<std::size_t>(steps));
    EXPECT_NEAR(simulation.state().shear.strain, simulation.state().time, 1e-12);
    EXPECT_GT(simulation.rheology().viscosity, 100);
  }
}

TEST(SuspensionStep, IsSolvedWhereLoadsOfFrictionGoInCircles) {
  // Half of the volume, with a coefficient with which such spheres jam at 0.56.
  const auto radii = two_sizes(60);
  double volume = 0;
  for (const double radius : radii) volume += 4 * M_PI / 3 * std::pow(radius, 3);
  const double period = std::cbrt(volume / 0.5);
  auto setting = sheared_cube(period, 0, {PairTerms::kNearContact, 1e-3, 1e-2, 1});
  setting.time_step = 0.01;
  State state = spheres_at(std::vector<Vector>(radii.size()), radii);
  state.particles.positions = arrange({radii, 0.01, 2}, setting.domain, {});
  SuspensionSimulation simulation(setting, std::move(state), 1);
  int most_solutions = 0;
  for (int n = 0; n < 55; ++n) {
    const auto report = simulation.step(10);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.residual, 3e-8);
    most_solutions = std::max(most_solutions, simulation.rheology().solutions);
  }
  // No step was halved.
  EXPECT_NEAR(simulation.state().time, 0.55, 1e-12);
  EXPECT_GT(simulation.rheology().viscosity, 50);
  EXPECT_GT(most_solutions, 100);
}

TEST(SuspensionStep, RepelsAndCountsPairsWithinTheRangeAlone) {
  // The steps list pairs up to 0.2 mean radii.
  for (const double gap : {0.04, 0.06}) {
    auto setting = sheared_cube(1, 0);
    setting.domain = {};
    auto& of = *setting.lubrication;
    of.range = 0.05;
    of.gradient = {};
    of.repulsion = Repulsion{1, 0.1};
    setting.time_step = 1e-3;
    SuspensionSimulation simulation(setting, spheres_at({{}, {2 + gap, 0, 0}}, {1, 1}), 1);
    const bool is_near = gap < of.range;
    EXPECT_EQ(simulation.solve_instant().pairs, is_near ? 1U : 0U);
    EXPECT_EQ(simulation.state().particles.velocity(1)[0] > 0, is_near);
    simulation.step(1);
    EXPECT_EQ(simulation.rheology().pairs, is_near ? 1U : 0U);
    EXPECT_EQ(simulation.state().particles.velocity(1)[0] > 0, is_near);
  }
}

TEST(SuspensionStep, KeepsTheRoughnessOfPairsThatComeFromFarAway) {
  // Two spheres start at a gap of 0.3 and are pushed to the roughness in one step.
  for (const auto pairs : {PairTerms::kTables, PairTerms::kNearContact}) {
    auto setting = sheared_cube(1, 0);
    setting.domain = {};
    auto& of = *setting.lubrication;
    of.pairs = pairs;
    of.regularisation = 0;
    of.roughness = 1e-2;
    of.gradient = {};
    setting.added_forces = {60, 0, 0, -60, 0, 0};
    setting.added_torques.assign(6, 0);
    setting.time_step = 1;
    SuspensionSimulation simulation(setting, spheres_at({{}, {2.3, 0, 0}}, {1, 1}), 1);
    EXPECT_TRUE(simulation.step(10).converged);
    EXPECT_NEAR(least_gap(simulation), 1e-2, 1e-7);
    EXPECT_EQ(simulation.rheology().contacts, 1U);
  }
}

TEST(SuspensionStep, ObeysCoulombsLawInManyContacts) {
  const double coefficient = 0.5;
  for (const auto& kind : {StepKind{PairTerms::kTables, 0, 1e-3, coefficient},
                           StepKind{PairTerms::kNearContact, 1e-3, 0, coefficient}}) {
    SCOPED_TRACE(kind.roughness);
    auto setting = setting_of(kind);
    SuspensionSimulation simulation(setting, start(), 1);
    std::size_t checked = 0;
    for (int n = 0; n < 60; ++n) {
      const auto report = simulation.step(10);
      EXPECT_TRUE(report.converged);
      EXPECT_LE(report.residual, 3e-8);
      double largest = 0;
      for (const auto& pair : simulation.state().pairs) largest = std::max(largest, pair.impulse);
      for (const auto& pair : simulation.state().pairs) {
        const double friction = norm(simulation.state().memories.of(pair.memory).friction());
        // What a slip of 3e-8 mean radii changes is the smaller part for all but the least loads.
        EXPECT_LE(friction, coefficient * (1.001 * pair.impulse + 1e-4 * largest));
        ++checked;
      }
    }
    EXPECT_GT(checked, 50U);
  }
}

TEST(SuspensionStep, LeavesNoOverlapHoweverLongItIs) {
  for (const double h : {0.1, 0.3, 0.6}) {
    auto setting = setting_of({PairTerms::kTables, 0, 1e-3, 0});
    setting.time_step = h;
    SuspensionSimulation simulation(setting, start(), 1);
    while (simulation.step(3).parts > 0) {
      EXPECT_GT(least_gap(simulation), 1e-3 - 1e-7);
      EXPECT_GT(least_distance(simulation.state(), simulation.state().shear.offset), -1e-7);
    }
    EXPECT_NEAR(simulation.state().time, 3, 1e-12);
  }
}

TEST(SuspensionStep, IsContinuedFromAStateBitForBit) {
  for (const auto& kind : kKinds) {
    SCOPED_TRACE(&kind - kKinds.data());
    expect_continued(setting_of(kind), start(), 8, 8);
  }
}

TEST(SuspensionStep, HasTheViscosityOfShorterSteps) {
  const auto mean_viscosity = [](double h) {
    auto setting = setting_of({PairTerms::kNearContact, 1e-3, 0, 0});
    setting.time_step = h;
    SuspensionSimulation simulation(setting, start(), 1);
    double sum = 0, time = 0;
    while (simulation.step(0.4).parts > 0) {
      sum += simulation.rheology().viscosity * (simulation.state().time - time);
      time = simulation.state().time;
    }
    return sum / time;
  };
  // Pairs that begin and end to touch or to see each other make errors of either sign.
  const double finest = mean_viscosity(0.001);
  EXPECT_NEAR(mean_viscosity(0.02), finest, 5e-3 * finest);
  EXPECT_NEAR(mean_viscosity(0.005), finest, 1.5e-3 * finest);
}

TEST(SuspensionStep, IsOfTheSecondOrder) {
  // Two spheres pass each other.
  const auto end_of = [](double h) {
    auto setting = sheared_cube(1, 0);
    setting.domain = {};
    setting.lubrication->pairs = PairTerms::kTables;
    setting.lubrication->regularisation = 0;
    setting.lubrication->range = 10;
    setting.time_step = h;
    SuspensionSimulation simulation(setting, spheres_at({{}, {-3, 0.8, 0.3}}, {1, 1}), 1);
    while (simulation.step(4).parts > 0) continue;
    const auto& p = simulation.state().particles;
    return p.position(1) - p.position(0);
  };
  // Each half of the step has a quarter of the error, and of what it changes: 4.003 here.
  const double changed = norm(end_of(0.005) - end_of(0.0025));
  EXPECT_NEAR(changed / norm(end_of(0.0025) - end_of(0.00125)), 4, 0.1);
}

TEST(SuspensionStep, KeepsTheGapOfAPairThatTurnsWithTheFlow) {
  for (const double regularisation : {0.0, 1e-3}) {
    auto setting = sheared_cube(1, 0);
    setting.domain = {};
    setting.lubrication->pairs = PairTerms::kTables;
    setting.lubrication->regularisation = regularisation;
    setting.lubrication->gradient = {Vector{0, -1, 0}, {1, 0, 0}, {0, 0, 0}};
    setting.time_step = 0.1;
    SuspensionSimulation simulation(setting, spheres_at({{}, {2.001, 0, 0}}, {1, 1}), 1);
    while (simulation.step(1).parts > 0) continue;
    // Rounding errors of places of order one, in ten steps.
    EXPECT_NEAR(simulation.rheology().smallest_gap, 1e-3, 1e-13);
  }
}

TEST(SuspensionStep, OfTwoPressedSpheresFollowsTheFilm) {
  // Without a flow two equal spheres that the force F presses have alpha dq/dt/q = -F to leading
  // order, beside the drag: q = q_0 exp(-F t/alpha), alpha = 6 pi mu (a/2)^2.
  const double force = 3, alpha = 6 * M_PI / 4, start_gap = 1e-3;
  auto setting = sheared_cube(1, 0);
  setting.domain = {};
  auto& of = *setting.lubrication;
  of.regularisation = 0;
  of.drag = 1e-8;
  of.gradient = {};
  setting.added_forces = {force, 0, 0, -force, 0, 0};
  setting.added_torques.assign(6, 0);
  setting.time_step = 0.5;
  SuspensionSimulation simulation(setting, spheres_at({{}, {2 + start_gap, 0, 0}}, {1, 1}), 1);
  for (int n = 0; n < 8; ++n) simulation.step(100);
  EXPECT_NEAR(least_gap(simulation), start_gap * std::exp(-force * 4 / alpha), 1e-6 * start_gap);
}

TEST(SuspensionStep, OfAContactThatSlidesHasCoulombsFriction) {
  // Two spheres are pressed together and pulled past each other across the contact.
  const double press = 5, pull = 3, coefficient = 0.2;
  auto setting = sheared_cube(1, 0);
  setting.domain = {};
  auto& of = *setting.lubrication;
  of.pairs = PairTerms::kNone;
  of.gradient = {};
  setting.laws.film.gamma_min = 0;
  setting.laws.friction = FrictionLaw{coefficient};
  setting.added_forces = {press, pull, 0, -press, -pull, 0};
  setting.added_torques.assign(6, 0);
  setting.time_step = 1e-4;
  SuspensionSimulation simulation(setting, spheres_at({{}, {2, 0, 0}}, {1, 1}), 1);
  EXPECT_TRUE(simulation.step(1).converged);
  const auto& p = simulation.state().particles;
  // Drag 6 pi mu a v balances the pull less the friction, and 8 pi mu a^3 w its torque.
  EXPECT_NEAR(p.velocity(0)[1], (pull - coefficient * press) / (6 * M_PI), 1e-4);
  EXPECT_NEAR(p.angular_velocities[2], -coefficient * press / (8 * M_PI), 1e-4);
  EXPECT_NEAR(p.angular_velocities[5], -coefficient * press / (8 * M_PI), 1e-4);
  ASSERT_EQ(simulation.state().pairs.size(), 1U);
  EXPECT_NEAR(simulation.state().pairs[0].impulse, press * 1e-4, 1e-7);
  // Files have the friction on the second sphere, which the first one pulls along.
  const auto& memory = simulation.state().memories.of(simulation.state().pairs[0].memory);
  EXPECT_NEAR(memory.friction()[1], coefficient * press * 1e-4, 1e-7);
}

TEST(SuspensionStep, OfAContactWhoseFilmBearsTheLoadHasNoFriction) {
  // The film of smooth spheres bears every load; that of rough ones the first gamma_min/h of it,
  // also in the step in which the contact is new.
  const double press = 5, pull = 3, coefficient = 0.2, h = 1e-4;
  for (const double borne : {std::numeric_limits<double>::infinity(), 8.0, 2.0, 0.0}) {
    for (const bool is_new : {true, false}) {
      auto setting = sheared_cube(1, 0);
      setting.domain = {};
      auto& of = *setting.lubrication;
      of.pairs = PairTerms::kNone;
      of.gradient = {};
      if (std::isfinite(borne)) setting.laws.film.gamma_min = -h * borne;
      setting.laws.friction = FrictionLaw{coefficient};
      setting.added_forces = {press, pull, 0, -press, -pull, 0};
      setting.added_torques.assign(6, 0);
      setting.time_step = h;
      SuspensionSimulation simulation(setting, spheres_at({{}, {2, 0, 0}}, {1, 1}), 1);
      EXPECT_TRUE(simulation.step(1).converged);
      if (!is_new) {
        EXPECT_TRUE(simulation.step(1).converged);
      }
      // After one step the film has taken up `press`, and in the second one can take the rest.
      const double left = is_new ? borne : std::max(borne - press, 0.0);
      const double friction = coefficient * std::max(press - left, 0.0);
      // The normal turns by about h times the velocity in a step.
      EXPECT_NEAR(simulation.state().particles.velocity(0)[1], (pull - friction) / (6 * M_PI),
                  3 * h);
    }
  }
}

TEST(SuspensionStep, OfAFilmOfViscousContactGivesBackWhatItTook) {
  // Pressed for as long as it is pulled: the spheres stay together, gamma returns to 0.
  auto setting = sheared_cube(1, 0);
  setting.domain = {};
  auto& of = *setting.lubrication;
  of.pairs = PairTerms::kNone;
  of.gradient = {};
  setting.added_forces = {2, 0, 0, -2, 0, 0};
  setting.added_torques.assign(6, 0);
  setting.time_step = 0.125;
  SuspensionSimulation simulation(setting, spheres_at({{}, {2, 0, 0}}, {1, 1}), 1);
  for (int n = 0; n < 8; ++n) simulation.step(100);
  ASSERT_EQ(simulation.state().pairs.size(), 1U);
  EXPECT_NEAR(simulation.state().pairs[0].gamma, -2, 1e-6);
  auto forces = simulation.added_forces();
  forces[0] = -2;
  forces[3] = 2;
  for (int n = 0; n < 7; ++n) simulation.step(100);
  EXPECT_LT(least_gap(simulation), 1e-7);
  for (int n = 0; n < 3; ++n) simulation.step(100);
  EXPECT_GT(least_gap(simulation), 1e-3);
}

}  // namespace
}  // namespace viscontact::particles
