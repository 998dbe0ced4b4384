// Sizes of the part of a domain that planes leave free, against closed forms and random points.
#include "viscontact/particles/domain/region.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

using std::numbers::pi;
constexpr double kRounding = 1e-12;

Vector unit(const Vector& x) { return (1 / norm(x)) * x; }

TEST(Region, OfABoxHasTheAreaThatPlanesLeave) {
  const BoxDomain box{{0, 0, 0}, {4, 3, 0}, {}};
  EXPECT_NEAR(measure(box, {}), 12, kRounding);
  EXPECT_NEAR(measure(box, std::vector<PlanePosition>{{{0, 2, 0}, {0, -1, 0}}}), 8, kRounding);
  // A corner of the legs 1 and 1, and the same plane twice.
  const PlanePosition corner{{1, 0, 0}, unit({1, 1, 0})};
  EXPECT_NEAR(measure(box, std::vector{corner}), 11.5, kRounding);
  EXPECT_NEAR(measure(box, std::vector{corner, corner}), 11.5, kRounding);
  // On a side, outside, and with nothing left.
  EXPECT_NEAR(measure(box, std::vector<PlanePosition>{{{0, 0, 0}, {0, 1, 0}}}), 12, kRounding);
  EXPECT_NEAR(measure(box, std::vector<PlanePosition>{{{0, -1, 0}, {0, 1, 0}}}), 12, kRounding);
  EXPECT_NEAR(measure(box, std::vector<PlanePosition>{{{0, 5, 0}, {0, 1, 0}}}), 0, kRounding);
  EXPECT_NEAR(
      measure(box, std::vector<PlanePosition>{{{0, 1, 0}, {0, -1, 0}}, {{0, 2, 0}, {0, 1, 0}}}), 0,
      kRounding);
}

TEST(Region, OfACuboidHasTheVolumeThatPlanesLeave) {
  const BoxDomain box{{-1, 0, 2}, {1, 3, 6}, {}};
  EXPECT_NEAR(measure(box, std::vector<PlanePosition>{{{0, 0, 5}, {0, 0, -1}}}), 18, kRounding);
  // A corner with the edges 1, 1, 1 has the volume 1/6.
  EXPECT_NEAR(measure(box, std::vector<PlanePosition>{{{0, 0, 2}, unit({1, 1, 1})}}), 24 - 1.0 / 6,
              kRounding);
  EXPECT_NEAR(measure(box, std::vector<PlanePosition>{{{0, 1.5, 4}, unit({0.3, 0.8, -1})}}), 12,
              kRounding);
}

TEST(Region, OfADiscIsASegment) {
  const DiscDomain disc{{1, -2, 0}, 3};
  EXPECT_NEAR(measure(disc, std::vector<PlanePosition>{{{1, -2, 0}, unit({2, 1, 0})}}), 9 * pi / 2,
              kRounding * 10);
  // The segment of the height 3 - 1.2 that a plane at the distance 1.2 cuts off.
  const double off = 9 * std::acos(0.4) - 1.2 * std::sqrt(9 - 1.44);
  EXPECT_NEAR(measure(disc, std::vector<PlanePosition>{{{1, -3.2, 0}, {0, 1, 0}}}), 9 * pi - off,
              kRounding * 10);
  EXPECT_NEAR(
      measure(disc, std::vector<PlanePosition>{{{1, -2, 0}, {0, 1, 0}}, {{1, -2, 0}, {1, 0, 0}}}),
      9 * pi / 4, kRounding * 10);
  EXPECT_NEAR(measure(disc, std::vector<PlanePosition>{{{1, -9, 0}, {0, 1, 0}}}), 9 * pi,
              kRounding * 10);
  EXPECT_NEAR(measure(disc, std::vector<PlanePosition>{{{1, 9, 0}, {0, 1, 0}}}), 0, kRounding * 10);
}

TEST(Region, OfRandomPlanesContainsItsShareOfRandomPoints) {
  Random random(5);
  for (const int dimension : {2, 3})
    for (int n = 0; n < 6; ++n) {
      Domain domain = BoxDomain{{0, 0, 0}, {2, 3, dimension == 3 ? 1.5 : 0}, {}};
      if (dimension == 2 && n % 2 == 1) domain = DiscDomain{{1, 1.5, 0}, 1};
      std::vector<PlanePosition> planes;
      for (int k = 0; k < 3; ++k)
        planes.push_back({{random.uniform(0, 2), random.uniform(0, 3), random.uniform(0, 1.5)},
                          random.direction(dimension)});
      if (dimension == 2)
        for (auto& plane : planes) plane.point[2] = 0;
      constexpr int kPoints = 40000;
      int inside = 0;
      for (int i = 0; i < kPoints; ++i) {
        const Vector x{random.uniform(0, 2), random.uniform(0, 3),
                       dimension == 3 ? random.uniform(0, 1.5) : 0};
        bool is_in =
            !std::holds_alternative<DiscDomain>(domain) || norm(x - Vector{1, 1.5, 0}) <= 1;
        for (const auto& plane : planes) is_in = is_in && dot(plane.normal, x - plane.point) >= 0;
        inside += is_in ? 1 : 0;
      }
      const double whole = dimension == 3 ? 9 : 6;
      const double share = static_cast<double>(inside) / kPoints;
      // Five standard deviations of the share, and of one point.
      const double error = 5 * std::sqrt(share * (1 - share) / kPoints) + 5.0 / kPoints;
      EXPECT_NEAR(measure(domain, planes), share * whole, error * whole) << dimension << ' ' << n;
    }
}

}  // namespace
}  // namespace viscontact::particles
