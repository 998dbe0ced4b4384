// Rows that failed although nothing is wrong with them: at some gaps the factorisation lost ten
// digits, and sliding was refused where little accuracy was asked. Units must not matter either.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/freefem_axi/accuracy/exact_rows.hpp"
#include "tests/oracles/bispherical/bispherical.hpp"
#include "viscontact/freefem_axi/motion_row.hpp"

namespace viscontact::freefem_axi {
namespace {

struct Units {
  double radius, viscosity, speed;
};

Tabulation changed(const Tabulation& tabulation, const Units& u) {
  return in_units(tabulation, u.radius, u.viscosity, u.speed);
}

TEST(RowsInUnboundedFluid, AreSolvedAtTheGapsThatFailed) {
  constexpr double kAccuracy = 1e-5;
  // In the units in which the rows failed. Rows.AreTheSameInAnyUnits checks that others give the
  // same.
  for (auto [row, units] :
       {std::pair(exact_row("plane", 0.0141, {}, kAccuracy, bispherical_plane_factor(0.0141)),
                  Units{1, 1, 1}),
        std::pair(exact_row("plane", 0.0138, {}, kAccuracy, bispherical_plane_factor(0.0138)),
                  Units{1, 0.1, 1}),
        std::pair(
            exact_row("free_surface", 0.0141, {}, kAccuracy, free_surface_drag_factor(0.0141)),
            Units{1, 1, 1})}) {
    row.tabulation = changed(row.tabulation, units);
    const auto solved = solve(default_freefem(), row);
    SCOPED_TRACE(solved.in_words());
    EXPECT_LE(solved.ratio(), 1);
    EXPECT_TRUE(solved.says_reached());
  }
}

/// The shares of the drag that rounding may change. A length of the case may differ by a unit in
/// the last place from the same one in sphere radii; the force of a narrow gap changes as much, and
/// solves differ by 1e-14.
constexpr double kRounding = 1e-12;

TEST(Rows, AreTheSameInAnyUnits) {
  const auto freefem = default_freefem();
  Random random(29);
  for (const auto& row : {exact_row("sphere", 0.03, {1.7, 0, 0.3}, 1e-2, 1),
                          exact_row("cavity", 0.7, {2.5}, 1e-2, 1)}) {
    const auto& plain = row.tabulation;
    const Units u{log_uniform(random, 1e-5, 1e5), log_uniform(random, 1e-5, 1e5),
                  log_uniform(random, 1e-5, 1e5)};
    const auto tabulation = changed(plain, u);
    const double gap = tabulation.gaps.front();
    if (plain.geometry != "cavity") {  // in unbounded fluid, other motions take long
      const auto expected = solve_motions(freefem, plain, MotionGroup::kAround, row.gap()).at(0);
      const auto spin = solve_motions(freefem, tabulation, MotionGroup::kAround, gap).at(0);
      EXPECT_NEAR(spin.torque_factor / expected.torque_factor, 1, kRounding);
      EXPECT_EQ(spin.degrees_of_freedom, expected.degrees_of_freedom);
      continue;
    }
    const auto expected = solve_row(freefem, plain, row.gap(), -1);
    const auto solved =
        solve_row(freefem, tabulation, gap, tabulation.reference_velocities.front());
    EXPECT_NEAR(solved.force / (u.viscosity * u.radius * u.speed) / expected.force, 1, kRounding);
    EXPECT_EQ(solved.degrees_of_freedom, expected.degrees_of_freedom);
    const auto expected_slide = solve_motions(freefem, plain, MotionGroup::kAcross, row.gap());
    const auto slide = solve_motions(freefem, tabulation, MotionGroup::kAcross, gap);
    for (const std::size_t motion : {0U, 1U}) {
      EXPECT_NEAR(slide[motion].force_factor, expected_slide[motion].force_factor, kRounding);
      EXPECT_NEAR(slide[motion].torque_factor, expected_slide[motion].torque_factor, kRounding);
    }
  }
}

TEST(RowsInUnboundedFluid, HaveEstimatesThatContainItsEndIfLittleAccuracyIsAsked) {
  // The errors of these drags by the end of the fluid would be 1.5e-5 and 7e-6 if the end were
  // nearer than for an accuracy of 1e-5.
  for (const auto& row :
       {exact_row("free_surface", 1, {}, 1e-2, free_surface_drag_factor(1)),
        exact_row("sphere", 1, {1, 1, 0}, 1e-2, two_sphere_drag_factor(1, 1, 1))}) {
    const auto solved = solve(default_freefem(), row);
    SCOPED_TRACE(solved.in_words());
    EXPECT_LE(solved.ratio(), 1);
  }
}

/// A row of sliding and its force over mu r U, from the same scripts at accuracy 1e-7.
struct Slide {
  const char* geometry;
  std::vector<double> parameters;
  double gap, force;
};

TEST(Sliding, IsNotRefusedIfLittleAccuracyIsAsked) {
  for (const auto& slide :
       {Slide{"free_surface", {}, 1e-3, 13.6627890}, Slide{"sphere", {0.1, 0, 0}, 1, 19.1346787}}) {
    const auto tabulation =
        exact_row(slide.geometry, slide.gap, slide.parameters, 1e-2, 1).tabulation;
    const auto row = solve_motions(default_freefem(), tabulation, MotionGroup::kAcross, slide.gap);
    const auto& sphere = row.at(0);
    SCOPED_TRACE(geometry_in_words(tabulation));
    EXPECT_NEAR(6 * std::numbers::pi * sphere.force_factor / slide.force, 1,
                sphere.relative_error_estimate);
  }
}

}  // namespace
}  // namespace viscontact::freefem_axi
