// Anderson's acceleration of iterations whose fixed points are known.
#include "viscontact/suspensions/step/acceleration.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace viscontact::suspensions {
namespace {

using Loads = std::vector<double>;

/// The loads, and motions and a rate that are linear in them.
struct Iterate {
  Loads loads;
  std::vector<Motion> motions() const {
    return {Motion{Lanes{2 * loads[0], loads[1], 0, 0}, Lanes{loads[0] - loads[1], 0, 3, 0}}};
  }
  double rate() const { return 5 * loads[0] + loads[1] + 1; }
};

/// A linear iteration with the factors 0.9 and -0.8 along two directions and the fixed point
/// (3, -2), near which 100 iterations alone would leave an error of 1e-4.
Iterate after(const Iterate& before) {
  const double x = before.loads[0] - 3, y = before.loads[1] + 2, sum = (x + y) / 2,
               difference = (x - y) / 2;
  return {{3 + 0.9 * sum - 0.8 * difference, -2 + 0.9 * sum + 0.8 * difference}};
}

TEST(Acceleration, FindsTheFixedPointOfALinearIteration) {
  Acceleration acceleration;
  Iterate last{{10, 4}};
  // One more than there are directions.
  for (int n = 0; n < 3; ++n) {
    EXPECT_EQ(acceleration.is_empty(), n < 2);
    const auto next = after(last);
    acceleration.add(last.loads, next.loads, next.motions(), next.rate());
    last = next;
  }
  auto loads = last.loads;
  auto motions = last.motions();
  double rate = last.rate();
  acceleration.combine(loads, motions, rate);
  const Iterate fixed{{3, -2}};
  for (const std::size_t k : {0U, 1U}) EXPECT_NEAR(loads[k], fixed.loads[k], 1e-12);
  // Their weights are the same ones, whose sum is 1.
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(motions[0].along[d], fixed.motions()[0].along[d], 1e-12);
    EXPECT_NEAR(motions[0].turn[d], fixed.motions()[0].turn[d], 1e-12);
  }
  EXPECT_NEAR(rate, fixed.rate(), 1e-12);
}

TEST(Acceleration, ForgetsIteratesOfOtherContacts) {
  Acceleration acceleration;
  const std::vector<Motion> motions(1);
  acceleration.add({0, 0}, {1, 0}, motions, 0);
  acceleration.add({1, 0}, {1, 0.5}, motions, 0);
  EXPECT_FALSE(acceleration.is_empty());
  // Changes that grow.
  acceleration.add({1, 0.5}, {5, 0.5}, motions, 0);
  EXPECT_TRUE(acceleration.is_empty());
  acceleration.add({0, 0}, {1, 0}, motions, 0);
  acceleration.add({1, 0}, {1, 0.5}, motions, 0);
  EXPECT_FALSE(acceleration.is_empty());
  // Another number of contacts.
  acceleration.add({1, 0.5, 0}, {1, 0.5, 0.1}, motions, 0);
  EXPECT_TRUE(acceleration.is_empty());
}

TEST(Acceleration, KeepsTheLastIterateWhereNothingChanges) {
  Acceleration acceleration;
  const std::vector<Motion> motions(1);
  for (int n = 0; n < 3; ++n) acceleration.add({1, 2}, {1, 2}, motions, 4);
  Loads loads{0, 0};
  auto combined = motions;
  double rate = 0;
  acceleration.combine(loads, combined, rate);
  EXPECT_EQ(loads, (Loads{1, 2}));
  EXPECT_EQ(rate, 4);
}

}  // namespace
}  // namespace viscontact::suspensions
