// Interpolates a flow at the points of a grid (flow_grid.hpp). A quadratic triangle is found by the
// four straight triangles between its six nodes; the value at the point is that of the quadratic
// shape functions. The numbering of the nodes is that of FlowField.
#include "viscontact/report/particles/flow/flow_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "viscontact/report/flow/pixel_scan.hpp"

namespace viscontact::report {
namespace {

using particles::FlowField;

constexpr double kNoFlow = std::numeric_limits<double>::quiet_NaN();

/// Places of the six nodes in the reference triangle (0, 0), (1, 0), (0, 1).
constexpr std::array<std::array<double, 2>, 6> kReference = {
    {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
constexpr std::array<std::array<std::size_t, 3>, 4> kFour = {
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}};

/// The quadratic shape functions of the six nodes at a place of the reference triangle.
std::array<double, 6> shape_functions(double a, double b) {
  const double c = 1 - a - b;
  return {c * (2 * c - 1), a * (2 * a - 1), b * (2 * b - 1), 4 * c * a, 4 * a * b, 4 * b * c};
}

/// Shifts by which the images of the flow are drawn, along one axis.
std::vector<double> shifts(double period) {
  return period > 0 ? std::vector<double>{-period, 0, period} : std::vector<double>{0};
}

}  // namespace

Grid grid_of(const Window& window, std::size_t points) {
  static constexpr double kMost = 1200;  // a longer row could not be seen on a screen
  const auto wanted = static_cast<double>(points);
  const double columns = std::sqrt(wanted * window.width() / window.height());
  const auto count = [](double n) {
    return static_cast<std::size_t>(std::clamp(std::round(n), 2.0, kMost));
  };
  return {window, count(columns), count(wanted / columns)};
}

FlowOnGrid flow_on_grid(const FlowField& flow, const Grid& grid,
                        const particles::PeriodicCell& cell) {
  FlowOnGrid found;
  for (auto* field : {&found.velocity_x, &found.velocity_y, &found.pressure})
    field->assign(grid.size(), kNoFlow);
  const auto window = grid.pixel_window();
  const auto shifts_x = shifts(cell.lengths[0]), shifts_y = shifts(cell.lengths[1]);
  for (const auto& nodes : flow.triangles)
    for (const double shift_x : shifts_x)
      for (const double shift_y : shifts_y)
        for (const auto& part : kFour) {
          std::array<double, 3> x{}, y{};
          for (std::size_t i = 0; i < 3; ++i) {
            const auto node = static_cast<std::size_t>(nodes[part[i]]);
            x[i] = flow.x[node] + shift_x;
            y[i] = flow.y[node] + shift_y;
          }
          for_each_pixel(x, y, window, grid.columns, grid.rows,
                         [&](std::size_t point, double w1, double w2) {
                           const std::size_t p = part[0], q = part[1], r = part[2];
                           const auto at = [&](std::size_t d) {
                             return kReference[p][d] + w1 * (kReference[q][d] - kReference[p][d]) +
                                    w2 * (kReference[r][d] - kReference[p][d]);
                           };
                           const auto shape = shape_functions(at(0), at(1));
                           double u = 0, v = 0, pressure = 0;
                           for (std::size_t i = 0; i < shape.size(); ++i) {
                             const auto node = static_cast<std::size_t>(nodes[i]);
                             u += shape[i] * flow.velocity_x[node];
                             v += shape[i] * flow.velocity_y[node];
                             pressure += shape[i] * flow.pressure[node];
                           }
                           const auto added = velocity_at(cell, {shift_x, shift_y, 0});
                           u += added[0];
                           v += added[1];
                           found.velocity_x[point] = u;
                           found.velocity_y[point] = v;
                           found.pressure[point] = pressure;
                         });
        }
  return found;
}

}  // namespace viscontact::report
