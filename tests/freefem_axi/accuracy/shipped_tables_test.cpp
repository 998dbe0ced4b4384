// The tables of data/tables/ that reach reference accuracy: a few of their rows, made again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/freefem_axi/tabulations.hpp"
#include "tests/oracles/bispherical/bispherical.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::freefem_axi {
namespace {

struct Shipped {
  const char* name;
  const char* geometry;
  std::vector<double> parameters;
  double (*exact)(double gap);
};

class ShippedTable : public testing::TestWithParam<Shipped> {
 protected:
  lubrication::MotionTable table_ = lubrication::read_force_table(
      std::string(VISCONTACT_SOURCE_FOLDER) + "/data/tables/" + GetParam().name + ".csv");
};

TEST_P(ShippedTable, IsExactWithinItsEstimates) {
  ASSERT_EQ(table_.rows.size(), 60U);
  EXPECT_EQ(table_.rows.front().gap, 1e-4);
  EXPECT_EQ(table_.rows.back().gap, 10);
  std::size_t above = 0;
  for (const auto& row : table_.rows) {
    const double error = std::abs(row.force_factor / GetParam().exact(row.gap) - 1);
    above += error > row.relative_error_estimate ? 1 : 0;
    EXPECT_LE(error, 3 * row.relative_error_estimate) << "gap " << row.gap;
  }
  EXPECT_LE(above, 3U);  // the estimate holds in 95 % of rows
}

TEST_P(ShippedTable, RowsMadeAgainAreThoseOfTheTable) {
  auto tabulation = unit_tabulation({}, 5, 1e-5);
  tabulation.container.reset();
  tabulation.geometry = GetParam().geometry;
  tabulation.geometry_parameters = GetParam().parameters;
  for (const std::size_t i : {5U, 45U}) {
    const auto& shipped = table_.rows[i];
    const auto row = solve_row(default_freefem(), tabulation, shipped.gap, -1);
    // Made on coarser meshes, to save time: both estimates are of the difference.
    EXPECT_LE(std::abs(row.force / shipped.force - 1),
              row.relative_error_estimate + shipped.relative_error_estimate)
        << "gap " << shipped.gap;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, ShippedTable,
    testing::Values(Shipped{"plane", "plane", {}, bispherical_plane_factor},
                    Shipped{"free_surface", "free_surface", {}, free_surface_drag_factor},
                    Shipped{"equal_spheres",
                            "sphere",
                            {1, 0, 0},
                            [](double gap) { return two_sphere_drag_factor(gap, 1, 0); }}),
    [](const auto& param_info) { return std::string(param_info.param.name); });

}  // namespace
}  // namespace viscontact::freefem_axi
