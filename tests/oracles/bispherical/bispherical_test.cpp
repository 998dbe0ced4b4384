// The series against reference values, and against what is known of them by other means: limits,
// symmetries, expansions near contact and far away.
#include "tests/oracles/bispherical/bispherical.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <string>

#include "tests/oracles/brenner.hpp"
#include "tests/oracles/near_contact_expansion.hpp"
#include "viscontact/common/text/csv.hpp"

namespace viscontact {
namespace {

/// What the header promises; it holds the rounding of arguments and of results to double.
constexpr double kRounding = 1e-14;

constexpr std::initializer_list<double> kGaps = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2,
                                                 0.1,  1,    10,   100,  1e3};

/// Calls check(fields) for each row of a table of reference values with at least `least` rows.
template <std::size_t columns, class Check>
void for_each_row(const char* file, const std::array<std::string, columns>& names,
                  std::size_t least, const Check& check) {
  const auto table = read_csv(kReference / file, names, columns);
  EXPECT_GE(table.rows.size(), least);
  for (const auto& row : table.rows) {
    std::array<double, columns> fields{};
    for (std::size_t i = 0; i < columns; ++i) fields[i] = row.fields[i].value();
    check(fields);
  }
}

TEST(Bispherical, AgreesWithTheReferenceValuesNearAPlane) {
  const std::array<std::string, 2> columns{"gap_over_r", "lambda"};
  for_each_row("sphere_plane.csv", columns, 8, [](const auto& row) {
    EXPECT_NEAR(bispherical_plane_factor(row[0]), row[1], kRounding * row[1]) << "at " << row[0];
  });
  for_each_row("sphere_free_surface.csv", columns, 4, [](const auto& row) {
    EXPECT_NEAR(free_surface_drag_factor(row[0]), row[1], kRounding * row[1]) << "at " << row[0];
  });
}

TEST(Bispherical, AgreesWithTheReferenceValuesOfTwoSpheres) {
  const std::array<std::string, 5> columns{"size_ratio_a2_over_a1", "gap_over_a1", "X11A", "X12A",
                                           "X22A"};
  for_each_row("two_spheres.csv", columns, 4, [](const auto& row) {
    const auto& [ratio, epsilon, x11, x12, x22] = row;
    EXPECT_NEAR(two_sphere_drag_factor(epsilon, ratio, 0), x11, kRounding * x11)
        << "X11A at " << epsilon;
    // For other velocities the largest number in the sum is X11A or X12A, both of the same size.
    for (const double velocity : {-1.0, 0.5, 1.0, 3.0})
      EXPECT_NEAR(two_sphere_drag_factor(epsilon, ratio, velocity),
                  x11 + (1 + ratio) / 2 * x12 * velocity, 4 * kRounding * x11)
          << "at " << epsilon << ", velocity ratio " << velocity;
    EXPECT_NEAR(two_sphere_drag_factor(epsilon / ratio, 1 / ratio, 0), x22, kRounding * x22)
        << "X22A at " << epsilon;
  });
}

TEST(Bispherical, AgreesWithTheReferenceValuesInACavity) {
  const std::array<std::string, 3> columns{"R_over_r", "gap_over_r", "lambda"};
  for_each_row("sphere_in_cavity.csv", columns, 13, [](const auto& row) {
    EXPECT_NEAR(cavity_drag_factor(row[1], row[0]), row[2], kRounding * row[2]) << "at " << row[1];
  });
  for_each_row("sphere_in_cavity_concentric.csv", columns, 2, [](const auto& row) {
    EXPECT_NEAR(concentric_cavity_drag_factor(row[0]), row[2], kRounding * row[2]);
    EXPECT_NEAR(cavity_drag_factor(row[1], row[0]), row[2], kRounding * row[2]);
  });
}

TEST(Bispherical, AgreesWithBrennersSeries) {
  // Another sum of the same problem, which promises 1e-13.
  for (const double epsilon : kGaps) {
    const double exact = brenner_drag_factor(epsilon);
    EXPECT_NEAR(bispherical_plane_factor(epsilon), exact, 1e-13 * exact) << "at " << epsilon;
  }
}

TEST(Bispherical, DiffersFromACutExpansionByTheNextTerms) {
  expect_next_terms_of_cut_expansion(near_contact_expansion("rigid"), bispherical_plane_factor);
  expect_next_terms_of_cut_expansion(near_contact_expansion("free"), free_surface_drag_factor);
}

TEST(Bispherical, HoldsItsDigitsAtTheSmallestGapsItPromises) {
  expect_expansion_at_small_gaps(near_contact_expansion("rigid"), bispherical_plane_factor,
                                 kRounding);
  expect_expansion_at_small_gaps(near_contact_expansion("free"), free_surface_drag_factor,
                                 kRounding);
}

TEST(Bispherical, TwoEqualSpheresThatMeetAreAShearFreePlaneHalfway) {
  for (const double epsilon : kGaps) {
    const double plane = free_surface_drag_factor(epsilon / 2);
    EXPECT_NEAR(two_sphere_drag_factor(epsilon, 1, -1), plane, 2 * kRounding * plane)
        << "at " << epsilon;
  }
}

TEST(Bispherical, TheForceOfOneSphereOnTheOtherIsReciprocal) {
  // Lorentz's theorem: F1/U2 = F2/U1. In units of 6 pi mu r1 the left is f(1) - f(0), the right the
  // same with the spheres' roles changed, times radius_ratio. Differences of doubles hold the
  // rounding of the larger, hence the tolerance.
  for (const double ratio : {0.01, 0.3, 2.0, 10.0, 100.0}) {
    for (const double epsilon : {1e-4, 1e-2, 1.0, 100.0}) {
      const double alone1 = two_sphere_drag_factor(epsilon, ratio, 0);
      const double alone2 = ratio * two_sphere_drag_factor(epsilon / ratio, 1 / ratio, 0);
      const double cross1 = two_sphere_drag_factor(epsilon, ratio, 1) - alone1;
      const double cross2 = ratio * two_sphere_drag_factor(epsilon / ratio, 1 / ratio, 1) - alone2;
      EXPECT_LT(cross1, 0) << "a sphere drags the other along";
      EXPECT_NEAR(cross1, cross2, 2 * kRounding * (alone1 + alone2))
          << "radius ratio " << ratio << " at " << epsilon;
    }
  }
}

TEST(Bispherical, EqualSpheresThatMoveTogetherDragLessThanTwoAlone) {
  // At contact 0.645141..., Cooley & O'Neill 1969 (Proc. Camb. Phil. Soc. 66, 407) for touching
  // spheres; the approach is linear in the gap, with a slope of order 0.1.
  EXPECT_NEAR(two_sphere_drag_factor(1e-6, 1, 1), 0.645141, 1e-6);
  // Far away, at distance d of the centres over r, Smoluchowski's reflections give mobility
  // 1 + 3/(2d) - 1/d^3 - 15/(4 d^4) + ...; together and, at -1, against each other.
  for (const double d : {10.0, 30.0, 100.0}) {
    for (const double sign : {1.0, -1.0}) {
      const double mobility = 1 + sign * (1.5 / d - 1 / (d * d * d)) - 3.75 / std::pow(d, 4);
      // The next term is of order d^-6, its coefficient below 100.
      EXPECT_NEAR(1 / two_sphere_drag_factor(d - 2, 1, sign), mobility,
                  100 * std::pow(d, -6) + kRounding)
          << "at d/r = " << d << ", velocity ratio " << sign;
    }
  }
}

TEST(Bispherical, UnequalSpheresAndCavitiesFollowTheLubricationExpansion) {
  // Jeffrey & Onishi 1984, section 3: X11A = g1/xi + g2 ln(1/xi) + A + g3 xi ln(1/xi) +
  // O(xi), xi = 2 gap/(r1 + r2). A cavity is a second sphere of negative radius k.
  for (const double k : {0.1, 0.5, 1.0, 3.0, 10.0, -1.5, -5.0, -100.0}) {
    const auto rest = [k](double epsilon) {
      const double xi = 2 * epsilon / (1 + k), logarithm = -std::log(std::abs(xi));
      const double cube = std::pow(1 + k, 3);
      const double g1 = 2 * k * k / cube;
      const double g2 = k * (1 + 7 * k + k * k) / (5 * cube);
      const double g3 =
          (1 + 18 * k - 29 * k * k + 18 * std::pow(k, 3) + std::pow(k, 4)) / (42 * cube);
      const double drag =
          k > 0 ? two_sphere_drag_factor(epsilon, k, 0) : cavity_drag_factor(epsilon, -k);
      return drag - g1 / xi - g2 * logarithm - g3 * xi * logarithm;
    };
    // The rest is A + O(xi): its differences grow tenfold with the gap. What comes after is of
    // order xi^2 ln xi, and |xi| = 4e-3 for the largest gap in the narrowest cavity.
    const double first = rest(1e-4) - rest(1e-5), second = rest(1e-3) - rest(1e-4);
    EXPECT_NEAR(second / first, 10, 1) << "radius ratio " << k;
  }
}

TEST(Bispherical, LargeSpheresAndLargeCavitiesTendToAPlane) {
  for (const double epsilon : {1e-3, 0.1, 1.0}) {
    const double plane = bispherical_plane_factor(epsilon);
    const auto outside = [&](double ratio) {
      return (1 - two_sphere_drag_factor(epsilon, ratio, 0) / plane) * ratio;
    };
    const auto inside = [&](double ratio) {
      return (cavity_drag_factor(epsilon, ratio) / plane - 1) * ratio;
    };
    // The drag is smooth in the second surface's curvature, whose sign tells a sphere from a
    // cavity: the error is of first order with the same slope on both sides, and what the slope
    // still lacks at 1e4 is a tenth of that at 1e3.
    const double slope = (outside(1e5) + inside(1e5)) / 2;
    for (const auto& ratio : {1e3, 1e4}) {
      EXPECT_NEAR(outside(ratio), slope, 5 * slope / ratio) << "sphere, at " << epsilon;
      EXPECT_NEAR(inside(ratio), slope, 5 * slope / ratio) << "cavity, at " << epsilon;
    }
    // Near contact 1/epsilon turns to (k/(k +- 1))^2/epsilon: slope 2.
    if (epsilon < 1e-2) {
      EXPECT_NEAR(slope, 2, 20 * epsilon);
    }
  }
}

TEST(Bispherical, EccentricCavitiesTendToTheConcentricOne) {
  for (const double ratio : {1.01, 2.0, 5.0, 100.0}) {
    const double exact = concentric_cavity_drag_factor(ratio);
    const auto excess = [&](double relative_offset) {
      return cavity_drag_factor((ratio - 1) * (1 - relative_offset), ratio) / exact - 1;
    };
    // Even in the offset: its square, and then the fourth power, which at 0.02 is below 1e-3 of it.
    EXPECT_GT(excess(0.01), 0);
    EXPECT_NEAR(excess(0.02) / excess(0.01), 4, 4e-3) << "R/r " << ratio;
    // Bispherical coordinates degenerate at the centre, but the sum does not.
    for (const double offset : {1e-9, 1e-13})
      EXPECT_NEAR(excess(offset), 0, kRounding) << "R/r " << ratio << ", offset " << offset;
  }
}

TEST(Bispherical, ConcentricCavitiesHaveTheirLimits) {
  // Far: 1 + (9/4) x + (9/4)^2 x^2 + O(x^3), x = r/R.
  for (const double ratio : {1e2, 1e3}) {
    const double x = 9.0 / 4 / ratio;
    EXPECT_NEAR(concentric_cavity_drag_factor(ratio), 1 + x + x * x, 2 * x * x * x);
  }
  // A thin film of width w = R/r - 1: Reynolds' equation gives 4/(3 w^3), with relative error
  // of order w.
  for (const double width : {1e-3, 1e-2}) {
    EXPECT_NEAR(concentric_cavity_drag_factor(1 + width) * std::pow(width, 3), 4.0 / 3, 4 * width);
  }
}

}  // namespace
}  // namespace viscontact
