// Linear flows over a step, by their exponentials and by quadrature.
#include "viscontact/suspensions/values/affine_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace viscontact::suspensions {
namespace {

constexpr Matrix kGeneral{Vector{0.3, 0.8, -0.2}, Vector{-0.1, 0.2, 0.5}, Vector{0.4, 0, -0.5}};
constexpr Vector kPoint{1, -2, 0.5}, kVelocity{-0.7, 0.4, 3};
constexpr double kTime = 0.6;
constexpr double kRounding = 1e-14;

void expect_near(const Vector& a, const Vector& b, double error) {
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(a[d], b[d], error);
}

/// The mean of f over 0 < s < t, by Gauss's rule with five points in each of four parts, whose
/// error, of the tenth order, is 1e-15 for rates of order one.
template <class Function>
Vector mean_over(double t, const Function& f) {
  const double inner = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3,
               outer = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
  const double most = (322 + 13 * std::sqrt(70)) / 900, least = (322 - 13 * std::sqrt(70)) / 900;
  const std::array<double, 5> at{-outer, -inner, 0, inner, outer},
      weights{least, most, 128.0 / 225, most, least};
  constexpr int kParts = 4;
  Vector sum{};
  for (int part = 0; part < kParts; ++part)
    for (std::size_t k = 0; k < at.size(); ++k)
      sum = sum + (weights[k] / (2 * kParts)) * f(t * (part + (1 + at[k]) / 2) / kParts);
  return sum;
}

TEST(AffineMotion, IsTheExponential) {
  const double c = std::cos(kTime), s = std::sin(kTime);
  const Matrix turn{Vector{0, -1, 0}, Vector{1, 0, 0}, Vector{}};
  expect_near(carried(turn, kTime, {1, 2, 3}), {c - 2 * s, s + 2 * c, 3}, kRounding);
  const Matrix extension{Vector{1, 0, 0}, Vector{0, -3, 0}, Vector{0, 0, 2}};
  expect_near(carried(extension, kTime, {1, 2, 3}),
              {std::exp(kTime), 2 * std::exp(-3 * kTime), 3 * std::exp(2 * kTime)}, kRounding);
  EXPECT_EQ(carried({Vector{0, 2, 0}, Vector{}, Vector{}}, 0.5, {1, 2, 3}), (Vector{3, 2, 3}));
  EXPECT_EQ(carried(kGeneral, 0, kPoint), kPoint);
}

TEST(AffineMotion, IsThatOfItsParts) {
  const Vector there = carried(kGeneral, kTime, kPoint);
  expect_near(carried(kGeneral, kTime / 3, carried(kGeneral, 2 * kTime / 3, kPoint)), there,
              kRounding);
  expect_near(carried(kGeneral, -kTime, there), kPoint, kRounding);
}

TEST(AffineMotion, HasTheMeanOverTheStep) {
  expect_near(mean_carried(kGeneral, kTime, kPoint),
              mean_over(kTime, [](double s) { return carried(kGeneral, s, kPoint); }), kRounding);
  // Without a flow, also.
  EXPECT_EQ(mean_carried({}, kTime, kPoint), kPoint);
}

TEST(AffineMotion, HasTheMeanOfThePath) {
  expect_near(mean_path(kGeneral, kTime, kPoint, kVelocity),
              mean_over(kTime,
                        [](double s) {
                          return carried(kGeneral, s, kPoint) +
                                 s * mean_carried(kGeneral, s, kVelocity);
                        }),
              kRounding);
  expect_near(mean_path({}, kTime, kPoint, kVelocity), kPoint + (kTime / 2) * kVelocity, kRounding);
}

TEST(AffineMotion, HasMatrices) {
  for (const auto map : {carried, mean_carried})
    expect_near(times(matrix_of(map, kGeneral, kTime), kPoint), map(kGeneral, kTime, kPoint),
                kRounding);
}

}  // namespace
}  // namespace viscontact::suspensions
