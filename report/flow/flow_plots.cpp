// Views, outlines, meshes, pressures and streamlines of the flow in the half-plane (rho, z), in the
// units of the case.
#include "viscontact/report/flow/flow_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

#include "viscontact/report/flow/pressure_colours.hpp"
#include "viscontact/report/flow/triangle_fields.hpp"
#include "viscontact/report/gnuplot.hpp"

namespace viscontact {
namespace {

// Sizes of the drawing [pixels].
constexpr double kPlotWidth = 640;
constexpr double kTallestPlot = 640;
constexpr double kStretchedPlot = 360;
constexpr double kLeft = 110, kAbove = 66, kBelow = 106;
constexpr double kColourBar = 165;  // at the right, with its numbers
constexpr double kNoColourBar = 30;

// Half the width of a gap's view, in units of sqrt(2 gap radius). There, the film over a plane is
// about 7 times as thick as in its middle.
constexpr double kGapReach = 2.5;

struct PlotView {
  Window window;
  double plot_width = 0, plot_height = 0;  // [pixels]
  /// How many times larger heights are drawn than widths.
  double stretch() const { return plot_height / window.height() / (plot_width / window.width()); }
};

/// A view with equal scales on both axes.
PlotView unstretched(const Window& window) {
  const double scale = std::min(kPlotWidth / window.width(), kTallestPlot / window.height());
  return {window, window.width() * scale, window.height() * scale};
}

double sphere_bottom(double radius, double gap, double rho) {
  return gap + radius - std::sqrt(std::max(0.0, radius * radius - rho * rho));
}

/// A view of the sphere and the fluid around it: the whole fluid if it extends at most 6 radii from
/// the axis and is at most 12 radii high, otherwise the fluid within 3.2 radii of the sphere's
/// centre.
PlotView surroundings(const CurvedMesh& mesh, double radius, double gap) {
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

/// A view of the gap; `reach` is half its width in units of sqrt(2 gap radius), the width of the
/// middle of the film.
PlotView gap_view(const CurvedMesh& mesh, double radius, double gap, double reach = kGapReach) {
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

void mirror(std::vector<Polyline>& lines) {
  const auto count = lines.size();
  for (std::size_t i = 0; i < count; ++i) {
    auto line = lines[i];
    for (auto& [rho, z] : line) rho = -rho;
    lines.push_back(std::move(line));
  }
}

/// The lines without points that are less than a pixel away from the point before them.
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

/// One curve, with interruptions, of the lines in rho >= 0 and their mirror images.
Curve mirrored(const std::string& legend, const std::string& style, std::vector<Polyline> lines) {
  mirror(lines);
  Curve curve{legend, style, {}};
  for (const auto& line : lines) {
    curve.points.insert(curve.points.end(), line.begin(), line.end());
    curve.points.emplace_back(0, std::nan(""));
  }
  return curve;
}

/// Adds the quadratic curve through the ends and the middle of a side, if it is near the window.
void add_side(std::vector<Polyline>& lines, const CurvedMesh& mesh, const Window& window,
              const std::array<std::size_t, 3>& side, int pieces) {
  const auto& start = mesh.nodes[side[0]];
  const auto& end = mesh.nodes[side[1]];
  const auto& middle = mesh.nodes[side[2]];
  const auto [left, right] = std::ranges::minmax({start[0], end[0], middle[0]});
  const auto [bottom, top] = std::ranges::minmax({start[1], end[1], middle[1]});
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

std::vector<Polyline> sides(const CurvedMesh& mesh, const Window& window, int pieces) {
  // Two triangles share a side; the key, the number of its middle, keeps each side once.
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

/// The sphere as a filled surface, and the walls and the neighbour as lines.
std::vector<Curve> outlines(const CurvedMesh& mesh, const PlotView& view, double radius,
                            double gap) {
  const auto& window = view.window;
  namespace label = boundary_label;
  // Straight pieces of a side of a triangle, and of the visible part of the sphere.
  constexpr int kPieces = 6, kSamples = 200;
  std::vector<Polyline> walls, shear_free;
  for (const auto& edge : mesh.boundary) {
    if (edge.label == label::kSphere || edge.label == label::kAxis ||
        edge.label == label::kInterface || edge.label == label::kFarInterface)
      continue;
    add_side(edge.label == label::kShearFree ? shear_free : walls, mesh, window, edge.nodes,
             kPieces);
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

/// A round number near `value`: 1, 2 or 5 times a power of ten.
double rounded(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  const double mantissa = value / decade;
  return decade * (mantissa < 1.5 ? 1 : mantissa < 3.5 ? 2 : mantissa < 7.5 ? 5 : 10);
}

/// The smallest and the largest value in the window.
std::pair<double, double> extremes(const LinearField& field, const Window& window) {
  std::pair<double, double> result = {std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < field.points.size(); ++i) {
    const auto& [rho, z] = field.points[i];
    if (rho > window.right || z < window.bottom || z > window.top) continue;
    result.first = std::min(result.first, field.values[i]);
    result.second = std::max(result.second, field.values[i]);
  }
  return result;
}

/// An arrow on the visible part of the sphere, in the direction of its velocity.
std::string velocity_arrow(const ForceTableRow& row, double radius, const Window& window) {
  constexpr double kLength = 0.4;  // in heights of the visible part
  const double top = std::min(row.gap + 2 * radius, window.top);
  const double middle = (row.gap + top) / 2;
  const double half = std::copysign(kLength / 2 * (top - row.gap), row.reference_velocity);
  return fmt::format(
      "set arrow from 0,{:.9g} to 0,{:.9g} front filled linewidth 4 linecolor rgb 'white'",
      middle - half, middle + half);
}

Curve streamlines(const Flow& flow, const PlotView& view) {
  constexpr int kLines = 14;  // about, on each side
  std::vector<std::array<double, 2>> gradient;
  for (std::size_t i = 0; i < flow.velocity.size(); ++i)
    gradient.push_back({flow.mesh.nodes[i][0] * flow.velocity[i][1],
                        -flow.mesh.nodes[i][0] * flow.velocity[i][0]});
  const auto field = straightened(flow.mesh, flow.stream_function, view.window, gradient);
  const auto [low, high] = extremes(field, view.window);
  if (!(high > low)) return {};
  const double step = rounded((high - low) / kLines);
  std::vector<Polyline> lines;
  for (double n = std::ceil(low / step); n <= high / step; ++n) {
    if (n == 0) continue;  // the axis and the surfaces at rest that it meets
    auto more = level_lines(field, n * step);
    std::ranges::move(more, std::back_inserter(lines));
  }
  return mirrored(fmt::format("streamlines; flow rate between one and the next: {:.3g} (unit: "
                              "length^3 / time)",
                              2 * std::numbers::pi * step),
                  "lines linewidth 1 linecolor rgb '#202020'", thinned(lines, view));
}

std::vector<std::string> layout(const PlotView& view, double right, double below, double width,
                                double height) {
  return {"unset grid", "set border linewidth 1 back", "set tics out nomirror",
          fmt::format("set lmargin at screen {:.6f}", kLeft / width),
          fmt::format("set rmargin at screen {:.6f}", 1 - right / width),
          fmt::format("set tmargin at screen {:.6f}", 1 - kAbove / height),
          fmt::format("set bmargin at screen {:.6f}", below / height),
          fmt::format("set xrange [{:.9g}:{:.9g}]", view.window.left, view.window.right),
          fmt::format("set yrange [{:.9g}:{:.9g}]", view.window.bottom, view.window.top),
          "set key at screen 0.5, screen 0.005 bottom center horizontal Left reverse samplen 3",
          "set xlabel offset 0,0.3",
          // The grey ground shows where there is no fluid.
          "set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#dedede' "
          "fillstyle solid noborder"};
}

Panel empty_panel(const std::string& what, const RowPicture& picture, const Tabulation& tabulation,
                  const PlotView& view) {
  constexpr double kVisible = 1.05;
  Panel panel;
  const auto container = container_in_words(tabulation);
  panel.title = fmt::format(
      "{} {:.6g} of a sphere of radius {:.6g} at velocity {:.6g}{}\n{}{}", what, picture.row.gap,
      tabulation.radius, picture.row.reference_velocity,
      view.stretch() > kVisible ? fmt::format(" (heights stretched {:.3g} times)", view.stretch())
                                : "",
      geometry_in_words(tabulation), container == "none" ? "" : "; " + container);
  panel.x_label = "distance from the axis (the case's unit of length)";
  panel.y_label = "height (the case's unit of length)";
  return panel;
}

std::string draw(Panel panel, const PlotView& view, double right) {
  constexpr double kLegendRow = 20;
  const auto legends =
      std::ranges::count_if(panel.curves, [](const Curve& curve) { return !curve.legend.empty(); });
  const double below = kBelow + kLegendRow * static_cast<double>(legends / 2);
  const double width = kLeft + view.plot_width + right;
  const double height = kAbove + view.plot_height + below;
  auto settings = layout(view, right, below, width, height);
  settings.insert(settings.end(), panel.settings.begin(), panel.settings.end());
  panel.settings = std::move(settings);
  return draw_svg({panel}, static_cast<int>(std::lround(width)),
                  static_cast<int>(std::lround(height)));
}

/// The values at the cells of the plot, which are about as small as an eye can see.
ColourField colour_field(const LinearField& values, const PlotView& view) {
  const auto& window = view.window;
  // Size of a cell [pixels]. The time of gnuplot is proportional to the number of cells.
  constexpr double kCell = 1.5;
  ColourField field{static_cast<std::size_t>(view.plot_width / kCell),
                    static_cast<std::size_t>(view.plot_height / kCell),
                    window.left,
                    window.right,
                    window.bottom,
                    window.top,
                    {}};
  field.values = pixels(values, window, field.columns, field.rows);
  return field;
}

std::string plot_pressure_and_streamlines(const std::string& what, const RowPicture& picture,
                                          const Tabulation& tabulation, const PlotView& view,
                                          const ColourField& pressure,
                                          const PressureColours& colours) {
  Panel panel = empty_panel(what, picture, tabulation, view);
  panel.field = pressure;
  for (double& value : panel.field->values) value = colours.at(value);
  panel.settings = colours.settings();
  panel.curves.push_back(streamlines(picture.flow, view));
  std::ranges::move(outlines(picture.flow.mesh, view, tabulation.radius, picture.row.gap),
                    std::back_inserter(panel.curves));
  panel.settings.push_back(velocity_arrow(picture.row, tabulation.radius, view.window));
  return draw(panel, view, kColourBar);
}

}  // namespace

std::string plot_mesh(const RowPicture& picture, const Tabulation& tabulation) {
  // Straight pieces of a side of the coarsest mesh; a side of the finest mesh has a quarter of
  // them.
  constexpr int kPieces = 8;
  constexpr std::size_t kMostSides = 3500;  // with more sides, the view is made narrower
  double reach = kGapReach;
  auto view = gap_view(picture.flow.mesh, tabulation.radius, picture.row.gap);
  auto fine = sides(picture.flow.mesh, view.window, kPieces / 4);
  while (fine.size() > kMostSides) {
    reach /= 2;
    const double right = view.window.right;
    view = gap_view(picture.flow.mesh, tabulation.radius, picture.row.gap, reach);
    if (!(view.window.right < right)) break;  // the height of a wide gap limits the view
    fine = sides(picture.flow.mesh, view.window, kPieces / 4);
  }
  Panel panel = empty_panel("Mesh in the gap", picture, tabulation, view);
  // A white field shows where the fluid is.
  const std::vector<double> white(picture.flow.mesh.nodes.size(), 0.0);
  panel.field = colour_field(straightened(picture.flow.mesh, white, view.window), view);
  panel.settings = {"set palette defined (0 'white', 1 'white')", "set cbrange [0:1]",
                    "unset colorbox"};
  panel.curves.push_back(
      mirrored("finest mesh", "lines linewidth 0.5 linecolor rgb '#56B4E9'", std::move(fine)));
  panel.curves.push_back(mirrored("coarsest mesh", "lines linewidth 1.4 linecolor rgb '#0072B2'",
                                  sides(picture.coarsest, view.window, kPieces)));
  std::ranges::move(outlines(picture.flow.mesh, view, tabulation.radius, picture.row.gap),
                    std::back_inserter(panel.curves));
  return draw(panel, view, kNoColourBar);
}

std::string plot_flow(const RowPicture& picture, const Tabulation& tabulation) {
  const auto& flow = picture.flow;
  const auto view = surroundings(flow.mesh, tabulation.radius, picture.row.gap);
  const auto field = straightened(flow.mesh, flow.pressure, view.window);
  const auto pressure = colour_field(field, view);
  const double usual =
      tabulation.viscosity * std::abs(picture.row.reference_velocity) / tabulation.radius;
  auto colours = robust_colours(pressure.values, usual);
  // A thin film may have no pixels, so the extremes are those of the triangles.
  std::tie(colours.smallest, colours.largest) = extremes(field, view.window);
  return plot_pressure_and_streamlines("Flow at gap", picture, tabulation, view, pressure, colours);
}

std::string plot_gap_flow(const RowPicture& picture, const Tabulation& tabulation) {
  const auto& flow = picture.flow;
  const auto view = gap_view(flow.mesh, tabulation.radius, picture.row.gap);
  const auto pressure = colour_field(straightened(flow.mesh, flow.pressure, view.window), view);
  return plot_pressure_and_streamlines("Flow in the gap", picture, tabulation, view, pressure,
                                       proportional_colours(pressure.values));
}

}  // namespace viscontact
