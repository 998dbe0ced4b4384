// Integrals of exact resistances to squeezing.
#include "viscontact/lubrication/pairs/squeeze_film.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "tests/oracles/bispherical/squeeze.hpp"
#include "tests/oracles/discs/discs_in_stokes_flow.hpp"
#include "viscontact/lubrication/pairs/pair_resistance.hpp"
#include "viscontact/lubrication/plane_drag.hpp"

namespace viscontact::lubrication {
namespace {

using std::numbers::pi;
constexpr double kPlane = std::numeric_limits<double>::infinity();

/// Simpson's rule in ln q, in which resistances are smooth.
template <class Resistance>
double integral(const Resistance& resistance, double from, double to, int parts) {
  const double width = std::log(to / from) / parts;
  double sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const double q = from * std::exp(i * width);
    sum += (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2) * resistance(q) * q;
  }
  return sum * width / 3;
}

TEST(SqueezeFilm, OfARoughSphereAboveAPlane) {
  // The roughness 0.005 and the threshold 0.1: the exact drag gives -138.3 where 1/q alone gives
  // -130.2 = 18 pi ln 0.1.
  const double gamma_min = -3 * sphere_squeeze_integral(1, kPlane, 0.01, 0.1);
  EXPECT_NEAR(gamma_min, -138.3, 0.05);
  const double expected =
      -3 * integral([](double q) { return 6 * pi * plane_drag_factor(q); }, 0.01, 0.1, 200);
  EXPECT_NEAR(gamma_min, expected, 1e-9 * std::abs(expected));
}

/// Two spheres and a sphere in a round wall, with the exact series.
TEST(SqueezeFilm, OfSpheresIsTheExactOne) {
  double worst = 0, worst_far = 0;
  for (const double ratio : {0.07, 0.55, 1.0, -0.013, -0.3, -0.9})
    for (const double top : {0.01, 0.1, 1.0, 9.0}) {
      // The larger radius is 1.
      const double r = std::abs(ratio), neighbour = ratio < 0 ? -1 : 1;
      const double r_eff = effective_radius(r, neighbour);
      const double unit = ratio < 0 ? (1 + ratio) * (1 + ratio) : 1, width = unit * r_eff;
      if (ratio < 0 && top * r > 1) continue;
      const auto exact = [&](double q) {
        return 6 * pi * r_eff * exact_squeeze(ratio, q / width) / unit;
      };
      const double from = 1e-3 * width, to = top * width;
      // Simpson's rule with 20 parts for a factor of 10 is exact to 1e-6.
      const double expected = integral(exact, from, to, 20 * static_cast<int>(3 + std::log10(top)));
      const double error = std::abs(sphere_squeeze_integral(r, neighbour, from, to) / expected - 1);
      (top <= 1 ? worst : worst_far) = std::max(top <= 1 ? worst : worst_far, error);
      EXPECT_EQ(
          sphere_squeeze_integral(r, neighbour, from, to),
          sphere_squeeze_integral(ratio < 0 ? r : neighbour, ratio < 0 ? neighbour : r, from, to));
      EXPECT_DOUBLE_EQ(sphere_squeeze_integral(r, neighbour, to, from),
                       -sphere_squeeze_integral(r, neighbour, from, to));
    }
  EXPECT_LT(worst, 1e-5);
  EXPECT_LT(worst_far, 1e-4);
}

TEST(SqueezeFilm, OfSpheresHasNoNetForce) {
  // R by the matrix of the pair, whose error is 3e-6 of K_11 and K_22. The integral has errors of
  // 1e-5, and its derivative has 4e-5.
  for (const double ratio : {1.0, 2.5, 9.0})
    for (const double gap : {1e-4, 0.02, 0.7, 4.0}) {
      const auto matrix = pair_resistance(1, ratio, gap, 1);
      const double k11 = matrix[2 * 22 + 2], k12 = matrix[2 * 22 + 13], k22 = matrix[13 * 22 + 13];
      const double expected = (k11 * k22 - k12 * k12) / (k11 + k22 + 2 * k12);
      const double step = 1e-3;
      const double found =
          sphere_squeeze_integral(1, ratio, gap * std::exp(-step), gap * std::exp(step)) /
          (2 * std::sinh(step) * gap);
      EXPECT_NEAR(found / expected, 1, 5e-5) << ratio << ' ' << gap;
    }
}

TEST(SqueezeFilm, GoesOnToThePlane) {
  for (const SqueezeIntegral integral : {sphere_squeeze_integral, disc_squeeze_integral}) {
    // The table of spheres has errors of 1e-6 on both sides; a curvature of 1e-7 changes less.
    const double plane = integral(1, kPlane, 1e-3, 0.3);
    EXPECT_NEAR(integral(1, 1e7, 1e-3, 0.3) / plane, 1, 2e-6);
    EXPECT_NEAR(integral(1, -1e7, 1e-3, 0.3) / plane, 1, 2e-6);
  }
}

double resistance_of_discs(double r, double neighbour, double q) {
  const double s = std::acosh(1 + q / effective_radius(r, neighbour) + q * q / (2 * r * neighbour));
  return 4 * pi / (s - std::tanh(s));
}

TEST(SqueezeFilm, OfDiscsIsTheExactOne) {
  for (const double neighbour : {kPlane, 1.0, 0.04, 7.0, -1.1, -3.0, -40.0})
    for (const auto& [from, to] : {std::pair(1e-3, 0.03), {0.01, 0.09}, {0.05, 50.0}}) {
      if (neighbour < 0 && to > -neighbour - 1) continue;
      const auto exact = [&](double q) { return resistance_of_discs(1, neighbour, q); };
      const double expected = integral(exact, from, to, 40000);
      EXPECT_NEAR(disc_squeeze_integral(1, neighbour, from, to) / expected, 1, 1e-12)
          << neighbour << ' ' << from;
    }
}

TEST(SqueezeFilm, OfDiscsMovesThemAsCollocationDoes) {
  // A disc that a force moves in a round container towards the wall.
  DiscProblem in_wall;
  in_wall.size = 3;
  for (const double gap : {0.3, 1.0, 1.9}) {
    in_wall.discs = {{.centre = {2 - gap, 0}, .radius = 1, .force = {1, 0}}};
    const auto velocity = discs_by_collocation(in_wall, 40, 40).velocities[0].real();
    EXPECT_NEAR(1 / velocity / resistance_of_discs(1, -3, gap), 1, 1e-8) << gap;
  }
  // Two discs that forces press together, far from a container, which has an influence of 1e-6.
  DiscProblem two;
  two.size = 2000;
  two.discs = {{.centre = {-1.25, 0}, .radius = 1, .force = {1, 0}},
               {.centre = {0.5, 0}, .radius = 0.5, .force = {-1, 0}}};
  const auto answer = discs_by_collocation(two, 40, 10);
  const double closing = (answer.velocities[0] - answer.velocities[1]).real();
  EXPECT_NEAR(1 / closing / resistance_of_discs(1, 0.5, 0.25), 1, 1e-5);
}

TEST(SqueezeFilm, IsKnownFromItsImpulse) {
  std::mt19937_64 random(5);
  const auto decades = [&](double from, double to) {
    return std::pow(10, std::uniform_real_distribution(from, to)(random));
  };
  for (int i = 0; i < 200; ++i)
    for (const auto integral : {sphere_squeeze_integral, disc_squeeze_integral}) {
      const double unit = decades(-50, 50), r = unit * decades(-2, 2);
      const double neighbour = i % 3 == 0 ? kPlane : i % 3 == 1 ? unit : -100.1 * unit;
      const double width = std::min(r, std::abs(neighbour));
      const double gap = width * decades(-9, -3), from = width * decades(-3, -0.5);
      const double value = integral(r, neighbour, gap, from);
      EXPECT_NEAR(gap_of_squeeze(integral, r, neighbour, from, value) / gap, 1, 1e-12);
      EXPECT_NEAR(integral(r * 7, neighbour * 7, gap * 7, from * 7),
                  value * (integral == sphere_squeeze_integral ? 49 : 7), 1e-12 * 49 * value);
    }
  EXPECT_EQ(gap_of_squeeze(sphere_squeeze_integral, 1, kPlane, 0.1, 0), 0.1);
}

TEST(SqueezeFilm, EndsInTheMiddleOfARoundWall) {
  for (const auto integral : {sphere_squeeze_integral, disc_squeeze_integral}) {
    EXPECT_EQ(integral(1, -1.5, 0.01, 0.5), integral(1, -1.5, 0.01, 3));
    EXPECT_EQ(integral(1, -1.5, 0.6, 3), 0);
    EXPECT_EQ(integral(1, -1, 0.01, 0.5), kPlane);
  }
}

}  // namespace
}  // namespace viscontact::lubrication
