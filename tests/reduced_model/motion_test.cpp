#include "viscontact/reduced_model/motion.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tests/common/failure.hpp"

namespace viscontact::reduced_model {
namespace {

using ::testing::ElementsAre;

Motion motion_with(double end_time, double step, std::vector<ExternalForce::Piece> pieces) {
  Motion motion{1, 1, 0, end_time, ExternalForce(std::move(pieces))};
  motion.set(kReferenceTimeStep, step);
  return motion;
}

TEST(StepCount, CoversTheTime) {
  EXPECT_EQ(step_count(4, 1e-3), 4000);
  EXPECT_EQ(step_count(1, 0.25), 4);
  EXPECT_EQ(step_count(1, 0.3), 4);
}

TEST(StepCount, IsOneForAStepLongerThanTheTime) { EXPECT_EQ(step_count(1, 5), 1); }

TEST(StepCount, IsNotRaisedByRoundOff) {
  // 0.3 / 0.1 is 2.9999999999999996 and 0.6 / 0.2 likewise, 0.7 / 0.1 is 6.999..., 1.1 / 0.1
  // is 11.000000000000002.
  EXPECT_EQ(step_count(0.3, 0.1), 3);
  EXPECT_EQ(step_count(0.6, 0.2), 3);
  EXPECT_EQ(step_count(0.7, 0.1), 7);
  EXPECT_EQ(step_count(1.1, 0.1), 11);
}

TEST(StepCount, LeavesAStepShorterThanAMillionthToRoundOff) {
  EXPECT_EQ(step_count(10 + 5e-7, 1), 10);
  EXPECT_EQ(step_count(10 + 2e-6, 1), 11);
}

TEST(StepCount, RefusesMoreStepsThanMemoryCanHold) {
  for (const double step : {1e-9, 1e-300, 0.0, std::numeric_limits<double>::quiet_NaN()})
    bad_input([&] { step_count(1, step); });
}

TEST(StepTime, EndsAtTheEndExactly) {
  EXPECT_EQ(step_time(0, 4, 1, 0.3), 0);
  EXPECT_EQ(step_time(2, 4, 1, 0.3), 0.6);
  EXPECT_EQ(step_time(4, 4, 1, 0.3), 1);
}

TEST(RowTimes, AreTheStepsAndTheJumps) {
  EXPECT_THAT(row_times(motion_with(1, 0.25, {{0.625, -1}, {1, 1}})),
              ElementsAre(0, 0.25, 0.5, 0.625, 0.75, 1));
}

TEST(RowTimes, HaveAJumpThatIsAlsoAStepOnce) {
  EXPECT_THAT(row_times(motion_with(1, 0.25, {{0.5, -1}, {1, 1}})),
              ElementsAre(0, 0.25, 0.5, 0.75, 1));
}

TEST(RowTimes, HaveTheJumpWhereRoundOffSetsAStepApartFromIt) {
  ASSERT_NE(3 * 0.1, 0.3);
  const auto times = row_times(motion_with(0.5, 0.1, {{0.3, -1}, {0.5, 1}}));
  EXPECT_EQ(times.size(), 6U);
  EXPECT_EQ(times[3], 0.3);
}

TEST(RowTimes, LeaveOutJumpsAtAndAfterTheEnd) {
  EXPECT_THAT(row_times(motion_with(1, 0.5, {{1, -1}, {1.25, 1}, {3, 2}})), ElementsAre(0, 0.5, 1));
}

TEST(RowTimes, IncreaseStrictlyFromZeroToTheEnd) {
  // Steps and jumps that fall together up to round-off in many ways.
  for (const double step : {0.1, 0.07, 1.0 / 3, 1e-3}) {
    const auto times = row_times(
        motion_with(2.1, step, {{0.3, 1}, {0.7, 2}, {1.4, 3}, {2.1 - 1e-12, 4}, {2.1, 5}}));
    EXPECT_EQ(times.front(), 0);
    EXPECT_EQ(times.back(), 2.1);
    EXPECT_EQ(std::ranges::adjacent_find(times, std::greater_equal<>()), times.end()) << step;
    for (const double jump : {0.3, 0.7, 1.4}) EXPECT_EQ(std::ranges::count(times, jump), 1) << step;
  }
}

}  // namespace
}  // namespace viscontact::reduced_model
