// Flows on regular meshes of quadratic triangles, and motions of particles in them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "tests/common/temporary_folder.hpp"
#include "tests/report/particles/playbacks.hpp"
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

/// A disc of radius 0.5 that moves along the middle of the box [0, 4] x [0, 2] in `frames` frames,
/// in a flow of the given velocity and pressure. The flows are files in the folder.
inline particles::Playback disc_in_flow(const TemporaryFolder& folder, int frames,
                                        const FlowAt& at) {
  particles::Playback playback;
  playback.radii = {0.5F};
  const auto file = folder.file("flow.vtu", write_flow(mesh_of({0, 4, 0, 2}, 16, at)));
  for (int f = 0; f < frames; ++f) {
    particles::Frame frame;
    frame.time = f;
    frame.positions = {1 + 2 * static_cast<float>(f) / static_cast<float>(frames), 1};
    frame.angles = {static_cast<float>(f)};
    frame.flow = file;
    playback.frames.push_back(frame);
  }
  return playback;
}

/// A rotation about (2, 1), the middle of the box [0, 4] x [0, 2]; the pressure rises along x.
inline std::array<double, 3> turning(double x, double y) { return {1 - y, x - 2, x - 2}; }

}  // namespace viscontact::report
