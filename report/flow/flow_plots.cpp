// The flow was computed in the half-plane of the distance rho from the axis and the height z;
// pictures also show its mirror image. Sizes on the picture are in pixels.
#include "viscontact/report/flow/flow_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "viscontact/report/flow/flow_grid.hpp"
#include "viscontact/report/flow/stream_lines.hpp"
#include "viscontact/report/pictures/colours.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"

namespace viscontact::report {
namespace {

/// Free choices of the pictures, by eye.
struct FlowPlotTuning {
  // Width of a plot, its largest height, and its height if heights are stretched [pixels].
  static constexpr double kPlotWidth = 640, kTallestPlot = 640, kStretchedPlot = 360;
  // Margins of the drawing around the plot [pixels].
  static constexpr double kLeft = 110, kAbove = 66, kBelow = 106;
  // Margin at the right with the scale of colours and its numbers, and without [pixels].
  static constexpr double kColourBar = 165, kNoColourBar = 30;
  // Height of two entries of the legend [pixels].
  static constexpr double kLegendRow = 20;
  // Size of a cell of one colour [pixels]. gnuplot's time is proportional to the number of cells.
  static constexpr double kCell = 1.5;

  // Distance from the sphere's centre in the view of the surroundings, half the size of a fluid
  // that is shown as a whole, and the margin around it, in radii.
  static constexpr double kReach = 3.2, kWhole = 6, kMarginOfWhole = 0.15;
  // Half the width of the view of a gap, in units of sqrt(2 gap radius). At one such unit from the
  // axis, the film over a plane is twice as thick as on the axis, at 2.5 units 7 times.
  static constexpr double kGapReach = 2.5;
  // Largest half width of the view of a gap over the radius.
  static constexpr double kOfSphere = 0.9;
  // Margin above and below the gap over its height.
  static constexpr double kMarginOfGap = 0.08;
  // Least height over width of a view with equal scales.
  static constexpr double kFlattest = 0.4;
  // Stretching of heights from which on the title says it.
  static constexpr double kVisible = 1.05;

