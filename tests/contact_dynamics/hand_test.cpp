// Motions of one to three bodies that can be followed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

// Gaps are solved to 1e-14, impulses so to that over h/m, h >= 1e-3; the rest is rounding of
// numbers of about 1.
constexpr double kRounding = 2e-11;

Setting setting_of(double time_step, std::optional<double> gamma_min = {}) {
  Setting setting;
  setting.time_step = time_step;
  setting.laws.film.gamma_min = gamma_min;
  setting.solver.tolerance = 1e-14;
  return setting;
}

/// Masses 1 and 3 that meet at t = 1.25 with relative velocity 2: together they have (1 - 3)/4 =
/// -1/2, and their film takes 3/2.
State head_on(int dimension) {
  State state = no_particles(dimension);
  add_particle(state, {-2, 0, 0}, 1, 1, {1, 0, 0});
  add_particle(state, {2, 0, 0}, 0.5, 3, {-1, 0, 0});
  return state;
}

class ByHand : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, ByHand, ::testing::Values(2, 3));

TEST_P(ByHand, HeadOnTheyGoOnTogetherAndTheFilmRemembersTheImpulse) {
  for (const double h : {0.1, 0.07, 1e-3}) {
    Simulation simulation(setting_of(h), head_on(GetParam()), 1);
    run(simulation, 1.2, [&](const StepReport& report) {
      EXPECT_TRUE(report.converged);
      EXPECT_EQ(report.glued, 0U);
    });
    EXPECT_EQ(simulation.state().particles.velocity(0)[0], 1);
    run(simulation, 2);
    const auto& state = simulation.state();
    for (const std::size_t k : {0U, 1U})
      EXPECT_NEAR(state.particles.velocity(k)[0], -0.5, kRounding) << h;
    EXPECT_NEAR(pair_of(state, 0, 1).gamma, -1.5, kRounding) << h;
    EXPECT_NEAR(pair_gap(state, 0, 1), 0, kRounding) << h;
  }
}

TEST_P(ByHand, AGluedPairThatNothingPullsIsCountedAsGlued) {
  Simulation simulation(setting_of(0.25), head_on(GetParam()), 1);
  run(simulation, 2);
  for (int n = 0; n < 20; ++n) {
    const auto report = simulation.step(100);
    EXPECT_EQ(report.glued, 1U) << n;
    EXPECT_EQ(contacts_of(simulation.setting(), simulation.state()).size(), 1U) << n;
  }
}

/// Pulled apart by F from t = 2 on.
Setting pulled(double h, double pull, std::optional<double> gamma_min) {
  auto setting = setting_of(h, gamma_min);
  setting.forces[0] = {{{2, {}}, {100, {-pull, 0, 0}}}};
  setting.forces[1] = {{{2, {}}, {100, {pull, 0, 0}}}};
  return setting;
}

TEST_P(ByHand, PulledApartTheyLeaveWhenTheImpulseIsGivenBackWhateverTheStep) {
  // Pair -> release: 3/2 (all of the impact), what the solids left of it, or nothing: gamma_min = 0
  // is plain inelastic contact.
  for (const auto& [gamma_min, held] :
       std::vector<std::pair<std::optional<double>, double>>{{{}, 1.5}, {-0.4, 0.4}, {0.0, 0.0}})
    for (const double pull : {0.7, 3.1})
      for (const double h : {0.1, 0.037, 0.01, 1e-3}) {
        SCOPED_TRACE(::testing::Message() << "h = " << h << ", film " << held << ", F = " << pull);
        Simulation simulation(pulled(h, pull, gamma_min), head_on(GetParam()), 1);
        const double release = 2 + held / pull, end = release + 1.3;
        const double acceleration = pull * (1 + 1.0 / 3);
        run(simulation, end, [&, taken = -held](const StepReport& report) {
          const auto& state = simulation.state();
          const double gamma = pair_of(state, 0, 1).gamma;
          if (report.time > 1.25 + 2 * h && report.time < 2) {
            EXPECT_NEAR(gamma, taken, kRounding) << report.time;
          }
          if (report.time > 2 && report.time < release - 1e-9) {
            EXPECT_NEAR(gamma, taken + pull * (report.time - 2), kRounding) << report.time;
            EXPECT_NEAR(pair_gap(state, 0, 1), 0, kRounding) << report.time;
          }
          if (report.time > release + 1e-9) {
            EXPECT_EQ(gamma, 0) << report.time;
            EXPECT_EQ(report.glued, 0U) << report.time;
          }
        });
        // The impulse within the step of release counts: velocities are exact from then on, so the
        // time of release is.
        const auto& p = simulation.state().particles;
        const double velocity = p.velocity(1)[0] - p.velocity(0)[0];
        EXPECT_NEAR(end - velocity / acceleration, release, kRounding / acceleration);
        // The scheme moves with the velocity of the step's end, h u/2 ahead, and by a h^2 theta (1
        // - theta)/2 for the share theta of the step after release; the last step of the run, cut
        // short, and the step at t = 2 are ahead by less.
        const double ahead = pair_gap(simulation.state(), 0, 1) -
                             acceleration * (end - release) * (end - release) / 2;
        EXPECT_NEAR(ahead, h * velocity / 2, 1.1 * acceleration * h * h);
      }
}

