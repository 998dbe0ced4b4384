// Sizes of regions that planes bound without a domain, against closed forms.
#include "viscontact/particles/domain/bounded_region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace viscontact::particles {
namespace {

// Rounding errors of coordinates that are 1e4 times larger than the region.
constexpr double kRounding = 1e-10;

TEST(BoundedRegion, OfPlanesAloneIsTheirPolygonOrPolyhedron) {
  for (const double unit : {1e-6, 1.0, 1e6})
    for (const double shift : {0.0, 100.0}) {
      const auto at = [&](double x, double y, double z = 0) {
        return Vector{(x + shift) * unit, (y - shift) * unit, z * unit};
      };
      const std::vector<PlanePosition> box = {{at(0, 0), {1, 0, 0}},
                                              {at(3, 0), {-1, 0, 0}},
                                              {at(0, 0), {0, 1, 0}},
                                              {at(0, 2), {0, -1, 0}}};
      EXPECT_NEAR(size_of_region({}, box, 2) / (unit * unit), 6, 6 * kRounding);
      const double root = std::sqrt(0.5);
      const std::vector<PlanePosition> triangle = {box[0], box[2], {at(1, 0), {-root, -root, 0}}};
      EXPECT_NEAR(size_of_region({}, triangle, 2) / (unit * unit), 0.5, kRounding);
      auto cuboid = box;
      cuboid.push_back({at(0, 0, 1), {0, 0, 1}});
      EXPECT_EQ(size_of_region({}, cuboid, 3), 0);
      cuboid.push_back({at(0, 0, 5), {0, 0, -1}});
      EXPECT_NEAR(size_of_region({}, cuboid, 3) / std::pow(unit, 3), 24, 24 * kRounding);
    }
}

TEST(BoundedRegion, ThatIsOpenHasNoSize) {
  EXPECT_EQ(size_of_region({}, {}, 2), 0);
  const std::vector<PlanePosition> gap = {{{0, 0, 0}, {0, 1, 0}}, {{0, 2, 0}, {0, -1, 0}}};
  EXPECT_EQ(size_of_region({}, gap, 2), 0);
  EXPECT_NEAR(size_of_region(BoxDomain{{0, -1, 0}, {5, 9, 0}, {true, false, false}}, gap, 2), 10,
              kRounding);
  EXPECT_NEAR(size_of_region(DiscDomain{{0, 2, 0}, 1}, gap, 2), std::numbers::pi / 2, kRounding);
}

}  // namespace
}  // namespace viscontact::particles