  // Straight pieces of a side on an outline, and intervals of the sphere's outline.
  static constexpr int kPiecesOfOutline = 6, kSamples = 200;
  // Straight pieces of a side of the coarsest mesh. A side of the finest mesh is at most a quarter
  // as long and has a quarter of the pieces.
  static constexpr int kPiecesOfMesh = 8;
  // If more sides of the finest mesh are in the view of a gap, the view is made narrower.
  static constexpr std::size_t kMostSides = 3500;
  // About this number of streamlines on each side of the axis.
  static constexpr int kLines = 14;
  // Length of the arrow on the sphere over the height of the visible part.
  static constexpr double kArrow = 0.4;
  // Columns of arrows in the fluid.
  static constexpr std::size_t kColumns = 24;
  // Length of the longest of these arrows, and of the shortest that is drawn, in cells.
  static constexpr double kLongestArrow = 0.9, kShortestArrow = 0.1;
  // Length of an arrow's head over that of the arrow, and half the angle of the head [rad].
  static constexpr double kHead = 0.35, kAngle = 0.45;
};

struct PlotView {
  Window window;
  double plot_width = 0, plot_height = 0;  // [pixels]
  /// How many times larger heights are drawn than widths.
  double stretch() const { return plot_height / window.height() / (plot_width / window.width()); }
};

/// A view with equal scales on both axes, as large as the limits of a plot allow.
PlotView unstretched(const Window& window) {
  const double scale = std::min(FlowPlotTuning::kPlotWidth / window.width(),
                                FlowPlotTuning::kTallestPlot / window.height());
  return {window, window.width() * scale, window.height() * scale};
}

/// Height z of the lower side of the sphere at the distance rho from the axis [L].
double sphere_bottom(double radius, double gap, double rho) {
  return gap + radius - std::sqrt(std::max(0.0, radius * radius - rho * rho));
}

/// Leaves out points less than a pixel away from the last one, except the ends of each line.
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

/// Adds a side of a triangle to `lines` [L], unless it is to the right of the window, above it or
/// below it. The side is the parabola through its ends (nodes side[0] and side[1]) and its middle
/// (node side[2]), drawn as `pieces` >= 1 straight pieces.
void add_side(std::vector<Polyline>& lines, const QuadraticMesh& mesh, const Window& window,
              const std::array<std::size_t, 3>& side, int pieces) {
  assert(pieces >= 1);
  const auto at = [&](std::size_t place) {
    return std::array<double, 2>{mesh.x[side.at(place)], mesh.y[side.at(place)]};
  };
  const auto start = at(0), end = at(1), middle = at(2);
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

/// The whole fluid if it extends at most kWhole radii from the axis and is at most twice as high,
/// else the part within kReach radii of the sphere's centre.
PlotView surroundings(const QuadraticMesh& mesh, double radius, double gap) {
  const Window fluid{0, std::ranges::max(mesh.x), std::min(0.0, std::ranges::min(mesh.y)),
                     std::max(0.0, std::ranges::max(mesh.y))};
  const double margin = FlowPlotTuning::kMarginOfWhole * radius, centre = gap + radius;
  const bool whole = fluid.right <= FlowPlotTuning::kWhole * radius &&
                     fluid.height() <= 2 * FlowPlotTuning::kWhole * radius;
  const double reach = FlowPlotTuning::kReach * radius;
  return whole ? unstretched({-fluid.right - margin, fluid.right + margin, fluid.bottom - margin,
                              fluid.top + margin})
               : unstretched({-std::min(reach, fluid.right + margin),
                              std::min(reach, fluid.right + margin),
                              std::max(centre - reach, fluid.bottom - margin),
                              std::min(centre + reach, fluid.top + margin)});
}

/// A view of the gap on both sides of the axis. Its half width is `reach` times the unit of
/// kGapReach, but at most kOfSphere radii, and at least half of its height. Heights are stretched
/// if the gap would be too flat at equal scales.
PlotView gap_view(const QuadraticMesh& mesh, double radius, double gap,
                  double reach = FlowPlotTuning::kGapReach) {
  assert(radius > 0 && gap > 0);
  const double half =
      std::min(reach * std::sqrt(2 * gap * radius), FlowPlotTuning::kOfSphere * radius);
  const double top = sphere_bottom(radius, gap, half);
  double bottom = 0;
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    if (mesh.x[i] < half && mesh.y[i] > -top) bottom = std::min(bottom, mesh.y[i]);
  const double margin = FlowPlotTuning::kMarginOfGap * (top - bottom);
  Window window{-half, half, bottom - margin, top + margin};
  const double widest = std::max(half, window.height() / 2);
  window.left = -widest;
  window.right = widest;
  if (window.height() > FlowPlotTuning::kFlattest * window.width()) return unstretched(window);
  return {window, FlowPlotTuning::kPlotWidth, FlowPlotTuning::kStretchedPlot};
}

/// The lines and their mirror images at rho < 0 as one curve, in which a NaN separates two lines.
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

std::vector<Polyline> sides(const QuadraticMesh& mesh, const Window& window, int pieces) {
  // Two triangles share a side, which is stored once, under the number of its middle node.
  std::map<std::int32_t, std::array<std::size_t, 3>> by_middle;
  for (const auto& nodes : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      by_middle[nodes.at(3 + i)] = {static_cast<std::size_t>(nodes.at(i)),
                                    static_cast<std::size_t>(nodes.at((i + 1) % 3)),
                                    static_cast<std::size_t>(nodes.at(3 + i))};
  std::vector<Polyline> lines;
  for (const auto& [middle, side] : by_middle) add_side(lines, mesh, window, side, pieces);
  return lines;
}

std::vector<Curve> outlines(const freefem_axi::RowPicture& picture, const PlotView& view,
                            double radius) {
  const double gap = picture.gap;
  const auto& window = view.window;
  std::vector<Polyline> walls, shear_free;
  for (const auto& edge : picture.boundary) {
    if (edge.kind == freefem_axi::BoundaryKind::kWall ||
        edge.kind == freefem_axi::BoundaryKind::kShearFree)
      add_side(edge.kind == freefem_axi::BoundaryKind::kShearFree ? shear_free : walls,
               picture.flow, window, edge.nodes, FlowPlotTuning::kPiecesOfOutline);
  }
  Curve sphere{
      "", "filledcurves closed fillcolor rgb '#8c8c8c' fillstyle solid border rgb '#000000'", {}};
  const double half = window.right < radius ? std::asin(window.right / radius) : std::numbers::pi;
  for (int i = 0; i <= FlowPlotTuning::kSamples; ++i) {
    const double angle = half * (2.0 * i / FlowPlotTuning::kSamples - 1);
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

/// gnuplot's command for an arrow on the visible part of the sphere, upwards for a velocity > 0.
std::string velocity_arrow(const freefem_axi::RowPicture& row, double radius,
                           const Window& window) {
  const double top = std::min(row.gap + 2 * radius, window.top);
  const double middle = (row.gap + top) / 2;
  const double half =
      std::copysign(FlowPlotTuning::kArrow / 2 * (top - row.gap), row.reference_velocity);
  return fmt::format(
      "set arrow from 0,{:.9g} to 0,{:.9g} front filled linewidth 4 linecolor rgb 'white'",
      middle - half, middle + half);
}

/// gnuplot's commands for the axes and margins of a picture; all sizes in [pixels].
std::vector<std::string> layout(const PlotView& view, double right, double below, double width,
                                double height) {
  return {"unset grid", "set border linewidth 1 back", "set tics out nomirror",
          fmt::format("set lmargin at screen {:.6f}", FlowPlotTuning::kLeft / width),
          fmt::format("set rmargin at screen {:.6f}", 1 - right / width),
          fmt::format("set tmargin at screen {:.6f}", 1 - FlowPlotTuning::kAbove / height),
          fmt::format("set bmargin at screen {:.6f}", below / height),
          fmt::format("set xrange [{:.9g}:{:.9g}]", view.window.left, view.window.right),
          fmt::format("set yrange [{:.9g}:{:.9g}]", view.window.bottom, view.window.top),
          "set key at screen 0.5, screen 0.005 bottom center horizontal Left reverse samplen 3",
          "set xlabel offset 0,0.3",
          // Grey behind everything shows where there is no fluid.
          ("set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#dedede' "
           "fillstyle solid noborder")};
}

/// The words of a title that name the motion; the value of the velocity follows them.
std::string motion_in_words(lubrication::MotionKind motion) {
  using lubrication::MotionKind;
  if (motion == MotionKind::kApproach) return " at velocity";
  return motion == MotionKind::kSlide  ? ", sliding at velocity"
         : motion == MotionKind::kRoll ? ", rolling at angular velocity"
                                       : ", spinning at angular velocity";
}

/// The title says how many times heights are stretched if that can be seen.
Panel empty_panel(const std::string& what, const freefem_axi::RowPicture& picture,
                  const freefem_axi::Tabulation& tabulation, const PlotView& view) {
  Panel panel;
  const auto container = freefem_axi::container_in_words(tabulation);
  panel.title = fmt::format(
      "{} {:.6g} of a sphere of radius {:.6g}{} {:.6g}{}\n{}{}", what, picture.gap,
      tabulation.radius, motion_in_words(picture.motion), picture.reference_velocity,
      view.stretch() > FlowPlotTuning::kVisible
          ? fmt::format(" (heights stretched {:.3g} times)", view.stretch())
          : "",
      freefem_axi::geometry_in_words(tabulation), container == "none" ? "" : "; " + container);
  panel.x_label = "distance from the axis (the case's unit of length)";
  panel.y_label = "height (the case's unit of length)";
  return panel;
}

/// The SVG. The margin below grows with every two entries of the legend.
std::string draw(Panel panel, const PlotView& view, double right, const StopToken& stop) {
  const auto legends =
      std::ranges::count_if(panel.curves, [](const Curve& curve) { return !curve.legend.empty(); });
  const auto legend_rows = legends / 2;
  const double below =
      FlowPlotTuning::kBelow + FlowPlotTuning::kLegendRow * static_cast<double>(legend_rows);
  const double width = FlowPlotTuning::kLeft + view.plot_width + right;
  const double height = FlowPlotTuning::kAbove + view.plot_height + below;
  auto settings = layout(view, right, below, width, height);
  settings.insert(settings.end(), panel.settings.begin(), panel.settings.end());
  panel.settings = std::move(settings);
  return draw_svg({panel}, static_cast<int>(std::lround(width)),
                  static_cast<int>(std::lround(height)), stop);
}

/// The flow on a grid of the half-plane whose points are the centres of cells of one colour.
struct ViewedFlow {
  PlotView view;
  Grid grid;
  FlowOnGrid flow;
};

/// The grid of the right half (rho > 0) of the view.
Grid grid_of_view(const PlotView& view) {
  const auto columns = static_cast<std::size_t>(view.plot_width / 2 / FlowPlotTuning::kCell);
  const auto rows = static_cast<std::size_t>(view.plot_height / FlowPlotTuning::kCell);
  const double half_width = view.window.right / static_cast<double>(columns) / 2;
  const double half_height = view.window.height() / static_cast<double>(rows) / 2;
  return {{half_width, view.window.right - half_width, view.window.bottom + half_height,
           view.window.top - half_height},
          columns,
          rows};
}

ViewedFlow flow_in(const PlotView& view, const FlowField& flow) {
  const auto grid = grid_of_view(view);
  return {view, grid, flow_on_grid(flow, grid)};
}

/// The values and their mirror images at the left of the axis; NaN outside the fluid.
ColourField colour_field(std::vector<double> values, const Grid& grid, const PlotView& view) {
  // The boundary of the fluid may cross a cell whose centre is outside the fluid.
  fill_next_to_known(values, grid.columns);
  const auto& window = view.window;
  ColourField field{2 * grid.columns, grid.rows,  window.left, window.right,
                    window.bottom,    window.top, {}};
  for (std::size_t row = 0; row < grid.rows; ++row) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * grid.columns);
    const auto end = first + static_cast<std::ptrdiff_t>(grid.columns);
    field.values.insert(field.values.end(), std::reverse_iterator(end),
                        std::reverse_iterator(first));
    field.values.insert(field.values.end(), first, end);
  }
  return field;
}

/// The extremes at the nodes in the window; infinity and -infinity if no node is in it.
std::pair<double, double> extremes(const QuadraticMesh& mesh, const std::vector<double>& values,
                                   const Window& window) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (mesh.x[i] <= window.right && mesh.y[i] >= window.bottom && mesh.y[i] <= window.top) {
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
    }
  return {low, high};
}

Curve streamlines(const ViewedFlow& viewed, double radius, double gap) {
  const auto& grid = viewed.grid;
  std::vector<char> is_sphere(grid.size());
  for (std::size_t i = 0; i < is_sphere.size(); ++i)
    is_sphere[i] =
        std::hypot(grid.x(i % grid.columns), grid.y(i / grid.columns) - gap - radius) < radius ? 1
                                                                                               : 0;
  const auto [lines, step] =
      StreamLines(grid, true).of(viewed.flow, is_sphere, FlowPlotTuning::kLines);
  if (lines.empty()) return {};
  std::vector<Polyline> drawn;
  for (const auto& line : lines) drawn.push_back(line.points);
  return mirrored(fmt::format("streamlines; flow rate between neighbouring ones: {:.3g} (unit: "
                              "length^3 / time)",
                              2 * std::numbers::pi * step),
                  "lines linewidth 1 linecolor rgb '#202020'", thinned(drawn, viewed.view));
}

/// `what` is the beginning of the title; `colours` decides the colours of `pressure`.
std::string plot_pressure_and_streamlines(const std::string& what,
                                          const freefem_axi::RowPicture& picture,
                                          const freefem_axi::Tabulation& tabulation,
                                          const ViewedFlow& viewed, const ColourField& pressure,
                                          const PressureColours& colours, const StopToken& stop) {
  const auto& view = viewed.view;
  Panel panel = empty_panel(what, picture, tabulation, view);
  panel.field = pressure;
  for (double& value : panel.field->values) value = colours.at(value);
  panel.settings = colours.settings();
  panel.curves.push_back(streamlines(viewed, tabulation.radius, picture.gap));
  std::ranges::move(outlines(picture, view, tabulation.radius), std::back_inserter(panel.curves));
  panel.settings.push_back(velocity_arrow(picture, tabulation.radius, view.window));
  return draw(panel, view, FlowPlotTuning::kColourBar, stop);
}

/// Arrows of the velocity in the plane through the axis and the direction of motion. The grid has
/// the velocity at the right of the axis, where the angle phi about the axis is 0. At the left (phi
/// = pi), u_z has the other sign; the component to the right is equal. `fastest` is the largest
/// speed [L/T], whose arrow is the longest. The shortest arrows are left out.
Curve velocity_arrows(const ViewedFlow& viewed, double fastest) {
  const auto& view = viewed.view;
  const auto rows = static_cast<std::size_t>(
      std::lround(std::max(2.0, FlowPlotTuning::kColumns * view.plot_height / view.plot_width)));
  const auto& window = view.window;
  const auto u_field = colour_field(viewed.flow.velocity_x, viewed.grid, view);
  const auto w_field = colour_field(viewed.flow.velocity_y, viewed.grid, view);
  const double cell_x = window.width() / FlowPlotTuning::kColumns,
               cell_y = window.height() / static_cast<double>(rows);
  std::vector<Polyline> arrows;
  for (std::size_t i = 0; i < FlowPlotTuning::kColumns * rows; ++i) {
    const std::size_t row = i / FlowPlotTuning::kColumns;
    const double x =
        window.left + (static_cast<double>(i % FlowPlotTuning::kColumns) + 0.5) * cell_x;
    const double y = window.bottom + (static_cast<double>(row) + 0.5) * cell_y;
    const auto pixel = static_cast<std::size_t>((y - window.bottom) / window.height() *
                                                static_cast<double>(u_field.rows)) *
                           u_field.columns +
                       static_cast<std::size_t>((x - window.left) / window.width() *
                                                static_cast<double>(u_field.columns));
    const double u = u_field.values.at(pixel), w = w_field.values.at(pixel);
    if (!std::isfinite(u)) continue;
    // The length is proportional to the square root of the speed, so that slow flow can be seen.
    const double speed = std::hypot(u, w);
    const double length = FlowPlotTuning::kLongestArrow * std::sqrt(speed / fastest);
    const double dx = length * u / speed, dy = length * (x < 0 ? -w : w) / speed;
    const auto place = [&](double along, double across) {
      return std::pair(x + cell_x * (along * dx - across * dy),
                       y + cell_y * (along * dy + across * dx));
    };
    if (!(length > FlowPlotTuning::kShortestArrow)) continue;
    const double back = 0.5 - FlowPlotTuning::kHead * std::cos(FlowPlotTuning::kAngle),
                 side = FlowPlotTuning::kHead * std::sin(FlowPlotTuning::kAngle);
    arrows.push_back(
        {place(-0.5, 0), place(0.5, 0), place(back, side), place(0.5, 0), place(back, -side)});
  }
  Curve curve{"velocity", "lines linewidth 1 linecolor rgb '#333333'", {}};
  for (const auto& arrow : arrows) {
    curve.points.insert(curve.points.end(), arrow.begin(), arrow.end());
    curve.points.emplace_back(NAN, NAN);
  }
  return curve;
}

}  // namespace

std::string plot_motion(const freefem_axi::RowPicture& picture,
                        const freefem_axi::Tabulation& tabulation, bool in_gap,
                        const StopToken& stop) {
  const auto& flow = picture.flow;
  const auto view = in_gap ? gap_view(flow, tabulation.radius, picture.gap)
                           : surroundings(flow, tabulation.radius, picture.gap);
  const bool spins = picture.motion == lubrication::MotionKind::kSpin;
  std::vector<double> speed;
  for (std::size_t i = 0; i < flow.x.size(); ++i)
    speed.push_back(spins ? std::abs(picture.azimuthal_velocity[i])
                          : std::hypot(flow.velocity_x[i], flow.velocity_y[i]));
  const double fastest = extremes(flow, speed, view.window).second;
  const auto viewed = flow_in(view, flow);
  Panel panel = empty_panel(in_gap ? "Flow in the gap" : "Flow at gap", picture, tabulation, view);
  panel.field = colour_field(field_on_grid(flow, speed, viewed.grid), viewed.grid, view);
  panel.settings = {"set palette defined (0 'white', 0.35 '#9ecae1', 0.7 '#4292c6', 1 '#08519c')",
                    fmt::format("set cbrange [0:{:.9g}]", fastest),
                    fmt::format("set cblabel '{}'",
                                spins ? "azimuthal velocity" : "speed in the plane of motion")};
  if (!spins) panel.curves.push_back(velocity_arrows(viewed, fastest));
  std::ranges::move(outlines(picture, view, tabulation.radius), std::back_inserter(panel.curves));
  return draw(panel, view, FlowPlotTuning::kColourBar, stop);
}

std::string plot_mesh(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop) {
  constexpr int kPieces = FlowPlotTuning::kPiecesOfMesh;
  double reach = FlowPlotTuning::kGapReach;
  auto view = gap_view(picture.flow, tabulation.radius, picture.gap);
  auto fine = sides(picture.flow, view.window, kPieces / 4);
  while (fine.size() > FlowPlotTuning::kMostSides) {
    reach /= 2;
    const double right = view.window.right;
    view = gap_view(picture.flow, tabulation.radius, picture.gap, reach);
    if (!(view.window.right < right)) break;  // the gap is so wide that its height limits the view
    fine = sides(picture.flow, view.window, kPieces / 4);
  }
  Panel panel = empty_panel("Mesh in the gap", picture, tabulation, view);
  // A white field shows where the fluid is.
  const std::vector<double> white(picture.flow.x.size(), 0.0);
  const auto grid = grid_of_view(view);
  panel.field = colour_field(field_on_grid(picture.flow, white, grid), grid, view);
  panel.settings = {"set palette defined (0 'white', 1 'white')", "set cbrange [0:1]",
                    "unset colorbox"};
  panel.curves.push_back(
      mirrored("finest mesh", "lines linewidth 0.5 linecolor rgb '#56B4E9'", fine));
  panel.curves.push_back(mirrored("coarsest mesh", "lines linewidth 1.4 linecolor rgb '#0072B2'",
                                  sides(picture.coarsest, view.window, kPieces)));
  std::ranges::move(outlines(picture, view, tabulation.radius), std::back_inserter(panel.curves));
  return draw(panel, view, FlowPlotTuning::kNoColourBar, stop);
}

std::string plot_flow(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop) {
  const auto& flow = picture.flow;
  const auto view = surroundings(flow, tabulation.radius, picture.gap);
  const auto viewed = flow_in(view, flow);
  const auto pressure = colour_field(viewed.flow.pressure, viewed.grid, view);
  const double usual =
      tabulation.viscosity * std::abs(picture.reference_velocity) / tabulation.radius;
  // The pressure mu |u0|/r [M/(L T^2)], with the viscosity mu, the velocity u0 and the radius r, is
  // the scale of pressures far from a narrow gap. If the extremes of the picture are much larger,
  // the scale of colours is linear below about this pressure and logarithmic above it.
  auto colours = robust_colours(pressure.values, usual);
  // A thin film may contain no centre of a cell. Therefore the extremes in the words of the scale
  // are those at the nodes of the mesh.
  std::tie(colours.smallest, colours.largest) = extremes(flow, flow.pressure, view.window);
  return plot_pressure_and_streamlines("Flow at gap", picture, tabulation, viewed, pressure,
                                       colours, stop);
}

std::string plot_gap_flow(const freefem_axi::RowPicture& picture,
                          const freefem_axi::Tabulation& tabulation, const StopToken& stop) {
  const auto viewed = flow_in(gap_view(picture.flow, tabulation.radius, picture.gap), picture.flow);
  const auto pressure = colour_field(viewed.flow.pressure, viewed.grid, viewed.view);
  return plot_pressure_and_streamlines("Flow in the gap", picture, tabulation, viewed, pressure,
                                       proportional_colours(pressure.values), stop);
}

}  // namespace viscontact::report
