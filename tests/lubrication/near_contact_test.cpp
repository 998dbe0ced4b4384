// Theory's coefficients near contact beside published ones.
#include "viscontact/lubrication/near_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace viscontact::lubrication {
namespace {

TEST(NearContact, OfAPlaneIsThatOfGoldmanCoxAndBrenner) {
  const auto slide = leading_factors(MotionKind::kSlide, {});
  EXPECT_EQ(slide.term, "ln q");
  EXPECT_NEAR(slide.force, -8. / 15, 1e-15);
  EXPECT_NEAR(slide.torque, 1. / 10, 1e-15);
  const auto roll = leading_factors(MotionKind::kRoll, {});
  EXPECT_NEAR(roll.force, 2. / 15, 1e-15);
  EXPECT_NEAR(roll.torque, -2. / 5, 1e-15);
  const auto spin = leading_factors(MotionKind::kSpin, {});
  EXPECT_EQ(spin.term, "q ln q");
  EXPECT_NEAR(spin.torque, 1. / 2, 1e-15);
}

TEST(NearContact, OfTwoSpheresIsThatOfJeffreyAndOnishi) {
  for (const double l : {0.3, 1.0, 2.0, 7.0}) {  // the neighbour's radius
    SCOPED_TRACE(l);
    const NeighbourSurface sphere = {1 / l, false, 0};
    const auto slide = leading_factors(MotionKind::kSlide, sphere);
    const auto roll = leading_factors(MotionKind::kRoll, sphere);
    const auto spin = leading_factors(MotionKind::kSpin, sphere);
    // The coefficients g2 of Y11^A, Y11^B and Y11^C, and that of xi ln(xi) in X11^C, with
    // xi = 2 q / (1 + l). Y^B is in units of 4 pi mu r^2.
    EXPECT_NEAR(slide.force, -4. / 15 * l * (2 + l + 2 * l * l) / std::pow(1 + l, 3), 1e-14);
    EXPECT_NEAR(slide.torque, 1. / 10 * l * (4 + l) / std::pow(1 + l, 2), 1e-14);
    EXPECT_NEAR(roll.torque, -2. / 5 * l / (1 + l), 1e-14);
    EXPECT_NEAR(spin.torque, l * l / (4 * (1 + l)) * 2 / (1 + l), 1e-14);
    // The matrix is symmetric.
    EXPECT_NEAR(8 * slide.torque, 6 * roll.force, 1e-14);
  }
}

TEST(NearContact, IsRegularIfBothSpheresMoveAsOneBody) {
  const auto slide = leading_factors(MotionKind::kSlide, {0.5, false, 1});
  EXPECT_EQ(slide.force, 0);
  EXPECT_EQ(slide.torque, 0);
  EXPECT_EQ(leading_factors(MotionKind::kSpin, {0.5, false, 1}).torque, 0);
}

TEST(NearContact, OfAFreeSurfaceIsThatOfASphereAndItsMirrorImage) {
  const NeighbourSurface surface = {0, true, 0};
  const auto slide = leading_factors(MotionKind::kSlide, surface);
  const auto alike = leading_factors(MotionKind::kSlide, {1, false, 1});
  EXPECT_EQ(slide.force, alike.force);
  const auto roll = leading_factors(MotionKind::kRoll, surface);
  const auto opposite = leading_factors(MotionKind::kRoll, {1, false, -1});
  EXPECT_NEAR(roll.torque, opposite.torque, 1e-15);
  EXPECT_NEAR(roll.torque, -3. / 20, 1e-15);
}

}  // namespace
}  // namespace viscontact::lubrication
