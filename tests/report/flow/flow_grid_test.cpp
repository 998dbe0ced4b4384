// Interpolation of flows at the points of a grid.
#include "viscontact/report/flow/flow_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/report/flow/flows.hpp"

namespace viscontact::report {
namespace {

TEST(FlowGrid, HasAboutAsManyPointsAsWantedEquallyFarApart) {
  const auto grid = grid_of({0, 4, 0, 1}, 10000);
  EXPECT_EQ(grid.columns, 200U);
  EXPECT_EQ(grid.rows, 50U);
  EXPECT_DOUBLE_EQ(grid.x(199), 4);
  EXPECT_DOUBLE_EQ(grid.y(49), 1);
  EXPECT_NEAR(grid.step_x(), grid.step_y(), 0.02 * grid.step_x());  // a step more or less
}

TEST(FlowGrid, HasTwoPointsInEachDirectionIfNoneAreWanted) {
  const auto grid = grid_of({0, 4, 0, 1}, 0);
  EXPECT_EQ(grid.columns, 2U);
  EXPECT_EQ(grid.rows, 2U);
}

// The shape functions are quadratic, so that a quadratic flow is interpolated without error.
TEST(FlowGrid, InterpolatesAQuadraticFlowExactly) {
  const FlowAt at = [](double x, double y) {
    return std::array{x * x - 2 * x * y, y * y - x, 3 * x + x * y};
  };
  const Grid grid{{0.1, 1.9, 0.05, 0.95}, 37, 23};
  const auto found = flow_on_grid(mesh_of({0, 2, 0, 1}, 3, at), grid, {});
  for (std::size_t row = 0; row < grid.rows; ++row)
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const auto [u, v, p] = at(grid.x(column), grid.y(row));
      const auto i = row * grid.columns + column;
      // Rounding errors of a few operations with numbers below 10.
      EXPECT_NEAR(found.velocity_x[i], u, 1e-13);
      EXPECT_NEAR(found.velocity_y[i], v, 1e-13);
      EXPECT_NEAR(found.pressure[i], p, 1e-13);
    }
}

TEST(FlowGrid, IsNotANumberOutsideTheTriangles) {
  const Grid grid{{-1, 1, 0, 1}, 21, 11};
  const auto found = flow_on_grid(mesh_of({0, 1, 0, 1}, 2,
                                          [](double, double) {
                                            return std::array{1.0, 2.0, 3.0};
                                          }),
                                  grid, {});
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double x = grid.x(i % grid.columns);
    if (std::abs(x) < 0.05) continue;
    EXPECT_EQ(std::isnan(found.pressure[i]), x < 0) << i;
  }
}

TEST(FlowGrid, FillsTheCellByImagesOfTheFlow) {
  // The triangles end a third of a period away from the sides of the cell.
  const auto flow = mesh_of({1, 4, 0, 1}, 12, [](double x, double) {
    return std::array{0.0, 0.0, x};
  });
  const Grid grid{{0, 3, 0, 1}, 31, 11};
  const auto found = flow_on_grid(flow, grid, {{3, 0}});
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double x = grid.x(i % grid.columns);
    if (std::abs(x - 1) < 0.05) continue;  // x = 1 and x = 4 are the same side of the triangles
    EXPECT_NEAR(found.pressure[i], x < 1 ? x + 3 : x, 1e-13) << i;
  }
}

TEST(FlowGrid, ImagesOfAMeanFlowMoveWithIt) {
  // The shear u = (y, 0) on triangles that are half a period above the cell.
  const auto flow = mesh_of({0, 3, 1, 3}, 12, [](double, double y) {
    return std::array{y, 0.0, 0.0};
  });
  const Grid grid{{0, 3, 0, 2}, 31, 21};
  const auto found = flow_on_grid(flow, grid, {{3, 2}, {0, 1, 0, 0}});
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double y = grid.y(i / grid.columns);
    if (std::abs(y - 1) < 0.05) continue;  // the triangles begin and end there
    EXPECT_NEAR(found.velocity_x[i], y, 1e-13) << i;
    EXPECT_NEAR(found.velocity_y[i], 0, 1e-13) << i;
  }
}

}  // namespace
}  // namespace viscontact::report
