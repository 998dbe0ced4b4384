// Reads flows one after the other, because all of them may be too large for the memory, and chooses
// the scales of their colours (flow_frames.hpp).
#include "viscontact/report/particles/flow/flow_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viscontact/common/vtk/flow_vtk.hpp"

namespace viscontact::report {
namespace {

using particles::Frame;
using particles::Playback;

/// Whether each point of the grid is in a particle, or in an image of it.
std::vector<char> points_in_bodies(const Grid& grid, const Playback& playback, const Frame& frame) {
  std::vector<char> is_body(grid.size(), 0);
  const auto range = [](double low, double high, double from, double step, std::size_t count) {
    const auto place = [&](double x) {
      return static_cast<std::size_t>(
          std::clamp(std::ceil((x - from) / step), 0.0, static_cast<double>(count)));
    };
    return std::pair(place(low), place(high));
  };
  const auto& window = grid.window;
  for (std::size_t k = 0; k < playback.radii.size(); ++k)
    for (std::int32_t image = -particles::kLargestImage; image <= particles::kLargestImage;
         ++image) {
      const auto shift = shift_of(playback.cell, image);
      if (image != 0 && shift[0] == 0 && shift[1] == 0) continue;
      const auto centre = position(playback, frame, k);
      const double x = centre[0] + shift[0], y = centre[1] + shift[1], r = playback.radii[k];
      const auto [left, right] = range(x - r, x + r, window.left, grid.step_x(), grid.columns);
      const auto [bottom, top] = range(y - r, y + r, window.bottom, grid.step_y(), grid.rows);
      for (auto row = bottom; row < top; ++row)
        for (auto column = left; column < right; ++column)
          if (std::hypot(grid.x(column) - x, grid.y(row) - y) <= r)
            is_body[row * grid.columns + column] = 1;
    }
  return is_body;
}

/// Collects values of points outside the particles, about as many of each frame.
struct Samples {
  std::vector<double> values;

  void add(const std::vector<float>& field, const std::vector<char>& is_body) {
    constexpr std::size_t kOfFrame = 4000;
    const auto every = field.size() / kOfFrame + 1;
    for (std::size_t i = 0; i < field.size(); i += every)
      if (is_body[i] == 0 && std::isfinite(field[i])) values.push_back(field[i]);
  }

  /// The value that the given share of the samples does not exceed; 0 if there is none.
  double quantile(double share) {
    if (values.empty()) return 0;
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
  }
};

/// The mean value at the points outside the particles; 0 if there is no such point.
double mean_outside(const std::vector<double>& field, const std::vector<char>& is_body) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < field.size(); ++i)
    if (is_body[i] == 0 && std::isfinite(field[i])) {
      sum += field[i];
      ++count;
    }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

/// The place of a plane whose components are z and the distance from the axis, in the plane (x, z).
particles::PlanePosition in_half_plane(const particles::PlanePosition& plane, double side) {
  return {{side * plane.point[1], plane.point[0], 0},
          {side * plane.normal[1], plane.normal[0], 0},
          plane.radius};
}

}  // namespace

Playback in_plane(const Playback& playback) {
  if (playback.dimension != 1) return playback;
  auto plane = playback;
  plane.dimension = 2;
  for (auto& frame : plane.frames) {
    std::vector<float> positions;
    for (const float z : frame.positions) positions.insert(positions.end(), {0, z});
    frame.positions = std::move(positions);
    // Contacts name planes by their numbers, so mirror images come last.
    std::vector<particles::PlanePosition> planes, images;
    for (const auto& wall : frame.planes) {
      planes.push_back(in_half_plane(wall, 1));
      if (wall.normal[1] != 0) images.push_back(in_half_plane(wall, -1));
    }
    planes.insert(planes.end(), images.begin(), images.end());
    frame.planes = std::move(planes);
  }
  return plane;
}

std::optional<Window> flow_extent(const Playback& in_plane, bool has_axis) {
  for (const auto& frame : in_plane.frames) {
    if (frame.flow.empty()) continue;
    const auto flow = read_flow(frame.flow);
    if (flow.triangles.empty()) continue;
    const auto [left, right] = std::ranges::minmax(flow.x);
    const auto [bottom, top] = std::ranges::minmax(flow.y);
    Window window{has_axis ? -right : left, right, bottom, top};
    const auto& cell = in_plane.cell;
    if (cell.lengths[0] > 0) {
      window.left = cell.from[0];
      window.right = cell.from[0] + cell.lengths[0];
    }
    if (cell.lengths[1] > 0) {
      window.bottom = cell.from[1];
      window.top = cell.from[1] + cell.lengths[1];
    }
    return window;
  }
  return {};
}

std::optional<ViewBox> box_of(const std::optional<Window>& extent) {
  if (!extent) return {};
  return ViewBox{{extent->left, extent->bottom, 0}, {extent->right, extent->top, 0}};
}

Window common_part(const Window& extent, const ViewBox& view) {
  return {std::max(extent.left, view.low[0]), std::min(extent.right, view.high[0]),
          std::max(extent.bottom, view.low[1]), std::min(extent.top, view.high[1])};
}

FlowFrames read_flows(const Playback& in_plane, bool has_axis, const Window& window,
                      const std::vector<std::size_t>& frames, std::size_t points) {
  constexpr int kLines = 18;  // streamlines in a picture, about
  FlowFrames flows;
  flows.has_axis = has_axis;
  flows.grid =
      grid_of({has_axis ? 0 : window.left, window.right, window.bottom, window.top}, points);
  StreamLines stream_lines(flows.grid, has_axis);
  Samples speeds, pressures;
  for (const auto f : frames) {
    const auto& frame = in_plane.frames[f];
    if (frame.flow.empty()) continue;
    const auto field = read_flow(frame.flow);
    if (field.triangles.empty()) continue;
    const auto flow = flow_on_grid(field, flows.grid, in_plane.cell);
    const auto is_body = points_in_bodies(flows.grid, in_plane, frame);
    FlowFrame found;
    found.frame = f;
    for (std::size_t i = 0; i < flows.grid.size(); ++i)
      found.speed.push_back(static_cast<float>(std::hypot(flow.velocity_x[i], flow.velocity_y[i])));
    const double mean = mean_outside(flow.pressure, is_body);
    for (const double pressure : flow.pressure)
      found.pressure.push_back(static_cast<float>(pressure - mean));
    found.lines = stream_lines.of(flow, is_body, has_axis ? kLines * 2 / 3 : kLines).lines;
    speeds.add(found.speed, is_body);
    pressures.add(found.pressure, is_body);
    flows.frames.push_back(std::move(found));
  }
  flows.top_speed = speeds.quantile(0.999);
  auto sizes = pressures;
  for (double& value : sizes.values) value = std::abs(value);
  flows.pressure_colours = robust_colours(pressures.values, sizes.quantile(0.5));
  return flows;
}

}  // namespace viscontact::report
