// A point is in a triangle of six nodes if it is in one of the four straight triangles between
// them; its value is that of the quadratic shape functions.
#include "viscontact/report/flow/flow_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace viscontact::report {
namespace {

constexpr double kNoFlow = std::numeric_limits<double>::quiet_NaN();

/// Coordinates [1] of the six nodes (corners 0, 1 and 2, then the middles of the sides 01, 12 and
/// 20) in the reference triangle with corners (0, 0), (1, 0), (0, 1).
constexpr std::array<std::array<double, 2>, 6> kReference = {
    {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
/// The four straight triangles between the six nodes, each as three indices of nodes.
constexpr std::array<std::array<std::size_t, 3>, 4> kFour = {
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

/// The quadratic shape functions [1] of the six nodes at the point (a, b).
std::array<double, 6> shape_functions(double a, double b) {
  const double c = 1 - a - b;
  return {c * (2 * c - 1), a * (2 * a - 1), b * (2 * b - 1), 4 * c * a, 4 * a * b, 4 * b * c};
}

/// The shifts [L] of the mesh and its copies along one axis; there are no copies if `period` is 0.
std::vector<double> shifts(double period) {
  return period > 0 ? std::vector<double>{-period, 0, period} : std::vector<double>{0};
}

/// Divides the window into `columns` x `rows` pixels and calls visit(pixel, w1, w2) for each pixel
/// whose centre is in the triangle with the corners (x[i], y[i]) [L]. Pixels are counted from 0,
/// row by row from the bottom. w1 and w2 [1] are the barycentric coordinates of the centre that
/// belong to corners 1 and 2; they are 0 at corner 0. A triangle of area 0 has no pixels.
template <class Visit>
void for_each_pixel(const std::array<double, 3>& x, const std::array<double, 3>& y,
                    const Window& window, std::size_t columns, std::size_t rows,
                    const Visit& visit) {
  const double width = window.width() / static_cast<double>(columns);
  const double height = window.height() / static_cast<double>(rows);
  // A barycentric coordinate may be this far below 0, and the range of pixels is wider by this
  // share of a pixel, so that a centre on a side is in at least one triangle in spite of round-off.
  constexpr double kSlack = 1e-9;
  // The first pixel whose centre is from `low` to `high` [L] in a row or column of `count` pixels
  // of the length `step` [L] from `start` on, and the index after the last such pixel.
  const auto range = [](double low, double high, double start, double step, std::size_t count) {
    const auto clamp = [&](double place) {
      return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count)));
    };
    return std::pair(clamp(std::ceil((low - start) / step - 0.5 - kSlack)),
                     clamp(std::floor((high - start) / step - 0.5 + kSlack) + 1));
  };
  const double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0) return;
  const auto [left, right] = std::ranges::minmax(x);
  const auto [bottom, top] = std::ranges::minmax(y);
  const auto [first_column, end_column] = range(left, right, window.left, width, columns);
  const auto [first_row, end_row] = range(bottom, top, window.bottom, height, rows);
  for (auto row = first_row; row < end_row; ++row)
    for (auto column = first_column; column < end_column; ++column) {
      const double px = window.left + (static_cast<double>(column) + 0.5) * width;
      const double py = window.bottom + (static_cast<double>(row) + 0.5) * height;
      const double w1 = ((px - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (py - y[0])) / area;
      const double w2 = ((x[1] - x[0]) * (py - y[0]) - (px - x[0]) * (y[1] - y[0])) / area;
      if (w1 < -kSlack || w2 < -kSlack || w1 + w2 > 1 + kSlack) continue;
      visit(row * columns + column, w1, w2);
    }
}

/// Calls visit(point, nodes, shape, shift) for each point of the grid that is in a triangle of the
/// mesh or of a copy that is shifted by `shift` [L]; `shape` has the shape functions of the
/// triangle's six `nodes` at the point. A point on a side of two triangles is visited for both.
template <class Visit>
void for_each_point(const QuadraticMesh& mesh, const Grid& grid, const FlowPeriods& periods,
                    const Visit& visit) {
  assert(grid.columns >= 2 && grid.rows >= 2);
  const auto window = grid.pixel_window();
  const auto shifts_x = shifts(periods.lengths[0]), shifts_y = shifts(periods.lengths[1]);
  for (const auto& nodes : mesh.triangles)
    for (const double shift_x : shifts_x)
      for (const double shift_y : shifts_y)
        for (const auto& part : kFour) {
          std::array<double, 3> x{}, y{};
          for (std::size_t i = 0; i < 3; ++i) {
            const auto node = static_cast<std::size_t>(nodes[part[i]]);
            x[i] = mesh.x[node] + shift_x;
            y[i] = mesh.y[node] + shift_y;
          }
          for_each_pixel(
              x, y, window, grid.columns, grid.rows, [&](std::size_t point, double w1, double w2) {
                const std::size_t p = part[0], q = part[1], r = part[2];
                const auto at = [&](std::size_t d) {
                  return kReference[p][d] + w1 * (kReference[q][d] - kReference[p][d]) +
                         w2 * (kReference[r][d] - kReference[p][d]);
                };
                visit(point, nodes, shape_functions(at(0), at(1)), std::array{shift_x, shift_y});
              });
        }
}

}  // namespace

