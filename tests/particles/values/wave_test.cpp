// Waves, and the strain of flows that change in time.
#include "viscontact/particles/values/wave.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "viscontact/particles/setting/pair_lubrication.hpp"

namespace viscontact::particles {
namespace {

// Over so many pieces the trapezoidal rule has an error of 1e-9 of these waves.
template <class Function>
double integral(double from, double to, const Function& function) {
  constexpr int kPieces = 200000;
  const double h = (to - from) / kPieces;
  double sum = (function(from) + function(to)) / 2;
  for (int k = 1; k < kPieces; ++k) sum += function(from + k * h);
  return h * sum;
}

const Wave kWaves[] = {{0, 2, 3, 0},      {0, -2, 3, 1}, {0.5, 2, 3, -4},
                       {-1.5, 2, 0.7, 9}, {3, 2, 3, 1},  {-2, 2, 3, 1}};

TEST(Wave, HasExactMeans) {
  for (const auto& wave : kWaves)
    for (const double to : {1.1, 1.2, 7.0})
      EXPECT_NEAR(wave.mean_over(1, to) * (to - 1),
                  integral(1, to, [&](double t) { return wave.value(t); }), 1e-8);
}

TEST(Wave, IsZeroWhereRoundingErrorsAreLeft) {
  const Wave wave{0, 1, 2 * std::numbers::pi, 0};
  for (int n = 0; n < 50; ++n) {
    EXPECT_EQ(wave.value(n / 2.0), 0);
    EXPECT_EQ(wave.mean_over(n / 2.0 - 0.1, n / 2.0 + 0.1), 0);
    EXPECT_EQ(wave.mean_over(n, n + 1), 0);
  }
}

TEST(Wave, KnowsThePathAndItsTime) {
  for (const auto& wave : kWaves) {
    for (const double t : {0.0, 0.01, 0.5, 1.0, 2.0, 3.3, 20.0})
      EXPECT_NEAR(wave.path_until(t),
                  integral(0, t, [&](double s) { return std::abs(wave.value(s)); }), 2e-6);
    for (const double path : {0.001, 0.5, 3.0, 40.0})
      EXPECT_NEAR(wave.path_until(wave.time_of_path(path)), path, 1e-12 * path + 1e-14);
  }
}

TEST(Wave, HasTheMeanOfItsMagnitude) {
  for (const auto& wave : kWaves) {
    // Steps with and without a change of the sign, and one of more than a period.
    for (int n = 0; n < 40; ++n)
      EXPECT_NEAR(0.1 * wave.mean_magnitude_over(0.1 * n, 0.1 * (n + 1)),
                  wave.path_until(0.1 * (n + 1)) - wave.path_until(0.1 * n), 1e-9);
    EXPECT_NEAR(19 * wave.mean_magnitude_over(1, 20), wave.path_until(20) - wave.path_until(1),
                1e-9);
  }
  // The same bits where the sign stays.
  const Wave wave{0, 2, 3, 0};
  EXPECT_EQ(wave.mean_magnitude_over(0.7, 0.8), wave.mean_over(0.7, 0.8));
}

TEST(Wave, HasTheLeastAndTheLargestIntegral) {
  for (const auto& wave : kWaves) {
    const auto [least, largest] = wave.integrals();
    double low = 0, high = 0;
    for (int n = 0; n <= 10000; ++n) {
      const double t = 0.001 * n;
      const double sum = t > 0 ? t * wave.mean_over(0, t) : 0;
      low = std::min(low, sum);
      high = std::max(high, sum);
    }
    // The samples miss an extreme by at most half of a slope of 6 times the square of half a step.
    if (wave.mean <= 0) {
      EXPECT_NEAR(largest, high, 1e-6);
    }
    if (wave.mean >= 0) {
      EXPECT_NEAR(least, low, 1e-6);
    }
    EXPECT_EQ(std::isinf(largest), wave.mean > 0);
    EXPECT_EQ(std::isinf(least), wave.mean < 0);
  }
}

FlowPiece shear_until(double until, double rate) {
  FlowPiece piece;
  piece.until = until;
  piece.gradient[0][1] = rate;
  return piece;
}

TEST(FlowInTime, HasTheStrainOfItsPieces) {
  PairLubrication flow;
  flow.gradient[0][1] = 2;
  EXPECT_DOUBLE_EQ(time_of_strain(flow, 5), 2.5);
  flow.pieces = {shear_until(1, 2), shear_until(3, 0), shear_until(4, -4), shear_until(5, 1)};
  EXPECT_DOUBLE_EQ(time_of_strain(flow, 1), 0.5);
  EXPECT_DOUBLE_EQ(time_of_strain(flow, 4), 3.5);
  // The last piece holds for ever.
  EXPECT_DOUBLE_EQ(time_of_strain(flow, 10), 8);
  EXPECT_EQ(flow.flow_at(100).gradient[0][1], 1);
  EXPECT_EQ(flow.flow_at(3).gradient[0][1], -4);
  EXPECT_DOUBLE_EQ(largest_rate_of_strain(flow), 4);
  flow.pieces.back().gradient[0][1] = 0;
  EXPECT_EQ(time_of_strain(flow, 10), std::numeric_limits<double>::infinity());
  flow.pieces.clear();
  flow.wave = Wave{0, 3, 2, 0};
  // Each period of pi has the path 4 amplitude/frequency.
  EXPECT_NEAR(time_of_strain(flow, 2 * 5 * 6), 5 * std::numbers::pi, 1e-9);
  EXPECT_DOUBLE_EQ(largest_rate_of_strain(flow), 6);
}

constexpr Gradient kPlanar{Vector{1, 0, 0}, Vector{0, -1, 0}, Vector{0, 0, 0}};

Gradient times(double factor, Gradient gradient) {
  for (auto& row : gradient) row = factor * row;
  return gradient;
}

PairLubrication extension(std::vector<FlowPiece> pieces) {
  PairLubrication flow;
  flow.gradient = pieces.front().gradient;
  if (pieces.size() > 1) flow.pieces = std::move(pieces);
  return flow;
}

TEST(FlowPath, GoesAlongTheFartherNetStrain) {
  const auto expect_path = [](const PairLubrication& flow, double sense, double lowest) {
    const auto path = path_of(flow);
    EXPECT_EQ(path.sign, sense);
    // The mean 1e-9 of a wave below changes it by this much.
    EXPECT_NEAR(path.lowest, lowest, 2e-9);
    EXPECT_NEAR(signed_rate_of_strain(path.direction), sense, 1e-15);
    EXPECT_EQ(path.direction, times(sense / 2, kPlanar));
  };
  expect_path(extension({{1, kPlanar, {}}}), 1, 0);
  expect_path(extension({{1, times(-3, kPlanar), {}}}), -1, 0);
  const auto back = times(-0.5, kPlanar);
  // The rate of strain of kPlanar is 2.
  expect_path(extension({{0.2, kPlanar, {}}, {9, back, {}}}), -1, -0.4);
  expect_path(extension({{0.1, back, {}}, {0.3, {}, {}}, {9, kPlanar, {}}}), 1, -0.1);
  auto wave = extension({{1, kPlanar, {}}});
  wave.wave = Wave{0, 3, 2, 0};
  expect_path(wave, 1, 0);
  wave.wave = Wave{0, -3, 2, 0};
  expect_path(wave, -1, 0);
  wave.gradient = times(-1, kPlanar);
  expect_path(wave, 1, 0);
  // sin(2 t) falls below 0 by 2 (1 - cos(1))/2 from the phase -1 on.
  wave.gradient = kPlanar;
  wave.wave = Wave{1e-9, 1, 2, -1};
  expect_path(wave, 1, -1 + std::cos(1.0));
  wave.wave = Wave{-0.5, 0.1, 5, 0};
  expect_path(wave, -1, 0);
}

TEST(FlowPath, HasNoDirectionOfGradientsThatAreNoMultiples) {
  const Gradient uniaxial{Vector{1, 0, 0}, Vector{0, -0.5, 0}, Vector{0, 0, -0.5}};
  const Gradient rotation{Vector{0, -1, 0}, Vector{1, 0, 0}, Vector{}};
  for (const auto& flow : {extension({{1, kPlanar, {}}, {2, uniaxial, {}}}),
                           extension({{1, {}, {}}}), extension({{1, rotation, {}}})}) {
    EXPECT_EQ(path_of(flow).direction, Gradient{});
    EXPECT_EQ(path_of(flow).lowest, 0);
  }
}

TEST(AccelerationOfTheFluid, IsThatOfImagesInAConstantShear) {
  const auto box = [](bool x, bool y, bool z) {
    return BoxDomain{{0, 0, 0}, {1, 1, 1}, {x, y, z}};
  };
  PairLubrication flow;
  EXPECT_TRUE(accelerates_images_alike(flow, box(true, true, true)));
  flow.gradient[0][1] = 2;
  EXPECT_TRUE(accelerates_images_alike(flow, box(true, true, true)));
  for (const bool is_wave : {true, false}) {
    auto changing = flow;
    if (is_wave)
      changing.wave = Wave{0, 1, 1, 0};
    else
      changing.pieces = {shear_until(1, 2), shear_until(2, -2)};
    EXPECT_FALSE(accelerates_images_alike(changing, box(true, true, true)));
    // The fluid is the same at images along x and z.
    EXPECT_TRUE(accelerates_images_alike(changing, box(true, false, true)));
    EXPECT_TRUE(accelerates_images_alike(changing, {}));
  }
  flow.pieces = {shear_until(1, 2), shear_until(2, 2)};
  EXPECT_TRUE(accelerates_images_alike(flow, box(true, true, true)));
  auto strain = extension({{1, kPlanar, {}}});
  EXPECT_FALSE(accelerates_images_alike(strain, box(true, true, true)));
  EXPECT_TRUE(accelerates_images_alike(strain, {}));
  // A shear across any plane: (0.6, 0.8, 0) (-0.8, 0.6, 0).
  strain.gradient = {Vector{-0.48, 0.36, 0}, Vector{-0.64, 0.48, 0}, Vector{}};
  EXPECT_TRUE(accelerates_images_alike(strain, box(true, true, true)));
}

}  // namespace
}  // namespace viscontact::particles
