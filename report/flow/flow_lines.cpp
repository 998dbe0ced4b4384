// Chooses the parts of the flow that pictures show, and computes the curves in them: sides of
// triangles, outlines of bodies and streamlines (flow_lines.hpp). Lengths are in [L].
#include "viscontact/report/flow/flow_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

namespace viscontact::report {
namespace {

// Sizes of the drawing [pixels].
constexpr double kPlotWidth = 640;
constexpr double kTallestPlot = 640;
constexpr double kStretchedPlot = 360;

/// A view with equal scales on both axes.
PlotView unstretched(const Window& window) {
  const double scale = std::min(kPlotWidth / window.width(), kTallestPlot / window.height());
  return {window, window.width() * scale, window.height() * scale};
}

double sphere_bottom(double radius, double gap, double rho) {
  return gap + radius - std::sqrt(std::max(0.0, radius * radius - rho * rho));
}

/// The lines, without the points that are less than a pixel away from the point before them.
std::vector<Polyline> thinned(const std::vector<Polyline>& lines, const PlotView& view) {
  const double x_scale = view.plot_width / view.window.width();
  const double y_scale = view.plot_height / view.window.height();
  std::vector<Polyline> result;
  for (const auto& line : lines) {
    Polyline kept;
    for (std::size_t i = 0; i < line.size(); ++i)
      if (i == 0 || i + 1 == line.size() ||
          std::hypot((line[i].first - kept.back().first) * x_scale,
                     (line[i].second - kept.back().second) * y_scale) >= 1)
        kept.push_back(line[i]);
    result.push_back(std::move(kept));
  }
  return result;
}

/// Adds the quadratic curve through the ends and the middle of a side, if it is near the window.
void add_side(std::vector<Polyline>& lines, const freefem_axi::CurvedMesh& mesh,
              const Window& window, const std::array<std::size_t, 3>& side, int pieces) {
  const auto& start = mesh.nodes[side[0]];
  const auto& end = mesh.nodes[side[1]];
  const auto& middle = mesh.nodes[side[2]];
  const auto [left, right] = std::minmax({start[0], end[0], middle[0]});
  const auto [bottom, top] = std::minmax({start[1], end[1], middle[1]});
  if (left > window.right || bottom > window.top || top < window.bottom) return;
  Polyline line;
  for (int i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const double a = (1 - t) * (1 - 2 * t), b = t * (2 * t - 1), c = 4 * t * (1 - t);
    line.emplace_back(a * start[0] + b * end[0] + c * middle[0],
                      a * start[1] + b * end[1] + c * middle[1]);
  }
  lines.push_back(std::move(line));
}

/// A round number near `value`: 1, 2 or 5 times a power of ten.
double rounded(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  const double mantissa = value / decade;
  return decade * (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10);
}

}  // namespace

PlotView surroundings(const freefem_axi::CurvedMesh& mesh, double radius, double gap) {
  constexpr double kReach = 3.2, kWhole = 6, kMargin = 0.15;  // in radii
  Window fluid;
  for (const auto& [rho, z] : mesh.nodes)
    fluid = {0, std::max(fluid.right, rho), std::min(fluid.bottom, z), std::max(fluid.top, z)};
  const double margin = kMargin * radius, centre = gap + radius;
  const bool whole = fluid.right <= kWhole * radius && fluid.height() <= 2 * kWhole * radius;
  const double reach = kReach * radius;
  return whole ? unstretched({-fluid.right - margin, fluid.right + margin, fluid.bottom - margin,
                              fluid.top + margin})
               : unstretched({-std::min(reach, fluid.right + margin),
                              std::min(reach, fluid.right + margin),
                              std::max(centre - reach, fluid.bottom - margin),
                              std::min(centre + reach, fluid.top + margin)});
}

PlotView gap_view(const freefem_axi::CurvedMesh& mesh, double radius, double gap, double reach) {
  constexpr double kOfSphere = 0.9;  // of the radius, at most
  constexpr double kMargin = 0.08;   // of the height
  constexpr double kFlattest = 0.4;  // of a view drawn at equal scales
  const double half = std::min(reach * std::sqrt(2 * gap * radius), kOfSphere * radius);
  const double top = sphere_bottom(radius, gap, half);
  double bottom = 0;
  for (const auto& [rho, z] : mesh.nodes)
    if (rho < half && z > -top) bottom = std::min(bottom, z);
  const double margin = kMargin * (top - bottom);
  Window window{-half, half, bottom - margin, top + margin};
  const double widest = std::max(half, window.height() / 2);  // the view is not higher than wide
  window.left = -widest;
  window.right = widest;
  if (window.height() > kFlattest * window.width()) return unstretched(window);
  return {window, kPlotWidth, kStretchedPlot};
}

Curve mirrored(const std::string& legend, const std::string& style,
               const std::vector<Polyline>& lines) {
  Curve curve{legend, style, {}};
  for (const double side : {1.0, -1.0})
    for (const auto& line : lines) {
      for (const auto& [rho, z] : line) curve.points.emplace_back(side * rho, z);
      curve.points.emplace_back(0, std::nan(""));
    }
  return curve;
}

std::vector<Polyline> sides(const freefem_axi::CurvedMesh& mesh, const Window& window, int pieces) {
  // Two triangles share a side. The map has each side once, by the number of its middle node.
  std::map<std::size_t, std::array<std::size_t, 3>> by_middle;
  for (const auto& [v0, v1, v2, m0, m1, m2] : mesh.triangles) {
    by_middle[m0] = {v1, v2, m0};
    by_middle[m1] = {v2, v0, m1};
    by_middle[m2] = {v0, v1, m2};
  }
  std::vector<Polyline> lines;
  for (const auto& [middle, side] : by_middle) add_side(lines, mesh, window, side, pieces);
  return lines;
}

std::vector<Curve> outlines(const freefem_axi::CurvedMesh& mesh, const PlotView& view,
                            double radius, double gap) {
  const auto& window = view.window;
  // Straight pieces of a side of a triangle, and of the visible part of the sphere.
  constexpr int kPieces = 6, kSamples = 200;
  std::vector<Polyline> walls, shear_free;
  for (const auto& edge : mesh.boundary) {
    if (edge.kind == freefem_axi::BoundaryKind::kWall ||
        edge.kind == freefem_axi::BoundaryKind::kShearFree)
      add_side(edge.kind == freefem_axi::BoundaryKind::kShearFree ? shear_free : walls, mesh,
               window, edge.nodes, kPieces);
  }
  // The part of the sphere that is in the window, as a curve that is closed far above the window.
  Curve sphere{
      "", "filledcurves closed fillcolor rgb '#8c8c8c' fillstyle solid border rgb '#000000'", {}};
  const double half = window.right < radius ? std::asin(window.right / radius) : std::numbers::pi;
  for (int i = 0; i <= kSamples; ++i) {
    const double angle = half * (2.0 * i / kSamples - 1);
    sphere.points.emplace_back(radius * std::sin(angle), gap + radius * (1 - std::cos(angle)));
  }
  if (half < std::numbers::pi) {
    sphere.points.emplace_back(sphere.points.back().first, window.top);
    sphere.points.emplace_back(sphere.points.front().first, window.top);
  }
  std::vector<Curve> curves = {sphere};
  if (!walls.empty())
    curves.push_back(
        mirrored("", "lines linewidth 2 linecolor rgb '#000000'", thinned(walls, view)));
  if (!shear_free.empty())
    curves.push_back(mirrored("shear-free surface",
                              "lines linewidth 2.5 linecolor rgb '#009E73' dashtype (12,5)",
                              thinned(shear_free, view)));
  return curves;
}

Curve streamlines(const freefem_axi::Flow& flow, const PlotView& view) {
  constexpr int kLines = 14;  // approximate number on each side of the axis
  std::vector<std::array<double, 2>> gradient;
  for (std::size_t i = 0; i < flow.velocity.size(); ++i)
    gradient.push_back({flow.mesh.nodes[i][0] * flow.velocity[i][1],
                        -flow.mesh.nodes[i][0] * flow.velocity[i][0]});
  const auto field = straightened(flow.mesh, flow.stream_function, view.window, gradient);
  const auto [low, high] = extremes(field, view.window);
  if (!(high > low)) return {};
  const double step = rounded((high - low) / kLines);
  std::vector<Polyline> lines;
  const int last = static_cast<int>(std::floor(high / step));
  for (int n = static_cast<int>(std::ceil(low / step)); n <= last; ++n) {
    if (n == 0) continue;  // psi = 0 on the axis and on surfaces at rest that meet it
    auto more = level_lines(field, n * step);
    std::ranges::move(more, std::back_inserter(lines));
  }
  return mirrored(fmt::format("streamlines; flow rate between neighbouring ones: {:.3g} (unit: "
                              "length^3 / time)",
                              2 * std::numbers::pi * step),
                  "lines linewidth 1 linecolor rgb '#202020'", thinned(lines, view));
}

}  // namespace viscontact::report
