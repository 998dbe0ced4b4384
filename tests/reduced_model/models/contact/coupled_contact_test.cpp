// Viscous contact coupled with the fitted drag, on the lecture's case.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/common/failure.hpp"
#include "tests/reduced_model/cases.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"
#include "viscontact/reduced_model/models/reference.hpp"

namespace viscontact::reduced_model {
namespace {

constexpr double kPush = -400;  // impulse of the lecture's push

double regular_drag_film(const lubrication::LubricationForce& force, double step) {
  Motion motion = lecture_motion();
  motion.set(kContactTimeStep, step);
  return run_contact_model(viscous_contact_regular_drag, motion, force).film_from_gamma.value();
}

TEST(RegularDrag, RecoversTheLecturesMinimalGap) {
  for (const auto& fit : {lecture_fit(), close_fit()})
    EXPECT_NEAR(regular_drag_film(lubrication::LubricationForce(fit), 1e-4) / 3.0e-3, 1, 0.03)
        << fit.basis;  // the bar
}

// The films below are exp of an impulse of up to 400 over k = 57, after up to 4000 steps of a few
// roundings each: 1e-11 at most.
constexpr double kRoundOff = 1e-11;

TEST(RegularDrag, RecoversTheFilmThatTheResolvedDragLeavesWhateverItsStep) {
  // At rest in contact the first integral reads gamma + int_1^0 (R - k/q) dq = -400.
  const lubrication::Fit fit = close_fit();
  const lubrication::LubricationForce force(fit);
  const double k = force.leading_coefficient();
  const double smallest = fit.gap_interval[0];
  const double resolved = force.impulse(1) - force.impulse(smallest) + k * std::log(smallest) +
                          smallest * force.regular_resistance(smallest);
  const double film = std::exp((kPush + resolved) / k);
  for (const double step : {0.3, 0.1, 0.07, 1e-2, 3e-3, 1e-3, 1e-4})
    EXPECT_NEAR(regular_drag_film(force, step) / film, 1, kRoundOff) << step;
  // 2.991e-3: to half a unit of what the lecture prints, 3e-3 with three digits at most.
  EXPECT_NEAR(film, 3.00e-3, 1e-5);
}

TEST(RegularDrag, IsViscousContactWhereTheDragIsKOverQ) {
  const lubrication::LubricationForce force(leading_term_fit(0.3));
  const Motion motion = limit_motion();
  const ContactModel model = viscous_contact_regular_drag(motion, force);
  for (const double gap : {0.0, 1e-3, 1.0}) {
    EXPECT_EQ(model.drag->resistance(gap), 0);
    EXPECT_EQ(model.drag->impulse(gap), 0);
  }
}

TEST(RegularDrag, FallsAtTheSpeedOfItsDragFarFromContact) {
  // R - k/q = k here: u tends to f/k as exp(-k t / m), by implicit Euler (1 + h k/m)^-n.
  const double k = 2;
  const lubrication::LubricationForce force(shifted_fit(k));
  Motion motion{1, 100, 0, 5, ExternalForce({{5, -3}})};
  motion.set(kContactTimeStep, 0.125);
  const auto trajectory = run_contact_model(viscous_contact_regular_drag, motion, force);
  for (std::size_t n = 0; n < trajectory.rows.size(); ++n)
    // 40 steps of a few roundings each, of velocities that are differences of impulses k q = 200,
    // over m + h k.
    EXPECT_NEAR(trajectory.rows[n].velocity, -1.5 * (1 - std::pow(1.25, -static_cast<double>(n))),
                1e-13)
        << n;
}

TEST(Threshold, RecoversTheFilmOfTheReferenceWhateverStepThresholdAndMass) {
  // All of the drag is resolved down to q_c and all of it remembered below: at rest Gamma(film) =
  // Gamma(1) - 400 for every q_c, h and m. A drag that also acted on the sphere held at rest would
  // make it 11.7 % off at q_c = 0.1, h = 1e-3.
  for (const auto& fit : {lecture_fit(), close_fit()}) {
    const lubrication::LubricationForce force(fit);
    Motion motion = lecture_motion();
    const double exact = lowest_row(simulate_reference_exact(motion, force)).gap;
    for (const double threshold_gap : {0.3, 0.1, 0.03})
      for (const double step : {0.3, 0.1, 0.07, 1e-2, 3e-3, 1e-3,
                                1e-4})  // some with the turn of the force within a step
        for (const double mass : {1e-6, 1e-3, 20.0}) {
          motion.set(kThresholdGap, threshold_gap);
          motion.set(kContactTimeStep, step);
          motion.mass = mass;
          const auto film =
              run_contact_model(viscous_contact_threshold, motion, force).film_from_gamma;
          EXPECT_NEAR(film.value() / exact, 1, kRoundOff)
              << fit.basis << ", q_c = " << threshold_gap << ", h = " << step << ", m = " << mass;
        }
  }
}

TEST(Threshold, FollowsTheInertialMotionAboveItsThresholdAtFirstOrder) {
  const lubrication::LubricationForce force(close_fit());
  Motion motion = lecture_motion();
  motion.set(kReferenceTimeStep, 1e-2);
  const auto exact = simulate_inertial(motion, force);
  const auto distance = [&](double step) {
    motion.set(kContactTimeStep, step);
    const auto trajectory = run_contact_model(viscous_contact_threshold, motion, force);
    double sup = 0;
    for (double t = 0.1; t < 0.95; t += 0.05) {
      const auto at = [t](const Trajectory& of) {
        return std::ranges::find_if(of.rows, [t](const auto& row) { return row.time > t - 1e-9; })
            ->gap;
      };
      sup = std::max(sup, std::abs(at(trajectory) - at(exact)));
    }
    return sup;
  };
  // C h (1 + O(h)); it lands at t = 0.996.
  EXPECT_NEAR(std::log10(distance(1e-2) / distance(1e-3)), 1, 0.05);
  EXPECT_NEAR(std::log10(distance(1e-3) / distance(1e-4)), 1, 0.01);
}

TEST(Threshold, StaysAtItsThresholdWhileInContact) {
  const auto trajectory = run_contact_model(viscous_contact_threshold, lecture_motion(),
                                            lubrication::LubricationForce(lecture_fit()));
  EXPECT_EQ(lowest_row(trajectory).gap, 0.1);
  EXPECT_EQ(row_at(trajectory, 2).gap, 0.1);
  EXPECT_LT(*row_at(trajectory, 2).gamma, 0);
}

TEST(Threshold, StopsAtTheRoughnessHeight) {
  Motion motion = lecture_motion();
  motion.roughness = {0.01, 0.01};
  const lubrication::LubricationForce force(lecture_fit());
  const auto trajectory = run_contact_model(viscous_contact_threshold, motion, force);
  // Gamma and its inverse, to round-off of Gamma's 400 over k = 57.
  EXPECT_NEAR(trajectory.film_from_gamma.value() / 0.02, 1, 1e-13);
  EXPECT_EQ(*row_at(trajectory, 2).gamma, force.impulse(0.02) - force.impulse(0.1));
}

TEST(Threshold, RefusesToStartBelowItsThreshold) {
  for (const double threshold_gap : {1.0, 1.5}) {
    Motion motion = lecture_motion();
    motion.set(kThresholdGap, threshold_gap);
    EXPECT_THAT(failure(ErrorKind::kBadInput,
                        [&] {
                          run_contact_model(viscous_contact_threshold, motion,
                                            lubrication::LubricationForce(lecture_fit()));
                        }),
                Names("viscous_contact.threshold_gap"));
  }
}

TEST(Threshold, RefusesAThresholdOutsideTheFit) {
  Motion motion = lecture_motion();
  motion.set(kThresholdGap, 1e-4);
  EXPECT_THAT(failure(ErrorKind::kBadInput,
                      [&] {
                        run_contact_model(viscous_contact_threshold, motion,
                                          lubrication::LubricationForce(lecture_fit()));
                      }),
              Names("0.001", "2"));
}

TEST(ContactModels, RefuseAFitWithoutAPositiveLeadingTerm) {
  lubrication::Fit fit = leading_term_fit(1);
  fit.gap_interval = {1e-3, 10};
  fit.terms = {{"1", 1, 0}};
  const lubrication::LubricationForce force(fit);
  EXPECT_THAT(
      bad_input([&] { run_contact_model(viscous_contact_regular_drag, limit_motion(), force); }),
      Names("1/q"));
}

}  // namespace
}  // namespace viscontact::reduced_model
