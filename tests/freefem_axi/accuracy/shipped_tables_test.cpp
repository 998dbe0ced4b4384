// The tables of data/tables/ that reach reference accuracy, beside exact drags. That FreeFEM still
// computes such rows, error_estimate_test.cpp checks.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/oracles/bispherical/bispherical.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::freefem_axi {
namespace {

struct Shipped {
  const char* name;
  double (*exact)(double gap);
};

TEST(ShippedTables, AreExactWithinTheirEstimates) {
  for (const auto& [name, exact] :
       {Shipped{"plane", bispherical_plane_factor},
        Shipped{"free_surface", free_surface_drag_factor},
        Shipped{"equal_spheres", [](double gap) { return two_sphere_drag_factor(gap, 1, 0); }}}) {
    SCOPED_TRACE(name);
    const auto table = lubrication::read_force_table(std::string(VISCONTACT_SOURCE_FOLDER) +
                                                     "/data/tables/" + name + ".csv");
    ASSERT_EQ(table.rows.size(), 60U);
    EXPECT_EQ(table.rows.front().gap, 1e-4);
    EXPECT_EQ(table.rows.back().gap, 10);
    std::size_t above = 0;
    for (const auto& row : table.rows) {
      const double error = std::abs(row.force_factor / exact(row.gap) - 1);
      above += error > row.relative_error_estimate ? 1 : 0;
      EXPECT_LE(error, 3 * row.relative_error_estimate) << "gap " << row.gap;
    }
    EXPECT_LE(above, 3U);  // the estimate holds in 95 % of rows
  }
}

}  // namespace
}  // namespace viscontact::freefem_axi