TEST_P(ByHand, ThreeInARowGoOnTogether) {
  // The first comes with momentum 1; 2/3 of it pass the first film, 1/3 the second.
  for (const std::optional<double> gamma_min : {std::optional<double>(), std::optional(0.0)}) {
    State state = no_particles(GetParam());
    add_particle(state, {-3.5, 0, 0}, 1, 1, {1, 0, 0});
    add_particle(state, {0, 0, 0}, 1, 1);
    add_particle(state, {2, 0, 0}, 1, 1);
    Simulation simulation(setting_of(0.04, gamma_min), state, 1);
    run(simulation, 1.48);
    EXPECT_EQ(simulation.state().particles.velocity(1)[0], 0);
    run(simulation, 3);
    // Gauss-Seidel to 1e-12 of a displacement h u.
    for (const std::size_t k : {0U, 1U, 2U})
      EXPECT_NEAR(simulation.state().particles.velocity(k)[0], 1.0 / 3, 1e-9);
    EXPECT_NEAR(pair_of(simulation.state(), 0, 1).gamma, gamma_min ? 0 : -2.0 / 3, 1e-9);
    EXPECT_NEAR(pair_of(simulation.state(), 1, 2).gamma, gamma_min ? 0 : -1.0 / 3, 1e-9);
  }
}

TEST_P(ByHand, AMovingPlaneCarriesAParticleAndLetsItGoWhenItTurnsBack) {
  // A piston from the left meets the disc, mass 2, at t = 0.5 and carries it with 1, film -2. From
  // t = 1 on it goes back with -1: the film can stop the disc with its 2, no more.
  State state = no_particles(GetParam());
  add_particle(state, {0, 0, 0}, 0.5, 2);
  for (const double h : {0.1, 0.01, 0.0043}) {
    SCOPED_TRACE(h);
    auto setting = setting_of(h);
    auto piston = plane_at_rest({-1, 0, 0}, {1, 0, 0});
    // Sliding along itself is not felt.
    piston.velocity = {{{1, {1, 5, 0}}, {3, {-1, 1, 0}}}};
    setting.planes = {piston};
    Simulation simulation(setting, state, 1);
    const auto& p = simulation.state().particles;
    run(simulation, 0.95);
    EXPECT_NEAR(p.velocity(0)[0], 1, kRounding);
    EXPECT_EQ(p.velocity(0)[1], 0);
    EXPECT_NEAR(pair_of(simulation.state(), -1, 0).gamma, -2, kRounding);
    run(simulation, 2);
    EXPECT_NEAR(p.velocity(0)[0], 0, kRounding);
    EXPECT_EQ(pair_of(simulation.state(), -1, 0).gamma, 0);
    // It has been carried for half of 1, and comes to rest within a step of t = 1.
    EXPECT_NEAR(p.position(0)[0], 0.5, h * (1 + kRounding));
  }
}

TEST_P(ByHand, APlaneThatSetsOffCarriesAParticleInTheFirstStepWhateverTheStep) {
  // The overlap at the end of a short step is smaller than the tolerance of gaps. It was tolerated
  // as one that had been there before, and the particle followed after five steps.
  for (const double h : {1e-2, 1e-5, 1e-7}) {
    auto setting = setting_of(h);
    setting.planes = {plane_at_rest({}, {1, 0, 0})};
    setting.planes[0].velocity = constant({0.1, 0, 0});
    State state = no_particles(GetParam());
    add_particle(state, {1, 0, 0}, 1, 1);
    Simulation simulation(setting, state, 1);
    run(simulation, 3 * h, [&](const StepReport&) {
      EXPECT_NEAR(simulation.state().particles.velocities[0], 0.1, 1e-7) << h;
    });
  }
}