Grid grid_of(const Window& window, std::size_t points) {
  static constexpr double kMost = 1200;  // a screen cannot show longer rows
  const auto wanted = static_cast<double>(std::max<std::size_t>(points, 1));
  const double columns = std::sqrt(wanted * window.width() / window.height());
  const auto count = [](double n) {
    return static_cast<std::size_t>(std::clamp(std::round(n), 2.0, kMost));
  };
  return {window, count(columns), count(wanted / columns)};
}

FlowOnGrid flow_on_grid(const FlowField& flow, const Grid& grid, const FlowPeriods& periods) {
  assert(flow.velocity_x.size() == flow.x.size() && flow.velocity_y.size() == flow.x.size());
  assert(flow.pressure.size() == flow.x.size());
  FlowOnGrid found;
  for (auto* field : {&found.velocity_x, &found.velocity_y, &found.pressure})
    field->assign(grid.size(), kNoFlow);
  for_each_point(flow, grid, periods,
                 [&](std::size_t point, const auto& nodes, const auto& shape, const auto& shift) {
                   double u = 0, v = 0, pressure = 0;
                   for (std::size_t i = 0; i < shape.size(); ++i) {
                     const auto node = static_cast<std::size_t>(nodes[i]);
                     u += shape[i] * flow.velocity_x[node];
                     v += shape[i] * flow.velocity_y[node];
                     pressure += shape[i] * flow.pressure[node];
                   }
                   const auto& g = periods.gradient;
                   found.velocity_x[point] = u + (g[0] * shift[0] + g[1] * shift[1]);
                   found.velocity_y[point] = v + (g[2] * shift[0] + g[3] * shift[1]);
                   found.pressure[point] = pressure;
                 });
  return found;
}

std::vector<double> field_on_grid(const QuadraticMesh& mesh, const std::vector<double>& values,
                                  const Grid& grid) {
  assert(values.size() == mesh.x.size());
  std::vector<double> found(grid.size(), kNoFlow);
  for_each_point(mesh, grid, {},
                 [&](std::size_t point, const auto& nodes, const auto& shape, const auto&) {
                   found[point] = 0;
                   for (std::size_t i = 0; i < shape.size(); ++i)
                     found[point] += shape[i] * values[static_cast<std::size_t>(nodes[i])];
                 });
  return found;
}

void fill_next_to_known(std::vector<double>& values, std::size_t columns) {
  assert(columns >= 1 && values.size() % columns == 0);
  const auto inner = values;
  const auto rows = values.size() / columns;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      if (!std::isnan(inner[row * columns + column])) continue;
      double sum = 0;
      int count = 0;
      for (auto r = row - std::min<std::size_t>(row, 1); r <= std::min(row + 1, rows - 1); ++r)
        for (auto c = column - std::min<std::size_t>(column, 1);
             c <= std::min(column + 1, columns - 1); ++c)
          if (const double value = inner[r * columns + c]; !std::isnan(value)) {
            sum += value;
            ++count;
          }
      if (count > 0) values[row * columns + column] = sum / count;
    }
}

}  // namespace viscontact::report
