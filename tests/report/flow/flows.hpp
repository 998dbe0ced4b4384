// Flows on regular meshes of quadratic triangles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/report/flow/flow_grid.hpp"

namespace viscontact::report {

/// Velocity (u, v) and pressure at a point.
using FlowAt = std::function<std::array<double, 3>(double x, double y)>;

/// The flow at the nodes of a window that is divided into `parts` x `parts` rectangles of two
/// triangles each.
inline FlowField mesh_of(const Window& window, int parts, const FlowAt& at) {
  FlowField flow;
  const int side = 2 * parts + 1;  // nodes along a side, with the middles
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const double x = window.left + window.width() * i / (side - 1);
      const double y = window.bottom + window.height() * j / (side - 1);
      const auto [u, v, p] = at(x, y);
      flow.x.push_back(x);
      flow.y.push_back(y);
      flow.velocity_x.push_back(u);
      flow.velocity_y.push_back(v);
      flow.pressure.push_back(p);
    }
  const auto node = [&](int i, int j) { return static_cast<std::int32_t>(j * side + i); };
  for (int j = 0; j < side - 1; j += 2)
    for (int i = 0; i < side - 1; i += 2) {
      flow.triangles.push_back({node(i, j), node(i + 2, j), node(i + 2, j + 2), node(i + 1, j),
                                node(i + 2, j + 1), node(i + 1, j + 1)});
      flow.triangles.push_back({node(i, j), node(i + 2, j + 2), node(i, j + 2), node(i + 1, j + 1),
                                node(i + 1, j + 2), node(i, j + 1)});
    }
  return flow;
}

/// A rotation about (2, 1), the middle of the box [0, 4] x [0, 2]; the pressure rises along x.
inline std::array<double, 3> turning(double x, double y) { return {1 - y, x - 2, x - 2}; }

}  // namespace viscontact::report