TEST_P(ByHand, BetweenTwoClosingPlanesItIsCarriedAndThenTheStepIsReported) {
  State state = no_particles(GetParam());
  add_particle(state, {0, 0, 0}, 0.5, 2);
  auto setting = setting_of(0.01);
  setting.solver.max_iterations = 100;
  auto left = plane_at_rest({-1, 0, 0}, {1, 0, 0});
  left.velocity = {{{10, {1, 0, 0}}}};
  setting.planes = {left, plane_at_rest({1, 0, 0}, {-1, 0, 0})};
  Simulation simulation(setting, state, 1);
  run(simulation, 0.99, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
  EXPECT_NEAR(simulation.state().particles.velocity(0)[0], 1, kRounding);
  // From t = 1 on there is no room: neither hidden nor endless, and never not a number.
  run(simulation, 1.1, [&](const StepReport& report) {
    if (report.time > 1.005) {
      EXPECT_FALSE(report.converged) << report.time;
      EXPECT_GE(report.residual, (report.time - 1) / 2 / 0.5 * (1 - 1e-9)) << report.time;
      EXPECT_TRUE(std::isfinite(simulation.state().particles.velocity(0)[0]));
    }
  });
}

TEST_P(ByHand, ATurningPlaneLiftsWhatLiesOnIt) {
  // About the origin, by 0.5 a unit of time; the particle slides down without friction, so that it
  // is in contact all the time.
  State state = no_particles(GetParam());
  add_particle(state, {1, 0.5, 0}, 0.5, 1);
  auto setting = setting_of(0.01);
  setting.gravity = {0, -1, 0};
  auto plane = plane_at_rest({}, {0, 1, 0});
  plane.angular_velocity = {0, 0, 0.5};
  setting.planes = {plane};
  Simulation simulation(setting, state, 1);
  run(simulation, 1, [&](const StepReport& report) {
    const auto place = setting.planes[0].at(report.time);
    EXPECT_NEAR(place.normal[0], -std::sin(0.5 * report.time), kRounding);
    EXPECT_NEAR(gap(place, simulation.state().particles.position(0), 0.5), 0, kRounding);
    EXPECT_TRUE(report.converged);
  });
  EXPECT_GT(simulation.state().particles.position(0)[1], 0.5);
}

TEST_P(ByHand, AJumpOfTheForceWithinAStepCountsByItsShare) {
  State state = no_particles(GetParam());
  add_particle(state, {}, 1, 4);
  auto setting = setting_of(0.1);
  setting.forces[0] = {{{0.25, {8, 0, 0}}, {0.3333, {-2, 4, 0}}, {0.41, {0, 1, 0}}}};
  Simulation simulation(setting, state, 1);
  const auto& p = simulation.state().particles;
  run(simulation, 1, [&](const StepReport& report) {
    const auto impulse = setting.forces[0].integral(report.time);
    EXPECT_NEAR(p.velocity(0)[0], impulse[0] / 4, 1e-14) << report.time;
    EXPECT_NEAR(p.velocity(0)[1], impulse[1] / 4, 1e-14) << report.time;
  });
  EXPECT_NEAR(p.velocity(0)[0], (0.25 * 8 - 0.0833 * 2) / 4, 1e-14);
  EXPECT_NEAR(p.velocity(0)[1], (0.0833 * 4 + 0.0767) / 4, 1e-14);
}

/// Two of radius 1, mass 1, that turn about each other by 1 a unit of time, touching, with a film
/// of -1.
State turning_pair(int dimension) {
  State state = no_particles(dimension);
  add_particle(state, {-1, 0, 0}, 1, 1, {0, -1, 0});
  add_particle(state, {1, 0, 0}, 1, 1, {0, 1, 0});
  state.pairs = {{0, 1, -1, 0}};
  return state;
}

TEST_P(ByHand, ATurningPairIsHeldByItsFilmUntilItIsUsedUp) {
  // The film gives the centripetal m r omega^2 = 1 each: it is used up at t = 1, then they fly
  // straight on.
  for (const double h : {0.02, 0.01, 0.001}) {
    SCOPED_TRACE(h);
    Simulation simulation(setting_of(h), turning_pair(GetParam()), 1);
    const auto& state = simulation.state();
    double released = std::numeric_limits<double>::infinity(), drift = 0;
    run(simulation, 1.5, [&](const StepReport& report) {
      if (pair_of(state, 0, 1).gamma < 0)
        drift = std::max(drift, std::abs(pair_gap(state, 0, 1)));
      else
        released = std::min(released, report.time);
      // Impulses along the line of the centres: angular momentum stays to rounding.
      EXPECT_NEAR(angular_momentum(state.particles)[2], 2, kRounding);
    });
    // Of first order in h; seen is one step.
    EXPECT_NEAR(released, 1, 2 * h);
    // The linearised equality moves them along the tangent, h omega r each: h^2 further apart,
    // which the next step takes back.
    EXPECT_GT(drift, 0.9 * h * h);
    EXPECT_LT(drift, 1.1 * h * h);
    EXPECT_NEAR(kinetic_energy(state.particles), 1, h);
  }
}

TEST_P(ByHand, AForceBeyondWhatCanBeComputedWithIsAnError) {
  // Squares of lengths overflow from 1e154 on.
  for (const double force : {1e152, 1e160, 1e300, 1e308}) {
    auto setting = setting_of(0.1);
    setting.forces[0] = {{{100, {force, 0, 0}}}};
    Simulation simulation(setting, head_on(GetParam()), 1);
    EXPECT_THROW(run(simulation, 1), Error) << force;
  }
}

}  // namespace
}  // namespace viscontact::particles
