// Draws the speed of a flow as one filled region for each colour, where the speed is at least that
// of the colour, the slowest first (flow_picture.hpp).
#include "viscontact/report/particles/flow/flow_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/report/particles/flow/speed_colours.hpp"

namespace viscontact::report {
namespace {

constexpr int kBands = 20;  // colours of the speed

/// The speed on a grid with one more ring of points, which are at the places of the outermost
/// points and slower than all others. Therefore all level lines are closed.
LinearField closed_field(const Grid& grid, const FlowFrame& frame) {
  std::vector<double> speeds(frame.speed.begin(), frame.speed.end());
  // Regions without flow take the speed at their boundary; a solid is drawn over them.
  const auto is_unknown = [](double v) { return std::isnan(v); };
  for (auto layer = std::max(grid.columns, grid.rows);
       layer > 0 && std::ranges::any_of(speeds, is_unknown); --layer)
    fill_next_to_known(speeds, grid.columns);
  LinearField field;
  const auto columns = grid.columns + 2, rows = grid.rows + 2;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const auto i = std::clamp<std::size_t>(column, 1, grid.columns) - 1;
      const auto j = std::clamp<std::size_t>(row, 1, grid.rows) - 1;
      const bool is_added = i + 1 != column || j + 1 != row;
      field.points.push_back({grid.x(i), grid.y(j)});
      field.values.push_back(is_added ? -1 : speeds[j * grid.columns + i]);
    }
  for (std::size_t row = 0; row + 1 < rows; ++row)
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const auto a = static_cast<std::uint32_t>(row * columns + column);
      const auto c = static_cast<std::uint32_t>(a + columns);
      field.triangles.push_back({a, a + 1, c + 1});
      field.triangles.push_back({a, c + 1, c});
    }
  return field;
}

/// Appends a line as a path of SVG, without points less than half a page unit away from the one
/// before.
void append_path(std::string& path, const Polyline& line, const Projection& view) {
  constexpr double kNear = 0.5;
  double last_x = 0, last_y = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const particles::Vector at = {line[i].first, line[i].second, 0};
    const double x = view.x(at), y = view.y(at);
    if (i > 0 && i + 1 < line.size() && std::hypot(x - last_x, y - last_y) < kNear) continue;
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x, y);
    last_x = x;
    last_y = y;
  }
}

/// A head at point `at` of the line, in its direction.
std::string arrow_head(const Polyline& line, std::size_t at, const Projection& view) {
  constexpr double kLength = 5, kHalfWidth = 2.2;  // [page units]
  const particles::Vector tip = {line[at].first, line[at].second, 0};
  const particles::Vector tail = {line[at - 1].first, line[at - 1].second, 0};
  const double x = view.x(tip), y = view.y(tip), dx = x - view.x(tail), dy = y - view.y(tail);
  const double length = std::hypot(dx, dy);
  if (!(length > 0)) return "";
  const double a = kLength * dx / length, b = kLength * dy / length;
  const double c = -kHalfWidth * dy / length, d = kHalfWidth * dx / length;
  return fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}Z", x, y, x - a + c, y - b + d,
                     x - a - c, y - b - d);
}

std::string half_picture(const FlowFrames& flows, const FlowFrame& frame, const Projection& view) {
  const auto& window = flows.grid.window;
  const double left = view.x({window.left, 0, 0}), top = view.y({0, window.top, 0});
  auto text = fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", left,
      top, view.scale * window.width(), view.scale * window.height(), speed_colour(0));
  const auto speed = closed_field(flows.grid, frame);
  if (flows.top_speed > 0)
    for (int band = 1; band < kBands; ++band) {
      std::string path;
      for (const auto& line : level_lines(speed, flows.top_speed * band / kBands))
        append_path(path, line, view);
      if (!path.empty())
        text += fmt::format("<path fill=\"{}\" fill-rule=\"evenodd\" d=\"{}\"/>\n",
                            speed_colour(static_cast<double>(band) / (kBands - 1)), path);
    }
  std::string lines, arrows;
  for (const auto& line : frame.lines) {
    append_path(lines, line.points, view);
    if (line.arrow > 0)
      arrows += arrow_head(line.points, static_cast<std::size_t>(line.arrow), view);
  }
  return text + fmt::format(
                    "<path fill=\"none\" stroke=\"{0}\" stroke-opacity=\".6\" "
                    "stroke-width=\".7\" d=\"{1}\"/>\n<path fill=\"{0}\" fill-opacity=\".75\" "
                    "d=\"{2}\"/>\n",
                    kStreamLineColour, lines, arrows);
}

}  // namespace

std::string flow_picture(const FlowFrames& flows, const FlowFrame& frame, const Projection& view) {
  auto half = half_picture(flows, frame, view);
  if (!flows.has_axis) return half;
  return half + fmt::format("<g transform=\"translate({:.4f} 0) scale(-1 1)\">\n{}</g>\n",
                            2 * view.x({0, 0, 0}), half);
}

}  // namespace viscontact::report
