// Which numbers count as equal when quantities of two files are compared.
#include "viscontact/common/equal_up_to_rounding.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace viscontact {
namespace {

TEST(EqualUpToRounding, TakesConversionsOfUnitsButNoOtherDifference) {
  for (const double unit : {1e-30, 1.0, 1e30}) {
    EXPECT_TRUE(equal_up_to_rounding(0.1 * 3 * unit, 0.3 * unit));
    EXPECT_TRUE(equal_up_to_rounding(-unit, -unit * (1 + 9e-13)));
    EXPECT_FALSE(equal_up_to_rounding(unit, unit * (1 + 2e-12)));
    EXPECT_FALSE(equal_up_to_rounding(unit * (1 + 2e-12), unit));
    EXPECT_FALSE(equal_up_to_rounding(unit, -unit));
    EXPECT_FALSE(equal_up_to_rounding(unit, 0));
  }
  EXPECT_TRUE(equal_up_to_rounding(0, 0));
  EXPECT_FALSE(equal_up_to_rounding(std::numeric_limits<double>::quiet_NaN(), 1));
}

}  // namespace
}  // namespace viscontact
