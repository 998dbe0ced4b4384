// The operations of cone.hpp near the boundary of the cone, where differences of the components
// have no digits, against closed forms.
#include "viscontact/contact_solver/problem/cone.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "tests/common/random.hpp"

namespace viscontact::contact_solver {
namespace {

constexpr double kRounding = 1e-12;  // some thousand rounding errors

/// u and r on opposite sides of the cone, as those of a contact that slides. With their distances i
/// and j from the boundary and the angle t by which they miss opposite directions, u.r = i |r| + j
/// |u| + i j + |u| |r| (1 - cos t), where |u| and |r| are the distances from the axis.
TEST(SecondOrderCone, KeepsTheDigitsOfProductsNearTheBoundary) {
  Random random(1);
  for (int n = 0; n < 200; ++n) {
    SCOPED_TRACE(n);
    const double angle = random.uniform(0, 6), turned = random.uniform(0, 1e-9);
    const double u = random.decades(-2, 2), r = random.decades(-2, 2);
    // Near the central path i/u and j/r are of one size.
    const double share = random.decades(-15, 0);
    const double i = u * share, j = r * share * random.decades(-1, 1);
    const InnerPoint point{{u + i, u * std::cos(angle), u * std::sin(angle)}, i};
    const InnerPoint dual{{r + j, -r * std::cos(angle + turned), -r * std::sin(angle + turned)}, j};
    const double half = std::sin(turned / 2);
    const double product = i * r + j * u + i * j + 2 * u * r * half * half;
    const SecondOrderCone::Scaling scaling(point, dual);
    // Both angles are rounded by some 1e-16.
    constexpr double kAngle = 1e-14;
    EXPECT_NEAR(scaling.product_of_points(), product,
                kRounding * product + u * r * kAngle * (turned + kAngle));
    // W (W r) = u.
    const auto back = scaling.point(scaling.numbers_of_u());
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], point.x[k], kRounding * (u + i));
  }
}

/// A point that moves along the boundary, whose distance from it stays, and then across.
TEST(SecondOrderCone, KeepsTheDigitsOfTheDistanceFromTheBoundary) {
  InnerPoint u{{1 + 1e-14, 1, 0}, 1e-14};
  SecondOrderCone::move(u, 1, {0, -1e-9, std::sqrt(2e-9 - 1e-18)});
  // The root is rounded by 1e-16 of 4.5e-5, and changes the distance by 4.5e-5 times as much.
  EXPECT_NEAR(u.inside, 1e-14, 1e-24);
  SecondOrderCone::move(u, 0.5, {2e-14, 0, 0});
  EXPECT_NEAR(u.inside, 2e-14, 1e-24);
  EXPECT_NEAR(length_to_boundary(u, {-1e-14, 0, 0}), 2, 1e-9);
}

}  // namespace
}  // namespace viscontact::contact_solver
