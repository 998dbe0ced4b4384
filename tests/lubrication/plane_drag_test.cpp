// The fast drag of the half-space against Brenner's series, values of 40 digits, and itself.
#include "viscontact/lubrication/plane_drag.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/fitting/samples.hpp"
#include "tests/oracles/brenner.hpp"
#include "tests/oracles/gauss_legendre.hpp"

namespace viscontact::lubrication {
namespace {

constexpr double kRoundOff = std::numeric_limits<double>::epsilon();

struct Exact {
  double eps, regular, log_slope, integral, regular_integral;
};

// mpmath with 40 digits: R = lambda - 1/eps of Brenner's series; its slope by 8th-order differences
// of step 1e-3 in ln eps (1e-24 off); S = int_0^eps R by adaptive tanh-sinh quadrature from eps =
// exp(-8), with the expansion of data/reference/near_contact_expansion.csv below (1e-22 off). At
// 1e-12 all is of the expansion. 2.4e-3, 2.5e-3 and 7.3, 7.5 are beside the joins exp(-6) and
// exp(2).
constexpr std::array kExact = {
    Exact{1e-12, 6.497484154222913938, -1000000000000.20002, -28.89260500361081805,
          6.697484154222184318e-12},
    Exact{1e-5, 3.2738721765356004, -100000.1999933236854, -12.77447461397200233,
          0.0000347386871933183651},
    Exact{1e-3, 2.353326880582412497, -1000.199551782155714, -8.166786075822762677,
          0.002553090848341660729},
    Exact{2.4e-3, 2.178827151766256786, -416.8656913314449996, -7.288162483354344286,
          0.005707945962860224617},
    Exact{2.5e-3, 2.170703293504053363, -400.1989889090091807, -7.247123015087512814,
          0.005925419709436458492},
    Exact{1e-2, 1.896172324613488867, -100.1966218661574793, -5.845810444614598107,
          0.02094362906246054701},
    Exact{0.1, 1.45915720340955722, -10.17763214753703909, -3.399497954876076237,
          0.1646710258069366975},
    Exact{0.5, 1.20539031535262803, -2.130894062372206211, -1.272661335416703734,
          0.6820697328322088822},
    Exact{1, 1.1255355667600402, -1.098607926540858101, 0.0, 1.261583887688967306},
    Exact{2, 1.069205393549496848, -0.5642291885992896983, 1.785312256103915922,
          2.353748963232937919},
    Exact{7.3, 1.01878892423056825, -0.156688952291044761, 8.560750151551949248,
          7.834459691086571134},
    Exact{7.5, 1.018263772512307838, -0.1524918648092757707, 8.791483611941660981,
          8.038164479088363531},
    Exact{30, 1.004306117903909301, -0.03776312566627119961, 32.86172417277421773,
          30.72211067880102966},
    Exact{100, 1.001263589004803109, -0.01127671332323299355, 104.219241443336624,
          100.8756551450374999},
    Exact{1e4, 1.000012501405767669, -0.0001125028110530961316, 10009.40142626993228,
          10001.45266978564507}};

TEST(PlaneDrag, AgreesWithFortyDigits) {
  // Round-off of a sum of a few terms of one sign: the logarithm, the polynomial and the sum give
  // one or two units each.
  constexpr double kFew = 4 * kRoundOff;
  for (const auto& exact : kExact) {
    const double eps = exact.eps;
    const auto expect = [&](const char* what, double value, double expected, double scale) {
      EXPECT_NEAR(value, expected, kFew * scale) << what << " at " << eps;
    };
    const double factor = 1 / eps + exact.regular;
    expect("lambda", plane_drag_factor(eps), factor, factor);
    expect("log slope", plane_drag_factor_log_slope(eps), exact.log_slope, -exact.log_slope);
    expect("regular", plane_drag_factor_regular(eps), exact.regular, exact.regular);
    // x + S(eps) - S(1): near eps = 1 the digits of S(1) count, not those of the small result.
    expect("integral", plane_drag_integral(eps), exact.integral,
           std::max(1.0, std::abs(exact.integral)));
    expect("regular integral", plane_drag_regular_integral(eps), exact.regular_integral,
           exact.regular_integral);
  }
}

TEST(PlaneDrag, FollowsBrennersSeries) {
  for (const double eps : fitting::log_spaced(1e-6, 1e3, 400)) {
    const double exact = brenner_drag_factor(eps);
    // The oracle sums in long double and promises 1e-13; it was seen to hold 1e-15.
    EXPECT_NEAR(plane_drag_factor(eps), exact, 4 * kRoundOff * exact) << "at " << eps;
  }
}

TEST(PlaneDrag, LogSlopeIsTheDerivative) {
  // Central differences of order 10 in x = ln eps.
  constexpr std::array kWeights = {5.0 / 6, -5.0 / 21, 5.0 / 84, -5.0 / 504, 1.0 / 1260};
  constexpr double kStep = 0.05;
  for (const double eps : fitting::log_spaced(1e-5, 1e3, 200)) {
    double slope = 0;
    for (int k = 1; k <= 5; ++k) {
      const double ratio = std::exp(k * kStep);
      slope += kWeights[static_cast<std::size_t>(k - 1)] / kStep *
               (brenner_drag_factor(eps * ratio) - brenner_drag_factor(eps / ratio));
    }
    // What is left out is kStep^10/2772 of the 11th derivative, at most 11!/pi^11 (lambda is
    // analytic for |Im x| < pi) of lambda: 5e-15. The round-off of arguments and values, 1e-16 to
    // 5e-16 each, comes 2/kStep times.
    EXPECT_NEAR(plane_drag_factor_log_slope(eps), slope, 3e-14 * plane_drag_factor(eps))
        << "at " << eps;
  }
}

/// int lambda from `low` to `high`, ln(high/low) <= 1, in x = ln eps.
template <typename Function>
double quadrature(Function drag_factor, double low, double high) {
  static const auto kNodes = gauss_legendre(16);
  const double middle = std::log(low * high) / 2;
  const double half = std::log(high / low) / 2;
  long double sum = 0;
  for (const auto& node : kNodes) {
    const double eps = std::exp(middle + half * static_cast<double>(node.x));
    sum += node.weight * half * eps * drag_factor(eps);
  }
  return static_cast<double>(sum);
}

TEST(PlaneDrag, IntegralsAreThoseOfTheFactor) {
  const auto gaps = fitting::log_spaced(1e-4, 1e4, 30);  // ln 10^8/29 = 0.64 apart
  for (std::size_t i = 1; i < gaps.size(); ++i) {
    const double low = gaps[i - 1], high = gaps[i];
    const double integral = plane_drag_integral(high) - plane_drag_integral(low);
    // Each value is that good; the difference is of values of this size.
    const double round_off =
        4 * kRoundOff *
        std::max(1.0, std::abs(plane_drag_integral(high)) + std::abs(plane_drag_integral(low)));
    // 16 nodes are exact to 1e-20 here (the integrand is analytic for |Im x| < pi, ten
    // half-intervals away), but their weights have 2.3e-15 only, and the ends in x a few roundings.
    const double tolerance = round_off + 5e-15 * integral;
    EXPECT_NEAR(integral, quadrature(plane_drag_factor, low, high), tolerance) << "to " << high;
    EXPECT_NEAR(integral, quadrature(brenner_drag_factor, low, high), tolerance) << "to " << high;
    // Without the singular part nothing cancels.
    const double regular = plane_drag_regular_integral(high) - plane_drag_regular_integral(low);
    EXPECT_NEAR(regular, quadrature(plane_drag_factor_regular, low, high),
                4 * kRoundOff * plane_drag_regular_integral(high) + 5e-15 * regular)
        << "to " << high;
  }
}

TEST(PlaneDrag, PartsAddUp) {
  const double to_one = plane_drag_regular_integral(1);
  for (const double eps : fitting::log_spaced(1e-12, 1e12, 500)) {
    const double integral = plane_drag_integral(eps);
    EXPECT_DOUBLE_EQ(plane_drag_factor(eps), 1 / eps + plane_drag_factor_regular(eps));
    // Three roundings of terms no larger than the sum or than 1.3.
    EXPECT_NEAR(integral, std::log(eps) + plane_drag_regular_integral(eps) - to_one,
                4 * kRoundOff * std::max(1.0, std::abs(integral)));
  }
  EXPECT_NEAR(plane_drag_integral(1), 0, kRoundOff);  // one rounding of S(1) = 1.26
}

TEST(PlaneDrag, IsContinuousAtTheJoins) {
  // The ends of the pieces of length 1 in ln eps. Every number around them, as exp and ln round.
  for (int x = -6; x <= 2; ++x) {
    const double join = std::exp(x);
    const double below = join * (1 - 16 * kRoundOff), above = join * (1 + 16 * kRoundOff);
    for (double eps = below; eps < above; eps = std::nextafter(eps, above)) {
      const auto expect = [&](const char* what, double (*f)(double), double scale) {
        // 32 roundings of the argument at most, between which no function changes more than in
        // proportion, and a few of the values.
        EXPECT_NEAR(f(eps), f(below), 40 * kRoundOff * std::max(scale, std::abs(f(below))))
            << what << " at exp(" << x << ")";
      };
      expect("lambda", plane_drag_factor, 0);
      expect("log slope", plane_drag_factor_log_slope, 0);
      expect("regular", plane_drag_factor_regular, 0);
      expect("integral", plane_drag_integral, 1 + 2 * join);  // its slope in ln eps, eps lambda
      expect("regular integral", plane_drag_regular_integral, 0);
    }
  }
}

TEST(PlaneDrag, HoldsToTheSmallestGaps) {
  constexpr double kEps = 1e-300;
  const double x = std::log(kEps);
  const double regular = -x / 5 + 0.9712799310357215124;
  EXPECT_DOUBLE_EQ(plane_drag_factor(kEps), 1e300);
  EXPECT_DOUBLE_EQ(plane_drag_factor_log_slope(kEps), -1e300);
  EXPECT_DOUBLE_EQ(plane_drag_factor_regular(kEps), regular);
  EXPECT_DOUBLE_EQ(plane_drag_integral(kEps), x - plane_drag_regular_integral(1));
  EXPECT_DOUBLE_EQ(plane_drag_regular_integral(kEps), (regular + 0.2) * kEps);
}

TEST(PlaneDrag, HoldsToTheWidestGaps) {
  constexpr double kEps = 1e300;
  EXPECT_DOUBLE_EQ(plane_drag_factor(kEps), 1);
  EXPECT_DOUBLE_EQ(plane_drag_factor_log_slope(kEps) * kEps, -9.0 / 8);
  EXPECT_DOUBLE_EQ(plane_drag_factor_regular(kEps), 1);
  EXPECT_DOUBLE_EQ(plane_drag_integral(kEps), kEps);
  EXPECT_DOUBLE_EQ(plane_drag_regular_integral(kEps), kEps);
}

TEST(PlaneDrag, NegativeGapsGiveNoNumber) {
  for (const double eps : {-1e-3, -10.0, std::numeric_limits<double>::quiet_NaN()})
    for (const auto f : {plane_drag_factor, plane_drag_factor_log_slope, plane_drag_factor_regular,
                         plane_drag_integral, plane_drag_regular_integral})
      EXPECT_TRUE(std::isnan(f(eps))) << "at " << eps;
}

}  // namespace
}  // namespace viscontact::lubrication
