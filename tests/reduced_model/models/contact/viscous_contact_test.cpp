// The viscous contact model on motions whose limit is known in closed form.
#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/reduced_model/cases.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/reduced_model/models/reference.hpp"

namespace viscontact::reduced_model {
namespace {

/// q of the lecture's limit case at mu = 0: it lands at t = 1 and leaves at t = 4.
double limit_gap(double t) { return t < 1 ? 1 - t * t : t < 4 ? 0 : (t - 4) * (t - 4); }

Trajectory limit_trajectory(double step) {
  Motion motion = limit_motion();
  motion.set(kContactTimeStep, step);
  Trajectory trajectory = run_contact_model(viscous_contact, motion,
                                            lubrication::LubricationForce(leading_term_fit(0.1)));
  trajectory.model = "viscous_contact";
  return trajectory;
}

std::array<double, 2> contact_interval(const Trajectory& trajectory) {
  return compare_trajectories({trajectory}, trajectory.model)
      .models.front()
      .contact_interval.value();
}

TEST(ViscousContact, FollowsTheParabolasOfTheLimitCaseToFirstOrder) {
  // Before landing q^n = 1 - h^2 n (n+1) = 1 - t^2 - h t; the error after leaving is that of the
  // velocity and of the release, to one step each: 2 h (t - 4) + h (t - 4) <= 6 h at t = 6.
  for (const double step : {1e-2, 1e-3, 1e-4})
    for (const auto& row : limit_trajectory(step).rows)
      EXPECT_NEAR(row.gap, limit_gap(row.time), row.time < 4 ? 1.001 * step : 6.1 * step)
          << step << ", t = " << row.time;
}

TEST(ViscousContact, RemembersExactlyTheImpulseItHasTaken) {
  for (const auto& row : limit_trajectory(1e-3).rows) {
    if (row.time < 1 + 2e-3 || row.time > 4 - 1e-3) continue;
    const double gamma = row.time <= 2 ? -2 * row.time : 2 * row.time - 8;
    EXPECT_NEAR(*row.gamma, gamma, 1e-12)
        << row.time;  // 3000 roundings of numbers up to 4, at random
    EXPECT_EQ(row.velocity, 0);
  }
}

TEST(ViscousContact, RecoversTheFilmFromItsLowestGamma) {
  // gamma is -4 at its lowest, where mu = 0.1: the film is exp(-40) (limit_case_states.csv has the
  // same to 14 digits).
  const auto recovered = limit_trajectory(1e-3).film_from_gamma;
  ASSERT_TRUE(recovered.has_value());
  EXPECT_NEAR(std::log(*recovered), -40, 1e-10);  // round-off of gamma over mu
}

TEST(ViscousContact, HasNoFilmToRecoverWithoutContact) {
  Motion motion = limit_motion();
  motion.external_force = ExternalForce({{6, 2}});
  EXPECT_FALSE(run_contact_model(viscous_contact, motion,
                                 lubrication::LubricationForce(leading_term_fit(0.1)))
                   .film_from_gamma);
}

TEST(ViscousContact, LeavesWhenThePushIsGivenBackWhateverThePush) {
  // From 1e-6 above the plane, pushed by F for 1 and pulled by G after: off at 1 + F/G. The fall
  // takes sqrt(2e-6 m / F), at most 0.02.
  for (const double mass : {1e-3, 1.0, 50.0})
    for (const double push : {0.3, 4.0, 1000.0})
      for (const double ratio : {0.5, 1.0, 3.7}) {
        Motion motion{mass, 1e-6, 0, 1.1 + ratio, ExternalForce({{1, -push}, {10, push / ratio}})};
        motion.set(kContactTimeStep, 1e-3);
        Trajectory trajectory = run_contact_model(
            viscous_contact, motion, lubrication::LubricationForce(leading_term_fit(1)));
        trajectory.model = "viscous_contact";
        EXPECT_NEAR(contact_interval(trajectory)[1], 1 + ratio, 1e-3 * (1 + 1e-6))
            << "m = " << mass << ", F = " << push << ", F/G = " << ratio;
      }
}

TEST(ViscousContact, LeavesASolidContactByTheRoughnessAloneWhateverThePush) {
  // gamma stops at gamma_min = k ln(s/q0), so a pull G takes -gamma_min/G to free the sphere.
  const double k = 0.5;
  const double solid_gap = 0.01;
  const double gap = 0.1, gamma_min = k * std::log(solid_gap / gap);
  const double pull = 3;
  for (const double push : {5.0, 50.0, 5000.0}) {
    Motion motion{1, gap, 0, 4, ExternalForce({{2, -push}, {4, pull}})};
    motion.set(kContactTimeStep, 1e-3);
    motion.roughness = {0.004, 0.006};
    Trajectory trajectory = run_contact_model(viscous_contact, motion,
                                              lubrication::LubricationForce(leading_term_fit(k)));
    trajectory.model = "viscous_contact";
    EXPECT_NEAR(contact_interval(trajectory)[1], 2 - gamma_min / pull, 1e-3 * (1 + 1e-6)) << push;
    // exp and log of the same number: a few roundings at the size of ln s.
    EXPECT_NEAR(trajectory.film_from_gamma.value() / solid_gap, 1, 1e-14) << push;
  }
}

Trajectory leapfrog(const Motion& motion, double k) {
  Trajectory trajectory = run_contact_model(viscous_contact_leapfrog, motion,
                                            lubrication::LubricationForce(leading_term_fit(k)));
  trajectory.model = "viscous_contact_leapfrog";
  return trajectory;
}

TEST(ViscousContactLeapfrog, FollowsTheParabolasOfTheLimitCaseToSecondOrder) {
  // Steps that hit the times of landing and release, and steps that do not. A release within a step
  // leaves an error of at most h^2 f/(8 m), the landing one of h^2.
  for (const double step : {1e-2, 6e-2 / 7, 1e-3, 1e-4}) {
    Motion motion = limit_motion();
    motion.set(kContactTimeStep, step);
    const auto trajectory = leapfrog(motion, 0.1);
    for (const auto& row : trajectory.rows) {
      EXPECT_NEAR(row.gap, limit_gap(row.time), step * step) << step << ", t = " << row.time;
      const double velocity = row.time < 1 ? -2 * row.time : row.time < 4 ? 0 : 2 * (row.time - 4);
      if (std::abs(row.time - 1) > 2 * step && std::abs(row.time - 4) > 2 * step) {
        EXPECT_NEAR(row.velocity, velocity, 1e-9) << step << ", t = " << row.time;
      }
      const double gamma = row.time < 1   ? 0
                           : row.time < 2 ? -2 * row.time
                           : row.time < 4 ? 2 * row.time - 8
                                          : 0;
      if (std::abs(row.time - 1) > 2 * step) {
        EXPECT_NEAR(*row.gamma, gamma, 1e-9) << row.time;
      }
    }
    const auto [from, to] = contact_interval(trajectory);
    EXPECT_NEAR(from, 1, step * (1 + 1e-6)) << step;
    EXPECT_NEAR(to, 4, 1e-9) << step;
  }
}

TEST(ViscousContactLeapfrog, ReleasesASphereOfSolidContactToSecondOrder) {
  // The release case of physics.md section 5: m = 1, gap 1, gamma_min = -2, pulled from t = 5 on.
  const double g = std::numbers::sqrt2 / 2, landed = std::sqrt(2 / g);
  for (const double step : {0.01, 0.0123}) {
    Motion motion{1, 1, 0, 10, ExternalForce({{5, -g}, {10, g}})};
    motion.set(kContactTimeStep, step);
    motion.roughness = {std::exp(-2.0), 0};  // k = 1
    const auto trajectory = leapfrog(motion, 1);
    const double left = 5 + 2 / g;
    ASSERT_LT(landed, 5);
    EXPECT_NEAR(trajectory.rows.back().gap, g / 2 * (10 - left) * (10 - left), step * step);
    EXPECT_NEAR(contact_interval(trajectory)[1], left, 1e-9);
  }
}

TEST(ViscousContactLeapfrog, KeepsTheBudgetsToRoundOff) {
  Motion motion{1, 0.1, -0.2, 4, ExternalForce({{1.03, -40}, {4, 13}})};
  motion.set(kContactTimeStep, 7e-3);
  motion.roughness = {0.004, 0.006};
  const auto trajectory = leapfrog(motion, 0.5);
  const auto& budget = *trajectory.budget;
  const auto& last = trajectory.rows.back();
  EXPECT_NEAR(motion.mass * (last.velocity + 0.2),
              budget.external_impulse + budget.film_impulse + budget.solid_impulse, 1e-11);
  EXPECT_NEAR(0.5 * motion.mass * (last.velocity * last.velocity - 0.04),
              budget.external_work + budget.film_work + budget.solid_work, 1e-11);
}

TEST(ViscousContact, StaysAtGammaMinWhilePushedAndRisesAtOnceWhenPulled) {
  const double k = 0.5;
  Motion motion{1, 0.1, 0, 4, ExternalForce({{2, -40}, {4, 3}})};
  motion.set(kContactTimeStep, 1e-3);
  motion.roughness = {0.004, 0.006};
  const double gamma_min =
      k * std::log((motion.roughness[0] + motion.roughness[1]) / motion.initial_gap);
  bool reached = false;
  for (const auto& row : run_contact_model(viscous_contact, motion,
                                           lubrication::LubricationForce(leading_term_fit(k)))
                             .rows) {
    reached = reached || *row.gamma == gamma_min;
    if (reached && row.time <= 2) {
      EXPECT_EQ(*row.gamma, gamma_min) << row.time;
    } else if (reached && row.time < 2 - gamma_min / 3 - 1e-3) {
      // Round-off of up to 500 steps; a single step is 3e-3.
      EXPECT_NEAR(*row.gamma, gamma_min + 3 * (row.time - 2), 1e-12) << row.time;
    }
  }
  EXPECT_TRUE(reached);
}

TEST(ViscousContact, TakesItsViscosityFromTheFit) {
  const lubrication::Fit fit = lecture_fit();
  const lubrication::LubricationForce force(fit);
  Motion motion = lecture_motion();
  motion.roughness = {1e-3, 0};
  const ContactModel model = viscous_contact(motion, force);
  EXPECT_EQ(model.gamma_min, fit.terms.front().coefficient * std::log(1e-3 / motion.initial_gap));
  // In theory k = 6 pi mu r^2; the lecture's basis finds it to 4.4e-3.
  EXPECT_NEAR(force.leading_coefficient() / (18 * std::numbers::pi), 1, 5e-3);
  EXPECT_EQ(model.contact_gap, 0);
  EXPECT_FALSE(model.drag.has_value());
  motion.roughness = {0, 0};
  EXPECT_TRUE(std::isinf(viscous_contact(motion, force).gamma_min));
}

TEST(RecoveredFilm, IsThatOfTheFirstIntegralWhereverTheSphereStarts) {
  // R = k/q with k = 1 and radius 1: the push takes the film from q0 to q0 exp(-4), with or without
  // contact models.
  const lubrication::LubricationForce force(leading_term_fit(1));
  for (const double initial_gap : {1e-9, 1e-3, 0.1, 1.0, 3.0}) {
    Motion motion = limit_motion();
    motion.mass = 1e-3;  // it lands in the first tenth of the push
    motion.initial_gap = initial_gap;
    const double expected = lowest_row(simulate_reference_exact(motion, force)).gap;
    EXPECT_NEAR(expected / initial_gap, std::exp(-4), 1e-13);
    for (const auto* model :
         {"viscous_contact", "viscous_contact_regular_drag", "viscous_contact_exact"})
      EXPECT_NEAR(simulate(find_model(model), motion, force).film_from_gamma.value() / expected, 1,
                  1e-11)  // the impulses of 6000 steps
          << model << " from " << initial_gap;
  }
}

TEST(RecoveredFilm, IsThatOfTheFirstIntegralWithARegularDragToo) {
  // R = k/q + k: ln q + q = ln q0 + q0 - 4. In contact the model leaves the second term, q, out.
  const lubrication::LubricationForce force(shifted_fit(1));
  for (const double initial_gap : {1e-6, 0.1, 0.5}) {
    Motion motion = limit_motion();
    motion.mass = 1e-3;
    motion.initial_gap = initial_gap;
    const double expected = lowest_row(simulate_reference_exact(motion, force)).gap;
    const auto film =
        simulate(find_model("viscous_contact_regular_drag"), motion, force).film_from_gamma;
    EXPECT_NEAR(std::log(film.value()), std::log(expected) + expected, 1e-11) << initial_gap;
  }
}

TEST(RecoveredFilm, IsNeverThinnerThanTheRoughnessAndReachesItAtGammaMin) {
  // Film and gamma_min begin at the same length, the initial gap, whether it is the radius or not.
  const lubrication::LubricationForce force(leading_term_fit(1));
  for (const double initial_gap : {1e-3, 0.1, 1.0, 3.0, 10.0}) {
    Motion motion = limit_motion();
    motion.mass = 1e-3;
    motion.initial_gap = initial_gap;
    motion.roughness = {0.03 * initial_gap, 0.02 * initial_gap};  // exp(-4) = 0.018
    const auto film = run_contact_model(viscous_contact, motion, force).film_from_gamma;
    EXPECT_EQ(film.value(), motion.roughness[0] + motion.roughness[1]) << initial_gap;
    const auto model = viscous_contact(motion, force);
    EXPECT_NEAR(model.film_thickness(model.gamma_min * (1 - 1e-9)) / film.value(), 1, 1e-8);
  }
}

}  // namespace
}  // namespace viscontact::reduced_model
