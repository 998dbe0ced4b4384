// data/cases/limit.toml: the lecture's limit of vanishing viscosity, without tabulation.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;

constexpr double kStep = 1e-3;  // of data/cases/limit.toml

TEST(LimitCase, ViscousContactTouchesFrom1To4AndFollowsTheLimit) {
  const TemporaryFolder scratch;
  // FreeFEM is not needed: its absence is not noticed.
  expect_done(run_viscontact(
      {"run", VISCONTACT_SOURCE_FOLDER "/data/cases/limit.toml", "-o", scratch.path().string()},
      {"VISCONTACT_FREEFEM=no-such-freefem"}));
  const auto comparison = reduced_model::read_comparison(scratch.path() / "comparison.json");
  ASSERT_EQ(comparison.models.size(), 4U);
  const auto& contact = comparison.models[1];
  ASSERT_EQ(contact.model, "viscous_contact");
  ASSERT_TRUE(contact.contact_interval);
  EXPECT_NEAR((*contact.contact_interval)[0], 1,
              kStep * 1.001);  // to one step, with room for round-off of the time
  EXPECT_NEAR((*contact.contact_interval)[1], 4, kStep * 1.001);
  EXPECT_EQ(contact.minimal_gap, 0);

  // q = 1 - t^2, then 0, then (t - 4)^2; gamma = -2t until t = 2, 0 at t = 4.
  for (const auto& row :
       reduced_model::read_trajectory(scratch.path() / "trajectories" / "viscous_contact.csv")
           .rows) {
    const double t = row.time;
    const double gap = t < 1 ? 1 - t * t : (t < 4 ? 0 : (t - 4) * (t - 4));
    const double gamma = t < 1 || t > 4 ? 0 : (t < 2 ? -2 * t : -8 + 2 * t);
    // First order in the step: |u| <= 4 over one step, twice that where the step of impact or
    // release is off by one.
    EXPECT_NEAR(row.gap, gap, 8 * kStep) << "t = " << t;
    // |dgamma/dt| = 2 in contact; at impact the whole momentum is taken up within one step.
    if (std::abs(t - 1) > 2 * kStep) {
      EXPECT_NEAR(row.gamma.value(), gamma, 4 * kStep) << "t = " << t;
    }
  }
}

TEST(LimitCase, IsNotSimulatedTwice) {
  const TemporaryFolder scratch;
  const std::vector<std::string> arguments = {
      "run", VISCONTACT_SOURCE_FOLDER "/data/cases/limit.toml", "-o", scratch.path().string()};
  expect_done(run_viscontact(arguments));
  const auto again = run_viscontact(arguments);
  expect_done(again);
  EXPECT_THAT(again.errors, HasSubstr("up to date"));
}

}  // namespace
}  // namespace viscontact
