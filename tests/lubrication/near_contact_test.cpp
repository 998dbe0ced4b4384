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

/// The sphere's own factors are those of Reynolds' equation, from which leading_factors() comes.
TEST(LeadingLoads, AreThoseOfReynoldsEquation) {
  for (const double curvature : {0.0, 0.2, 1.0, 2.5})
    for (const auto motion : {MotionKind::kSlide, MotionKind::kRoll, MotionKind::kSpin}) {
      const auto theory = leading_factors(motion, {curvature});
      const auto loads = leading_loads(motion, curvature);
      EXPECT_NEAR(loads.sphere.torque.value(), theory.torque, 1e-15) << curvature;
      EXPECT_NEAR(loads.sphere.force.value_or(0), theory.force, 1e-15) << curvature;
      EXPECT_EQ(loads.neighbour.torque.has_value(), curvature > 0);
    }
  // The squeezing of a film by the radius r_eff: 1/(1 + curvature)^2. Its force acts at the pole,
  // so that S_zz = (2/3) r |F|.
  const auto approach = leading_loads(MotionKind::kApproach, 0.5);
  EXPECT_NEAR(approach.sphere.force.value(), 4. / 9, 1e-15);
  EXPECT_NEAR(approach.neighbour.force.value(), -4. / 9, 1e-15);
  EXPECT_NEAR(20. / 3 * approach.sphere.stresslet.value(), 2. / 3 * 6 * 4. / 9, 1e-14);
  EXPECT_NEAR(20. / 3 * approach.neighbour.stresslet.value(), 2 * 2. / 3 * 6 * 4. / 9, 1e-14);
  EXPECT_FALSE(approach.sphere.torque);
  EXPECT_FALSE(leading_loads(MotionKind::kSpin, 1).sphere.force);
}

/// By the reciprocal theorem the force by a strain e is -E:S/e of the motion at velocity 1.
TEST(LeadingLoads, OfStrainsAreThoseOfMotionsByReciprocity) {
  for (const double curvature : {0.0, 0.2, 1.0, 2.5}) {
    const auto approach = leading_loads(MotionKind::kApproach, curvature).sphere,
               axial = leading_loads(MotionKind::kAxialStrain, curvature).sphere;
    EXPECT_NEAR(6 * axial.force.value(), 1.5 * 20 / 3 * approach.stresslet.value(), 1e-14);
    const auto slide = leading_loads(MotionKind::kSlide, curvature).sphere,
               roll = leading_loads(MotionKind::kRoll, curvature).sphere,
               shear = leading_loads(MotionKind::kShearStrain, curvature).sphere;
    EXPECT_NEAR(6 * shear.force.value(), 2. * 20 / 3 * slide.stresslet.value(), 1e-14);
    EXPECT_NEAR(8 * shear.torque.value(), 2. * 20 / 3 * roll.stresslet.value(), 1e-14);
  }
}

}  // namespace
}  // namespace viscontact::lubrication
