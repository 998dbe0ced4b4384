// What holds in every step of every contact model, whatever the sphere, the fluid and the force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/reduced_model/cases.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"

namespace viscontact::reduced_model {
namespace {

constexpr int kCases = 10'000;
// Every step of a motion is checked, so that fewer motions do.
constexpr int kMotions = 3000;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

using MakeModel = ContactModel (*)(const Motion&, const lubrication::LubricationForce&);

class ContactInvariants : public ::testing::TestWithParam<MakeModel> {
 protected:
  /// Calls check(motion, model, before, after) for each step of each case.
  template <class Check>
  void for_each_step(const Check& check) {
    std::mt19937_64 generator(20080123);
    int contacts = 0;
    for (int i = 0; i < kMotions; ++i) {
      const auto [motion, k] = random_case(generator);
      SCOPED_TRACE(::testing::Message() << "case " << i << ": m = " << motion.mass << ", k = " << k
                                        << ", h = " << motion.parameter(kContactTimeStep)
                                        << ", s = " << motion.roughness[0]);
      const lubrication::LubricationForce force(shifted_fit(k));
      ContactModel model = GetParam()(motion, force);
      // The film may be thinner than any double; that is no matter here.
      model.film_thickness = [](double) { return 0.0; };
      const auto trajectory = run_contact_model(motion, model);
      bool touched = false;
      for (std::size_t n = 1; n < trajectory.rows.size(); ++n) {
        const auto& before = trajectory.rows[n - 1];
        const auto& after = trajectory.rows[n];
        touched = touched || *after.gamma < 0;
        check(motion, model, before, after);
        if (HasFailure()) return;
      }
      contacts += touched ? 1 : 0;
    }
    EXPECT_GT(contacts, kMotions / 5);  // or the cases were none
  }
};

/// No overlap, no pull at a distance, no memory beyond what the solid holds.
void expect_contact_law(const ContactModel& model, const TrajectoryRow& row) {
  EXPECT_GE(row.gap, model.contact_gap);
  EXPECT_LE(*row.gamma, 0);
  EXPECT_GE(*row.gamma, model.gamma_min);
  EXPECT_EQ((row.gap - model.contact_gap) * *row.gamma, 0);
  EXPECT_TRUE(std::isfinite(row.gap) && std::isfinite(row.velocity) && std::isfinite(*row.gamma));
}

/// m (u^{n+1} - u^n) = h (f^n + F_lub + F_solid): the film gives h lambda = gamma^n - gamma^{n+1},
/// the resolved drag its impulse. A solid contact pushes where gamma is at its least, and never
/// pulls.
void expect_momentum_balance(const Motion& motion, const ContactModel& model,
                             const TrajectoryRow& before, const TrajectoryRow& after) {
  const double m = motion.mass;
  const double h = after.time - before.time;
  const double push = h * motion.external_force.mean(before.time, after.time);
  const double drag = h * *after.lubrication_force;
  const double solid = h * *after.solid_force;
  // Times of up to 10 are subtracted and multiplied with forces of up to 100 m; drag is a
  // difference of impulses; then some ten roundings.
  double scale = m * (std::abs(after.velocity) + std::abs(before.velocity)) + std::abs(push) +
                 std::abs(drag) + solid + std::abs(*before.gamma) + std::abs(*after.gamma);
  // Of the gap and of the velocity that Newton's method finds, what a rounding of each does to the
  // drag's impulse.
  if (model.drag)
    scale +=
        std::abs(model.drag->impulse(before.gap)) + std::abs(model.drag->impulse(after.gap)) +
        std::abs(model.drag->resistance(after.gap)) * (after.gap + h * std::abs(after.velocity));
  // The step as the difference of two rows' times of up to 10.
  const double of_step = 20 / h * (std::abs(drag) + solid);
  const double round_off = kEpsilon * (16 * scale + 1e4 * m + of_step);
  EXPECT_NEAR(m * (after.velocity - before.velocity) - push - drag - solid, 0, round_off);
  EXPECT_GE(solid, 0);
  if (*after.gamma != model.gamma_min) {
    EXPECT_EQ(solid, 0);
  }
}

void expect_move_by_velocity(const TrajectoryRow& before, const TrajectoryRow& after) {
  const double h = after.time - before.time;
  // Half an ulp of each gap, and of the time that h is the difference of (up to 10).
  const double round_off =
      kEpsilon * (4 * (before.gap + after.gap) + 20 * std::abs(after.velocity));
  EXPECT_NEAR(after.gap - before.gap, h * after.velocity, round_off);
}

TEST_P(ContactInvariants, HoldInEveryStep) {
  for_each_step([](const Motion& motion, const ContactModel& model, const TrajectoryRow& before,
                   const TrajectoryRow& after) {
    expect_contact_law(model, after);
    expect_momentum_balance(motion, model, before, after);
    expect_move_by_velocity(before, after);
  });
}

std::string model_name(const ::testing::TestParamInfo<MakeModel>& info) {
  constexpr std::array kNames = {"ViscousContact", "RegularDrag", "Threshold"};
  return kNames.at(info.index);
}

INSTANTIATE_TEST_SUITE_P(Of, ContactInvariants,
                         ::testing::Values(viscous_contact, viscous_contact_regular_drag,
                                           viscous_contact_threshold),
                         model_name);

TEST(ViscousContactMomentum, IsKeptOverAWholeMotionWithoutSolidContact) {
  // Summed over the steps: m u + gamma = m v0 + int f, the first integral (I) of the contact model.
  std::mt19937_64 generator(7);
  for (int i = 0; i < kCases; ++i) {
    auto [motion, k] = random_case(generator);
    motion.roughness = {0, 0};
    const double start = motion.mass * motion.initial_velocity;
    double largest = std::abs(start);
    for (const auto& row : run_contact_model(viscous_contact, motion,
                                             lubrication::LubricationForce(leading_term_fit(k)))
                               .rows) {
      const double momentum = start + motion.external_force.impulse(row.time);
      largest = std::max(largest, std::abs(momentum));
      // Up to 3200 steps, a few roundings each at the size of the largest momentum, all of one sign
      // at worst.
      ASSERT_NEAR(motion.mass * row.velocity + *row.gamma, momentum,
                  3200 * 4 * kEpsilon * (largest + 1e3 * motion.mass))
          << i;
    }
  }
}

}  // namespace
}  // namespace viscontact::reduced_model
