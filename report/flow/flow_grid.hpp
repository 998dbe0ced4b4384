// A flow on a regular grid, from which pictures and pages draw it. Lengths, masses and times are in
// the units of the case. flow_plots.hpp, stream_lines.hpp and particles/picture use it. A change
// must keep the order of points. Nothing is thrown.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "viscontact/common/vtk/flow_vtk.hpp"

namespace viscontact::report {

/// A rectangle of a plane, by the coordinates of its sides [L].
struct Window {
  double left = 0, right = 0, bottom = 0, top = 0;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// Evenly spaced points that fill a window, with points on its sides.
struct Grid {
  Window window;                      ///< [L]
  std::size_t columns = 2, rows = 2;  ///< numbers of points, >= 2

  double step_x() const { return window.width() / static_cast<double>(columns - 1); }
  double step_y() const { return window.height() / static_cast<double>(rows - 1); }
  double x(std::size_t column) const {
    return window.left + static_cast<double>(column) * step_x();
  }
  double y(std::size_t row) const { return window.bottom + static_cast<double>(row) * step_y(); }
  std::size_t size() const { return columns * rows; }
  /// The window whose pixels have the points as their centres.
  Window pixel_window() const {
    return {window.left - step_x() / 2, window.right + step_x() / 2, window.bottom - step_y() / 2,
            window.top + step_y() / 2};
  }
};

/// A grid of the window with about `points` points, nearly as far apart along x as along y.
Grid grid_of(const Window& window, std::size_t points);

/// Velocity [L/T] and pressure [M/(L T^2)] at the points of a grid, row by row from the bottom,
/// each row from the left; NaN where the flow has no triangle.
struct FlowOnGrid {
  std::vector<double> velocity_x, velocity_y, pressure;
};

/// How a flow is repeated in the plane.
struct FlowPeriods {
  std::array<double, 2> lengths{};  ///< periods along x and y [L]; 0 where there is no period
  /// Mean velocity gradient du/dx, du/dy, dv/dx, dv/dy [1/T]: the velocity of a repeated flow
  /// differs by the gradient times the period.
  std::array<double, 4> gradient{};
};

/// Interpolates the flow by the shape functions of its quadratic triangles. The flow is repeated by
/// `periods`, so that its triangles need not lie in the grid (docs/fluid-solver.md).
FlowOnGrid flow_on_grid(const FlowField& flow, const Grid& grid, const FlowPeriods& periods = {});

/// Interpolates a field with these values at the nodes; NaN where the mesh has no triangle.
std::vector<double> field_on_grid(const QuadraticMesh& mesh, const std::vector<double>& values,
                                  const Grid& grid);

/// Replaces each NaN by the mean of its neighbours on the grid (up to eight) that are no NaN; a NaN
/// without such a neighbour stays. The points are row by row, with `columns` in a row.
void fill_next_to_known(std::vector<double>& values, std::size_t columns);

}  // namespace viscontact::report
