// Real FreeFEM through solve_row() against exact drags.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "tests/oracles/bispherical/bispherical.hpp"
#include "tests/oracles/cylinder/sphere_in_cylinder.hpp"
#include "viscontact/freefem_axi/journal/tabulate.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {
namespace {

class ClosedCylinder : public ::testing::TestWithParam<double> {};

TEST_P(ClosedCylinder, DragIsExactToTheAskedAccuracyAndToItsOwnEstimate) {
  constexpr double kAccuracy = 1e-5;
  const double gap = GetParam();
  const auto tabulation = unit_tabulation({gap}, 5, kAccuracy);
  const auto row = solve_row(default_freefem(), tabulation, gap, -1);
  const double error = std::abs(row.force_factor / sphere_in_cylinder_drag_factor(gap, 5, 10) - 1);
  EXPECT_LT(error, kAccuracy);
  EXPECT_LE(row.relative_error_estimate, kAccuracy);
  EXPECT_LT(error, row.relative_error_estimate);
  EXPECT_GT(row.force, 0);  // towards the floor at -1: the fluid pushes away from it
  EXPECT_EQ(row.gap, gap);
  EXPECT_EQ(row.reference_velocity, -1);
  EXPECT_GT(row.degrees_of_freedom, 1000);
}

INSTANTIATE_TEST_SUITE_P(Gaps, ClosedCylinder, ::testing::Values(0.001, 0.1, 1.0));

TEST(HalfSpace, DragNearContactIsBrennersInAWideContainerAndWithoutOne) {
  constexpr double kAccuracy = 1e-5;
  constexpr double kGap = 1e-4;
  auto tabulation = unit_tabulation({kGap}, 80, kAccuracy);
  // At 80 x 160 radii the walls add less than 3e-7 (docs/theory.md), far below what was asked.
  EXPECT_LT(std::abs(solve_row(default_freefem(), tabulation, kGap, -1).force_factor /
                         bispherical_plane_factor(kGap) -
                     1),
            kAccuracy);
  tabulation.container.reset();
  EXPECT_LT(std::abs(solve_row(default_freefem(), tabulation, kGap, -1).force_factor /
                         bispherical_plane_factor(kGap) -
                     1),
            kAccuracy);
}

// Solutions on one mesh are compared with each other, so the coarsest meshes will do. That the
// force does not depend on the units, any_row_test.cpp checks.
constexpr double kCoarse = 1e-2;

TEST(Scaling, ForceOfAMovingPairIsLinearInItsVelocity) {
  auto tabulation = unit_tabulation({0.5}, 10, kCoarse);
  tabulation.geometry = "sphere";
  tabulation.geometry_parameters = {2, -0.5, 0};
  // Velocities of both signs and five orders of magnitude, in one tabulation.
  tabulation.reference_velocities = {-1e-3, 250};
  const TemporaryFolder scratch;
  const auto table = tabulate(default_freefem(), tabulation, 1, scratch.path() / "rows",
                              [](const TabulateProgress&) {});
  ASSERT_EQ(table.rows.size(), 2U);
  const auto& first = table.rows.front();
  for (const auto& row : table.rows)
    // One mesh, one matrix: round-off of the solve (1e-13) is all that may differ.
    EXPECT_NEAR(row.force / row.reference_velocity / (first.force / first.reference_velocity), 1,
                1e-10)
        << row.reference_velocity;
}

TEST(MovingNeighbour, PullsTheSphereAlongWhenItIsTheFaster) {
  constexpr double kGap = 0.1;
  const double exact = two_sphere_drag_factor(kGap, 1, 2);
  ASSERT_LT(exact, 0);
  auto tabulation = unit_tabulation({kGap}, 5, 1e-4);
  tabulation.container.reset();
  tabulation.geometry = "sphere";
  tabulation.geometry_parameters = {1, 2, 0};
  const auto row = solve_row(default_freefem(), tabulation, kGap, -1);
  EXPECT_LT(row.force, 0);  // along the velocity
  EXPECT_NEAR(row.force_factor / exact, 1, 1e-4);
}

}  // namespace
}  // namespace viscontact::freefem_axi
