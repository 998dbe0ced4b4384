#include "viscontact/suspensions/cell/sheared_cell.hpp"

#include <gtest/gtest.h>

#include "tests/common/random.hpp"

namespace viscontact::suspensions {
namespace {

TEST(ShearedCell, FindsTheNearestOfAllImages) {
  Random random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    ShearedCell cell{{1, -2, 5}, {7, 8, 9}, random.uniform(-3.5, 3.5)};
    // Images nearer than half of the least period are the only ones so near.
    const Vector apart{random.uniform(-7, 7), random.uniform(-8, 8), random.uniform(-9, 9)};
    double nearest = 1e300;
    for (int x = -3; x <= 3; ++x)
      for (int y = -2; y <= 2; ++y)
        for (int z = -2; z <= 2; ++z)
          nearest =
              std::min(nearest, norm(apart - cell.shift_of({double(x), double(y), double(z)})));
    const double found = norm(cell.nearest(apart));
    if (nearest < 3.5)
      EXPECT_NEAR(found, nearest, 1e-13);
    else
      EXPECT_GE(found, 3.5 - 1e-13);
  }
}

TEST(ShearedCell, WrapsToAnImageInTheCell) {
  Random random(4);
  const ShearedCell cell{{1, -2, 5}, {7, 8, 9}, 2.5};
  for (int trial = 0; trial < 200; ++trial) {
    const Vector x{random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20)};
    const Vector at = cell.wrapped(x);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_GE(at[d], cell.from[d]);
      EXPECT_LT(at[d], cell.from[d] + cell.lengths[d]);
    }
    EXPECT_NEAR(norm(cell.nearest(at - x)), 0, 1e-13);
  }
}

}  // namespace
}  // namespace viscontact::suspensions
