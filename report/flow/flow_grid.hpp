// Interpolates a flow from the nodes of a finite-element mesh to the points of a regular grid.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "viscontact/common/vtk/flow_vtk.hpp"

namespace viscontact::report {

/// A rectangle whose sides are parallel to the axes, of positive width and height.
struct Window {
  double left = 0, right = 0, bottom = 0, top = 0;  ///< places of its sides [L]
  double width() const { return right - left; }     ///< [L]
  double height() const { return top - bottom; }    ///< [L]
  bool operator==(const Window&) const = default;
};

/// Evenly spaced points that fill a window; the outermost points are on its sides. In lists they
/// stand row by row from the bottom, each row from the left.
struct Grid {
  Window window;
  std::size_t columns = 2, rows = 2;  ///< at least 2

  double step_x() const { return window.width() / static_cast<double>(columns - 1); }  ///< [L]
  double step_y() const { return window.height() / static_cast<double>(rows - 1); }    ///< [L]
  /// The coordinates of a column and of a row, which are counted from 0 [L].
  double x(std::size_t column) const {
    return window.left + static_cast<double>(column) * step_x();
  }
  double y(std::size_t row) const { return window.bottom + static_cast<double>(row) * step_y(); }
  std::size_t size() const { return columns * rows; }
  bool operator==(const Grid&) const = default;
  /// The window [L] that pixels fill if the points are their centres.
  Window pixel_window() const {
    return {window.left - step_x() / 2, window.right + step_x() / 2, window.bottom - step_y() / 2,
            window.top + step_y() / 2};
  }
};

/// A grid with about `points` points, nearly as far apart along x as along y. A row or column
/// has from 2 to 1200 points, because a longer row could not be seen on a screen.
Grid grid_of(const Window& window, std::size_t points);

/// Velocity [L/T] and pressure [M/(L T^2)] at the points of a grid; NaN at a point that is in no
/// triangle of the mesh.
struct FlowOnGrid {
  std::vector<double> velocity_x, velocity_y, pressure;
};

/// How a flow is repeated in the plane. One period further the pressure is the same, and the
/// velocity differs by a constant.
struct FlowPeriods {
  std::array<double, 2> lengths{};  ///< periods along x and y [L], >= 0; 0: no period
  /// Mean velocity gradient du/dx, du/dy, dv/dx, dv/dy [1/T]. The velocity one period further is
  /// larger by the gradient times the vector of the period.
  std::array<double, 4> gradient{};
};

/// Interpolates the flow by the shape functions of the mesh's quadratic triangles, at whose six
/// nodes `flow` (common/vtk/flow_vtk.hpp) is given. Points in copies of the triangles, one period
/// further on either side, get values as well, because a triangle may lie outside of the cell that
/// `periods` repeats.
FlowOnGrid flow_on_grid(const FlowField& flow, const Grid& grid, const FlowPeriods& periods = {});

/// Interpolates a field, which has `values` in any unit at the nodes of the mesh; NaN where the
/// mesh has no triangle.
std::vector<double> field_on_grid(const QuadraticMesh& mesh, const std::vector<double>& values,
                                  const Grid& grid);

/// Replaces each NaN by the mean of those of its at most eight neighbours on the grid that were
/// numbers before the call. A NaN without such a neighbour stays. `values` has rows of `columns` >=
/// 1 numbers.
void fill_next_to_known(std::vector<double>& values, std::size_t columns);

}  // namespace viscontact::report
