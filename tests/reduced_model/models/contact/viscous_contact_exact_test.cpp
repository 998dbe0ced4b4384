// Viscous contact from event to event, against motions known in closed form and against the scheme.
#include "viscontact/reduced_model/models/contact/viscous_contact_exact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/reduced_model/cases.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"

namespace viscontact::reduced_model {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

TEST(ViscousContactExact, SolvesTheLimitCase) {
  const auto trajectory = simulate_viscous_contact_exact(
      limit_motion(), lubrication::LubricationForce(leading_term_fit(0.1)));
  for (const auto& row : trajectory.rows) {
    const double t = row.time;
    if (std::abs(t - 1) < 1e-9) continue;  // before or after the landing, by an ulp
    const double gap = t < 1 ? 1 - t * t : t < 4 ? 0 : (t - 4) * (t - 4);
    const double gamma = t < 1 || t > 4 ? 0 : t <= 2 ? -2 * t : 2 * t - 8;
    // Sums of S and t I of size 16 at most, and of events found to an ulp of 4.
    EXPECT_NEAR(row.gap, gap, 64 * kEpsilon) << t;
    EXPECT_NEAR(*row.gamma, gamma, 64 * kEpsilon) << t;
  }
  ASSERT_TRUE(trajectory.contact_interval.has_value());
  EXPECT_NEAR((*trajectory.contact_interval)[0], 1, 4 * kEpsilon);
  EXPECT_NEAR((*trajectory.contact_interval)[1], 4, 4 * kEpsilon);
  EXPECT_NEAR(std::log(trajectory.film_from_gamma.value()), -40, 1e-13);
}

TEST(ViscousContactExact, TouchesSolidAtGammaMinAndLeavesByItAlone) {
  // Lands at t = 0.5 with gamma = -1 (q0 = 1/4, f = -2); gamma_min = -2 is reached at t = 1; the
  // pull of 2 from t = 3 on frees it at t = 4.
  const double k = 1;
  Motion motion{1, 0.25, 0, 6, ExternalForce({{3, -2}, {6, 2}})};
  motion.set(kContactTimeStep, 0.01);
  motion.roughness = {motion.initial_gap * std::exp(-2.0), 0};
  const auto trajectory =
      simulate_viscous_contact_exact(motion, lubrication::LubricationForce(leading_term_fit(k)));
  EXPECT_NEAR((*trajectory.contact_interval)[0], 0.5, 1e-15);
  EXPECT_NEAR((*trajectory.contact_interval)[1], 4, 1e-14);
  const auto touches =
      std::ranges::find_if(trajectory.rows, [](const auto& row) { return *row.solid_force > 0; });
  ASSERT_NE(touches, trajectory.rows.end());
  EXPECT_NEAR(touches->time, 1, 1e-14);
  EXPECT_EQ(*touches->solid_force, 2);
  EXPECT_EQ(*touches->lubrication_force, 0);
  // Books: the push gives -6 until t = 3, the film takes 2 of it and gives them back, the solid
  // carries the rest.
  EXPECT_NEAR(trajectory.budget->solid_impulse, 4, 1e-14);
  EXPECT_NEAR(trajectory.budget->film_impulse, 0, 1e-14);
  // All that the fall has gained, 1/2, is lost in the film's impact; the flight after t = 4
  // gains 8.
  EXPECT_NEAR(trajectory.budget->film_work, -0.5, 1e-14);
  EXPECT_NEAR(trajectory.budget->external_work, 8.5, 1e-13);
}

TEST(ViscousContactExact, SharesAHardImpactBetweenFilmAndSolid) {
  // Arrives with momentum -10 where the film can take 4: of the energy 50 the film takes its share
  // of the impulse, 20.
  Motion motion{1, 1, -10, 1, ExternalForce({{1, 0}})};
  motion.set(kContactTimeStep, 0.01);
  motion.roughness = {std::exp(-4.0), 0};
  const auto budget =
      simulate_viscous_contact_exact(motion, lubrication::LubricationForce(leading_term_fit(1)))
          .budget.value();
  EXPECT_NEAR(budget.film_impulse, 4, 1e-13);
  EXPECT_NEAR(budget.solid_impulse, 6, 1e-13);
  EXPECT_NEAR(budget.film_work, -20, 1e-12);
  EXPECT_NEAR(budget.solid_work, -30, 1e-12);
}

TEST(ViscousContactExact, IsWhatTheSchemeTendsTo) {
  // Random pushes that jump; the scheme's error in gap, velocity and gamma is of first order where
  // the contact times are not shifted by a landing that one has and the other not; the sup over a
  // whole motion is bounded by C h with C from the forces.
  std::mt19937_64 generator(5);
  const auto uniform = [&](double from, double to) {
    return std::uniform_real_distribution(from, to)(generator);
  };
  int halved = 0, cases = 0;
  for (int i = 0; i < 100; ++i) {
    std::vector<ExternalForce::Piece> pieces;
    double until = 0;
    for (int j = 0; j < 5; ++j) pieces.push_back({until += uniform(0.5, 1.5), uniform(-3, 3)});
    Motion motion{1, uniform(0.1, 1), uniform(-1, 1), 4, ExternalForce(pieces)};
    motion.external_force +=
        ExternalForce::sinusoidal({uniform(0, 2), uniform(1, 10), uniform(0, 6)});
    if (i % 2 == 0) motion.roughness = {std::exp(-uniform(0.2, 2)), 0};
    const lubrication::LubricationForce force(leading_term_fit(1));
    const auto distance = [&](double h) {
      motion.set(kContactTimeStep, h);
      const auto exact = simulate_viscous_contact_exact(motion, force);
      double sup = 0;
      auto row = exact.rows.begin();
      for (const auto& step : run_contact_model(viscous_contact, motion, force).rows) {
        while (row->time < step.time - 1e-9) ++row;
        sup = std::max(sup, std::abs(step.gap - row->gap));
      }
      return sup;
    };
    const double coarse = distance(1e-2), fine = distance(1e-3);
    ++cases;
    halved += fine < 0.2 * coarse ? 1 : 0;
    EXPECT_LT(fine, 0.05) << i;
  }
  // First order is a tenth; a landing of velocity near 0 may be off by sqrt(h).
  EXPECT_GT(halved, 0.9 * cases);
}

TEST(ViscousContactExact, IsReleasedByAForceThatTouchesZeroInTheMiddleOfItsPiece) {
  // Pulled by (t - 4)^2 on [2, 6]: the impulse since t = 2 is ((t - 4)^3 + 8)/3, and 4 is given
  // back at (t - 4)^3 = 4.
  Motion motion{1, 1, 0, 6, ExternalForce({{2, -2}, {6, 4, {-4, 1}}})};
  motion.set(kContactTimeStep, 0.01);
  const auto trajectory =
      simulate_viscous_contact_exact(motion, lubrication::LubricationForce(leading_term_fit(0.1)));
  EXPECT_NEAR((*trajectory.contact_interval)[1], 4 + std::cbrt(4.0), 1e-13);
  EXPECT_GT(trajectory.rows.back().gap, 0);
}

TEST(ViscousContactExact, SeesContactsOfAForceWhoseSignChangesTwiceInAMoment) {
  // 1000 (t - 0.002)(t - 0.028) pushes for 0.026 of its 1: two roots closer than a 32nd.
  Motion motion{1, 1e-9, 0, 1, ExternalForce({{1, 0.056, {-30, 1000}}})};
  motion.set(kContactTimeStep, 1e-6);
  const lubrication::LubricationForce force(leading_term_fit(1e-9));
  const auto exact = simulate_viscous_contact_exact(motion, force).contact_interval.value();
  const auto scheme = run_contact_model(viscous_contact, motion, force).contact_interval.value();
  // First order: some steps of 1e-6.
  EXPECT_NEAR(exact[0], scheme[0], 1e-5);
  EXPECT_NEAR(exact[1], scheme[1], 1e-5);
}

TEST(ViscousContactExact, RecoversAFilmThatDoesNotDependOnItsRows) {
  // Pushed by -2 cos t until pi/2, where gamma is least between two rows: m u + gamma = -2 sin t =
  // -2.
  ExternalForce force = ExternalForce::sinusoidal({-2, 1, std::acos(0.0)});
  for (const double spacing : {1e-3, 0.03, 0.1}) {
    Motion motion{1, 0.1, 0, 2, force};
    motion.set(kContactTimeStep, spacing);
    const auto film =
        simulate_viscous_contact_exact(motion, lubrication::LubricationForce(leading_term_fit(0.1)))
            .film_from_gamma;
    EXPECT_NEAR(std::log(film.value() / motion.initial_gap), -20, 1e-12) << spacing;
  }
}

TEST(ContactInterval, LastsWhileNothingPullsTheSphere) {
  // No force from t = 2 on: gamma stays, and so does the sphere.
  for (const double later : {0.0, -0.0}) {
    Motion motion{1, 1, 0, 6, ExternalForce({{2, -2}, {6, later}})};
    motion.set(kContactTimeStep, 1e-3);
    const lubrication::LubricationForce force(leading_term_fit(0.1));
    EXPECT_EQ((*run_contact_model(viscous_contact, motion, force).contact_interval)[1], 6);
    EXPECT_EQ((*simulate_viscous_contact_exact(motion, force).contact_interval)[1], 6);
  }
}

TEST(InelasticContact, LeavesAsSoonAsItIsPulled) {
  const auto trajectory = run_contact_model(inelastic_contact, limit_motion(),
                                            lubrication::LubricationForce(leading_term_fit(0.1)));
  // It lands within a step of t = 1, as the viscous one does, and leaves at t = 2.
  EXPECT_NEAR((*trajectory.contact_interval)[0], 1, 1e-3);
  EXPECT_NEAR((*trajectory.contact_interval)[1], 2, 1e-9);
  for (const auto& row : trajectory.rows) {
    EXPECT_EQ(*row.gamma, 0);
    // The scheme's parabola after leaving: (t - 2)^2 + h (t - 2).
    if (row.time > 2) {
      EXPECT_NEAR(row.gap, std::pow(row.time - 2, 2), 1.01e-3 * (row.time - 2) + 1e-9);
    }
  }
  EXPECT_NEAR(trajectory.budget->solid_impulse, 4, 1e-9);  // 2 of the fall, 2 of the push after it
  EXPECT_EQ(trajectory.budget->film_impulse, 0);
}

}  // namespace
}  // namespace viscontact::reduced_model
