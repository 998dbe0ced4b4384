// The curve through the beads of a membrane: lengths, area, bending energy and its derivatives.
#include "viscontact/membranes/membrane_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

Eigen::VectorXd circle(int beads, double radius) {
  Eigen::VectorXd positions(2 * beads);
  for (int k = 0; k < beads; ++k) {
    positions(k) = 3 + radius * std::cos(kTwoPi * k / beads);
    positions(beads + k) = -2 + radius * std::sin(kTwoPi * k / beads);
  }
  return positions;
}

/// A closed curve without any symmetry.
Eigen::VectorXd wavy(int beads) {
  Eigen::VectorXd positions(2 * beads);
  for (int k = 0; k < beads; ++k) {
    const double s = kTwoPi * k / beads;
    const double r = 1 + 0.2 * std::cos(2 * s + 0.3) + 0.1 * std::sin(3 * s);
    positions(k) = r * std::cos(s + 0.1 * std::sin(s));
    positions(beads + k) = 0.7 * r * std::sin(s + 0.1 * std::sin(s));
  }
  return positions;
}

class OfBeads : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(EvenAndOdd, OfBeads, ::testing::Values(12, 13, 48));

TEST_P(OfBeads, ACircleHasItsPerimeterAreaAndEnergy) {
  const MembraneCurve curve(GetParam());
  for (const double radius : {1e-3, 2.0, 1e4}) {
    const auto x = circle(GetParam(), radius);
    EXPECT_NEAR(curve.perimeter(x) / (kTwoPi * radius), 1, 1e-12 * std::max(1.0, 1 / radius));
    EXPECT_NEAR(curve.area(x) / (std::numbers::pi * radius * radius), 1,
                1e-12 / std::min(1.0, radius * radius));
    // (1/2) curvature^2 perimeter. Rounding errors of second derivatives are those of positions
    // times N^2/4, and of the offset (3, -2) over the radius.
    EXPECT_NEAR(curve.bending_energy(x) * radius / std::numbers::pi, 1,
                1e-12 * std::max(1.0, 4 / radius) * GetParam() * GetParam());
  }
}

TEST_P(OfBeads, DerivativesAreThoseOfDifferences) {
  const int n = GetParam();
  const MembraneCurve curve(n);
  const auto x = wavy(n);
  // Central differences: truncation grows as step^2 and rounding as 1e-16/step; both are below 1e-7
  // of derivatives that grow as n^2 (gradient) and n^4 (Hessian).
  constexpr double kStep = 1e-5;
  const auto gradient = curve.bending_gradient(x);
  const auto hessian = curve.bending_hessian(x);
  const auto rows = curve.speed_rows(x);
  const auto area_row = curve.area_row(x);
  const Eigen::VectorXd factors = Eigen::VectorXd::LinSpaced(n, -1, 2);
  const auto of_factors = curve.speeds_hessian(x, factors);
  for (int i = 0; i < 2 * n; ++i) {
    Eigen::VectorXd up = x, down = x;
    up(i) += kStep;
    down(i) -= kStep;
    const double of_energy = (curve.bending_energy(up) - curve.bending_energy(down)) / (2 * kStep);
    EXPECT_NEAR(of_energy, gradient(i), 1e-6 * gradient.cwiseAbs().maxCoeff());
    const Eigen::VectorXd of_gradient =
        (curve.bending_gradient(up) - curve.bending_gradient(down)) / (2 * kStep);
    EXPECT_LT((of_gradient - hessian.col(i)).lpNorm<Eigen::Infinity>(),
              1e-5 * hessian.cwiseAbs().maxCoeff());
    const Eigen::VectorXd of_speeds = (curve.speeds(up) - curve.speeds(down)) / (2 * kStep);
    EXPECT_LT((of_speeds - rows.col(i)).lpNorm<Eigen::Infinity>(), 1e-8 * n);
    const Eigen::VectorXd of_rows =
        (curve.speed_rows(up) - curve.speed_rows(down)).transpose() * factors / (2 * kStep);
    EXPECT_LT((of_rows - of_factors.col(i)).lpNorm<Eigen::Infinity>(),
              1e-6 * of_factors.cwiseAbs().maxCoeff());
    EXPECT_NEAR((curve.area(up) - curve.area(down)) / (2 * kStep), area_row(i), 1e-9);
  }
  EXPECT_LT((hessian - hessian.transpose()).cwiseAbs().maxCoeff(),
            1e-13 * hessian.cwiseAbs().maxCoeff());
}

