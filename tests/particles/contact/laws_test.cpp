// Each contact law by itself, against its equations.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "viscontact/lubrication/pairs/squeeze_film.hpp"
#include "viscontact/lubrication/plane_drag.hpp"
#include "viscontact/particles/contact/contact_laws.hpp"

namespace viscontact::particles {
namespace {

using std::numbers::pi;

/// Integral of `f` from `a` to `b`, both > 0, by Simpson's rule in the logarithm.
template <class F>
double integral(const F& f, double a, double b) {
  constexpr int kParts = 20000;
  const double from = std::log(a), width = (std::log(b) - from) / kParts;
  double sum = 0;
  for (int i = 0; i <= kParts; ++i) {
    const double x = std::exp(from + i * width);
    sum += (i == 0 || i == kParts ? 1 : i % 2 == 1 ? 4 : 2) * f(x) * x;
  }
  return sum * width / 3;
}

TEST(FilmLaw, GivesWayAfterTheIntegralOfTheResistance) {
  // Beside another particle, at a plane, inside a circle; the film begins at q0 or at r_eff.
  const double mu = 0.7, r = 1.3;
  for (const double other : {0.4, std::numeric_limits<double>::infinity(), -5.0})
    for (const auto shape : {FilmShape::kSpheres, FilmShape::kDiscs})
      for (const double q0 : {0.0, 0.1 * r, 2 * r}) {
        FilmLaw law;
        law.viscosity = mu;
        law.roughness = 1e-3;
        law.shape = shape;
        if (q0 > 0) law.begins_at = q0;
        const double r_eff = 1 / (1 / r + 1 / other);
        const auto resistance = [&](double q) {
          if (shape == FilmShape::kSpheres)
            return 6 * pi * mu * r * lubrication::plane_drag_factor(q / r);
          const double s = std::acosh(1 + q / r_eff + q * q / (2 * r * other));
          return 4 * pi * mu / (s - std::tanh(s));
        };
        const double begin = q0 > 0 ? q0 : r_eff;
        // The oracles of spheres beside spheres are in tests/lubrication.
        const double expected =
            shape == FilmShape::kSpheres && std::isfinite(other)
                ? -mu * lubrication::sphere_squeeze_integral(r, other, 2e-3, begin)
                : -integral(resistance, 2e-3, begin);
        EXPECT_NEAR(law.lowest_gamma(r, other), expected, 1e-8 * std::abs(expected));
        EXPECT_TRUE(law.is_between(r, other));
      }
  // A film thinner than the roughness does not exist.
  FilmLaw thin, given;
  thin.viscosity = mu;
  thin.roughness = 1e-3;
  given.gamma_min = -2.5;
  thin.begins_at = 1e-3;
  EXPECT_EQ(thin.lowest_gamma(r, r), 0);
  EXPECT_FALSE(thin.is_between(r, r));
  // A round wall that is too narrow for the roughness.
  thin.begins_at = 1;
  EXPECT_EQ(thin.lowest_gamma(r, -r - 1e-3), 0);
  EXPECT_FALSE(thin.is_between(r, -r - 1e-3));
  EXPECT_EQ(given.lowest_gamma(r, r), -2.5);
  EXPECT_EQ(FilmLaw{}.lowest_gamma(r, r), -std::numeric_limits<double>::infinity());
}

TEST(FilmLaw, TakesUpImpulsesWithinItsBounds) {
  Pair pair{0, 1};
  const auto press = [&](double impulse, double lowest) {
    pair.impulse = impulse;
    FilmLaw::absorb(pair, 0, lowest);
    return pair.gamma;
  };
  EXPECT_EQ(press(1, -10), -1);
  EXPECT_EQ(press(0.5, -10), -1.5);
  EXPECT_EQ(press(-0.25, -10), -1.25);  // it pulls, and gives back
  EXPECT_EQ(press(20, -10), -10);       // the solids carry the rest
  EXPECT_EQ(pair.gamma_error, 0);       // which is exact
  EXPECT_EQ(press(-10, -10), 0);        // nothing is left
  // What a rounding error leaves is nothing, too: 0.3 - 0.1 - 0.2 > 0.
  press(0.3, -10);
  press(-0.1, -10);
  EXPECT_EQ(press(-0.2, -10), 0);
  // A film without strength.
  EXPECT_EQ(press(3, 0), 0);
}

TEST(FilmLaw, KeepsTheErrorOfItsImpulses) {
  Pair pair{0, 1};
  pair.impulse = 1;
  for (int i = 0; i < 3; ++i) FilmLaw::absorb(pair, 1e-3, -10);
  EXPECT_NEAR(pair.gamma_error, 3e-3, 1e-14);
}

TEST(RestitutionLaw, OfAParticleAtAPlaneIsThatOfTheClosedForm) {
  // (4.13): both phases of an impact with the momentum p = m u on a film from gamma_min = -k; the
  // particle leaves with e_d p - (1 + e_d) k, or stays with gamma = gamma_min + e_d (p - k).
  const RestitutionLaw law{0.8};
  const double k = 2;
  for (const double p : {1.0, 2.0, 3.0, 4.4, 4.6, 10.0, 1000.0}) {
    const double solid = RestitutionLaw::solid_impulse(p, k);
    const double gamma_c = std::max(-p, -k);
    const double lowest = law.lowest_in_restitution(gamma_c, solid);
    const double second =
        std::max(lowest, 0.0);  // of the restitution: the film does not open by itself
    const double gamma = RestitutionLaw::gamma_after(lowest, second, -k, 0);
    const double leaves = 0.8 * p - 1.8 * k;
    if (leaves > 0) {
      EXPECT_NEAR(second, leaves, 1e-12 * p);
      EXPECT_EQ(gamma, 0);
    } else {
      EXPECT_EQ(second, 0);
      EXPECT_NEAR(gamma, p > k ? -k + 0.8 * (p - k) : -p, 1e-14);
    }
  }
  EXPECT_TRUE(law.is_on());
  EXPECT_FALSE(RestitutionLaw{}.is_on());
}

TEST(ContactLaws, UseTheRadiiOfBothSurfaces) {
  Particles particles;
  particles.dimension = 2;
  particles.radii = {1, 2};
  Plane plane, circle;
  circle.start.radius = 7;
  const std::array obstacles{plane, circle};
  EXPECT_EQ(radii_of({0, 1}, particles, obstacles).first, 1);
  EXPECT_EQ(radii_of({0, 1}, particles, obstacles).second, 2);
  EXPECT_EQ(radii_of({-1, 1}, particles, obstacles).first, std::numeric_limits<double>::infinity());
  EXPECT_EQ(radii_of({-2, 0}, particles, obstacles).first, -7);
  ContactLaws laws;
  laws.film.viscosity = 1;
  laws.film.roughness = 0.01;
  const auto gamma_min = [&](std::int32_t first, std::int32_t second) {
    return laws.lowest_gamma({}, {}, radii_of({first, second}, particles, obstacles));
  };
  const auto expected = [](double r, double neighbour) {
    const double r_eff = lubrication::effective_radius(r, neighbour);
    return -lubrication::sphere_squeeze_integral(r, neighbour, 0.02, r_eff);
  };
  EXPECT_DOUBLE_EQ(gamma_min(0, 1), expected(2, 1));
  EXPECT_DOUBLE_EQ(gamma_min(-1, 1), expected(2, std::numeric_limits<double>::infinity()));
  EXPECT_DOUBLE_EQ(gamma_min(-2, 0), expected(1, -7));
}

}  // namespace
}  // namespace viscontact::particles