TEST_P(OfBeads, EnergyDoesNotChangeWithPlaceAndDirection) {
  const int n = GetParam();
  const MembraneCurve curve(n);
  const auto x = wavy(n);
  const double c = std::cos(1.1), s = std::sin(1.1);
  Eigen::VectorXd turned(2 * n);
  turned.head(n) = (c * x.head(n) - s * x.tail(n)).array() + 5;
  turned.tail(n) = (s * x.head(n) + c * x.tail(n)).array() - 7;
  EXPECT_NEAR(curve.bending_energy(turned) / curve.bending_energy(x), 1, 1e-11);
  EXPECT_NEAR(curve.area(turned) / curve.area(x), 1, 1e-13);
  // No force and no torque on the whole membrane.
  const auto gradient = curve.bending_gradient(x);
  const double size = gradient.cwiseAbs().maxCoeff();
  EXPECT_NEAR(gradient.head(n).sum(), 0, 1e-10 * size);
  EXPECT_NEAR(gradient.tail(n).sum(), 0, 1e-10 * size);
  EXPECT_NEAR(x.head(n).dot(gradient.tail(n)) - x.tail(n).dot(gradient.head(n)), 0, 1e-10 * size);
}

// An ellipse of semi-axes a, b and angle t has the bending energy (a b)^2/2 times the integral of
// (a^2 sin^2 + b^2 cos^2)^(-5/2), which the trapezoidal rule gives to rounding. Interpolation
// converges exponentially: each doubling of the beads squares the error.
TEST(MembraneCurve, EnergyOfAnEllipseConverges) {
  const double a = 1.3, b = 0.9;
  double exact = 0;
  for (int i = 0; i < 4000; ++i) {
    const double t = kTwoPi * i / 4000,
                 q = std::pow(a * std::sin(t), 2) + std::pow(b * std::cos(t), 2);
    exact += kTwoPi / 4000 * 0.5 * a * a * b * b * std::pow(q, -2.5);
  }
  const auto error = [&](int n) {
    // Unevenly spaced beads: the parameter is no angle.
    Eigen::VectorXd positions(2 * n);
    for (int k = 0; k < n; ++k) {
      const double s = kTwoPi * k / n, t = s + 0.2 * std::sin(s);
      positions(k) = a * std::cos(t);
      positions(n + k) = b * std::sin(t);
    }
    return std::abs(MembraneCurve(n).bending_energy(positions) / exact - 1);
  };
  EXPECT_LT(error(12), 2e-2);
  EXPECT_LT(error(24), 1e-4);
  EXPECT_LT(error(48), 1e-8);
}

/// A membrane of 48 beads, the first particles.
Membrane membrane_of(double reduced_area) {
  Membrane membrane;
  membrane.set_beads(0, 48);
  membrane.perimeter = 7;
  membrane.area = reduced_area * 49 / (4 * std::numbers::pi);
  return membrane;
}

/// Beads with these centres and velocities, two numbers for each.
Particles beads_at(const std::vector<double>& places, const std::vector<double>& velocities) {
  Particles beads;
  beads.dimension = 2;
  beads.positions = places;
  beads.velocities = velocities;
  beads.radii.assign(places.size() / 2, 0.05);
  return beads;
}

class OfReducedArea : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(All, OfReducedArea, ::testing::Values(0.5, 0.7, 0.9, 0.99));

TEST_P(OfReducedArea, AnEllipseHasItsLengthsAreaCentreAndInclination) {
  const auto membrane = membrane_of(GetParam());
  const auto places = ellipse_of(membrane, {1, -2, 0}, 0.4);
  ASSERT_TRUE(places);
  const std::vector<double> at_rest(places->size(), 0);
  const auto measures = measure(membrane, beads_at(*places, at_rest));
  EXPECT_NEAR(measures.perimeter, 7, 1e-11);
  EXPECT_NEAR(measures.area / membrane.area, 1, 1e-11);
  EXPECT_NEAR(measures.x, 1, 1e-9);
  EXPECT_NEAR(measures.y, -2, 1e-9);
  // The beads are moved from the ellipse, the more the flatter it is.
  EXPECT_NEAR(measures.inclination, 0.4, 1e-4);
  EXPECT_EQ(measures.membrane_speed, 0);
}

// A rigid rotation turns the shape with the membrane, so that the membrane does not go around it.
TEST(Measures, ARigidRotationIsNoTankTreading) {
  const auto membrane = membrane_of(0.8);
  const auto places = *ellipse_of(membrane, {0, 0, 0}, 0.4);
  std::vector<double> velocities;
  for (std::size_t k = 0; k < places.size(); k += 2) {
    velocities.push_back(5 - 0.3 * places[k + 1]);
    velocities.push_back(2 + 0.3 * places[k]);
  }
  EXPECT_NEAR(measure(membrane, beads_at(places, velocities)).tank_treading_frequency, 0, 1e-9);
}

TEST(Shapes, CrossOrContainEachOther) {
  const std::vector<double> square = {0, 0, 2, 0, 2, 2, 0, 2}, inside = {0.5, 0.5, 1, 0.5, 1, 1},
                            beside = {3, 0, 4, 0, 4, 1}, across = {1, 1, 3, 1, 3, 1.5};
  EXPECT_TRUE(do_contain(square, inside));
  EXPECT_TRUE(do_contain(inside, square));
  EXPECT_FALSE(do_contain(square, beside));
  EXPECT_FALSE(do_cross(square, inside));
  EXPECT_TRUE(do_cross(square, across));
  EXPECT_FALSE(do_cross(square, beside));
}

}  // namespace
}  // namespace viscontact::particles
