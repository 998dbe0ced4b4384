// Combines title, colours of the pressure and curves into the pictures of a row (flow_plots.hpp).
// Lengths and pressures are in the units of the case.
#include "viscontact/report/flow/flow_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <vector>

#include "viscontact/report/flow/flow_lines.hpp"
#include "viscontact/report/flow/pressure_colours.hpp"
#include "viscontact/report/flow/triangle_fields.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"

namespace viscontact::report {
namespace {

// Margins of the drawing [pixels].
constexpr double kLeft = 110, kAbove = 66, kBelow = 106;
constexpr double kColourBar = 165;  // at the right, with its numbers
constexpr double kNoColourBar = 30;

/// An arrow on the visible part of the sphere, in the direction of its velocity.
std::string velocity_arrow(const freefem_axi::RowPicture& row, double radius,
                           const Window& window) {
  constexpr double kLength = 0.4;  // in heights of the visible part
  const double top = std::min(row.gap + 2 * radius, window.top);
  const double middle = (row.gap + top) / 2;
  const double half = std::copysign(kLength / 2 * (top - row.gap), row.reference_velocity);
  return fmt::format(
      "set arrow from 0,{:.9g} to 0,{:.9g} front filled linewidth 4 linecolor rgb 'white'",
      middle - half, middle + half);
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
          ("set object 1 rectangle from graph 0,0 to graph 1,1 behind fillcolor rgb '#dedede' "
           "fillstyle solid noborder")};
}

/// The motion, up to the number of its velocity.
std::string motion_in_words(lubrication::MotionKind motion) {
  using lubrication::MotionKind;
  if (motion == MotionKind::kApproach) return " at velocity";
  return motion == MotionKind::kSlide  ? ", sliding at velocity"
         : motion == MotionKind::kRoll ? ", rolling at angular velocity"
                                       : ", spinning at angular velocity";
}

Panel empty_panel(const std::string& what, const freefem_axi::RowPicture& picture,
                  const freefem_axi::Tabulation& tabulation, const PlotView& view) {
  constexpr double kVisible = 1.05;
  Panel panel;
  const auto container = freefem_axi::container_in_words(tabulation);
  panel.title = fmt::format(
      "{} {:.6g} of a sphere of radius {:.6g}{} {:.6g}{}\n{}{}", what, picture.gap,
      tabulation.radius, motion_in_words(picture.motion), picture.reference_velocity,
      view.stretch() > kVisible ? fmt::format(" (heights stretched {:.3g} times)", view.stretch())
                                : "",
      freefem_axi::geometry_in_words(tabulation), container == "none" ? "" : "; " + container);
  panel.x_label = "distance from the axis (the case's unit of length)";
  panel.y_label = "height (the case's unit of length)";
  return panel;
}

std::string draw(Panel panel, const PlotView& view, double right, const StopToken& stop) {
  constexpr double kLegendRow = 20;
  const auto legends =
      std::ranges::count_if(panel.curves, [](const Curve& curve) { return !curve.legend.empty(); });
  const auto legend_rows = legends / 2;
  const double below = kBelow + kLegendRow * static_cast<double>(legend_rows);
  const double width = kLeft + view.plot_width + right;
  const double height = kAbove + view.plot_height + below;
  auto settings = layout(view, right, below, width, height);
  settings.insert(settings.end(), panel.settings.begin(), panel.settings.end());
  panel.settings = std::move(settings);
  return draw_svg({panel}, static_cast<int>(std::lround(width)),
                  static_cast<int>(std::lround(height)), stop);
}

/// The values at the cells of the plot, which are so small that they are hardly seen.
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

std::string plot_pressure_and_streamlines(const std::string& what,
                                          const freefem_axi::RowPicture& picture,
                                          const freefem_axi::Tabulation& tabulation,
                                          const PlotView& view, const ColourField& pressure,
                                          const PressureColours& colours, const StopToken& stop) {
  Panel panel = empty_panel(what, picture, tabulation, view);
  panel.field = pressure;
  for (double& value : panel.field->values) value = colours.at(value);
  panel.settings = colours.settings();
  panel.curves.push_back(streamlines(picture.flow, view));
  std::ranges::move(outlines(picture.flow.mesh, view, tabulation.radius, picture.gap),
                    std::back_inserter(panel.curves));
  panel.settings.push_back(velocity_arrow(picture, tabulation.radius, view.window));
  return draw(panel, view, kColourBar, stop);
}

/// Arrows of the velocity in the plane of motion. Where phi = pi, on the left, cos phi changes the
/// sign of u_z; the component along x is the same, because e_rho changes its sign, too.
Curve velocity_arrows(const freefem_axi::Flow& flow, const PlotView& view, double fastest) {
  constexpr std::size_t kColumns = 24;
  constexpr double kHead = 0.35, kAngle = 0.45;  // of an arrow's length, radians
  const auto rows = static_cast<std::size_t>(
      std::lround(std::max(2.0, kColumns * view.plot_height / view.plot_width)));
  const auto& window = view.window;
  std::vector<double> radial, axial;
  for (const auto& velocity : flow.velocity) {
    radial.push_back(velocity[0]);
    axial.push_back(velocity[1]);
  }
  // Values at the pixels, of which only those next to the fluid are known beyond it.
  const auto at_pixels = [&](const std::vector<double>& values) {
    return colour_field(straightened(flow.mesh, values, window), view);
  };
  const auto u_field = at_pixels(radial), w_field = at_pixels(axial);
  const double cell_x = window.width() / kColumns,
               cell_y = window.height() / static_cast<double>(rows);
  std::vector<Polyline> arrows;
  for (std::size_t i = 0; i < kColumns * rows; ++i) {
    const std::size_t row = i / kColumns;
    const double x = window.left + (static_cast<double>(i % kColumns) + 0.5) * cell_x;
    const double y = window.bottom + (static_cast<double>(row) + 0.5) * cell_y;
    const auto pixel = static_cast<std::size_t>((y - window.bottom) / window.height() *
                                                static_cast<double>(u_field.rows)) *
                           u_field.columns +
                       static_cast<std::size_t>((x - window.left) / window.width() *
                                                static_cast<double>(u_field.columns));
    const double u = u_field.values.at(pixel), w = w_field.values.at(pixel);
    if (!std::isfinite(u)) continue;
    // Lengths in cells; the root makes slow flow visible.
    const double speed = std::hypot(u, w);
    const double length = 0.9 * std::sqrt(speed / fastest);
    const double dx = length * u / speed, dy = length * (x < 0 ? -w : w) / speed;
    const auto place = [&](double along, double across) {
      return std::pair(x + cell_x * (along * dx - across * dy),
                       y + cell_y * (along * dy + across * dx));
    };
    if (!(length > 0.1)) continue;
    const double back = 0.5 - kHead * std::cos(kAngle), side = kHead * std::sin(kAngle);
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
  const auto view = in_gap ? gap_view(flow.mesh, tabulation.radius, picture.gap)
                           : surroundings(flow.mesh, tabulation.radius, picture.gap);
  const bool spins = picture.motion == lubrication::MotionKind::kSpin;
  std::vector<double> speed;
  for (std::size_t i = 0; i < flow.velocity.size(); ++i)
    speed.push_back(spins ? std::abs(flow.azimuthal_velocity[i])
                          : std::hypot(flow.velocity[i][0], flow.velocity[i][1]));
  const auto field = straightened(flow.mesh, speed, view.window);
  const double fastest = extremes(field, view.window).second;
  Panel panel = empty_panel(in_gap ? "Flow in the gap" : "Flow at gap", picture, tabulation, view);
  panel.field = colour_field(field, view);
  panel.settings = {"set palette defined (0 'white', 0.35 '#9ecae1', 0.7 '#4292c6', 1 '#08519c')",
                    fmt::format("set cbrange [0:{:.9g}]", fastest),
                    fmt::format("set cblabel '{}'",
                                spins ? "azimuthal velocity" : "speed in the plane of motion")};
  if (!spins) panel.curves.push_back(velocity_arrows(flow, view, fastest));
  std::ranges::move(outlines(flow.mesh, view, tabulation.radius, picture.gap),
                    std::back_inserter(panel.curves));
  return draw(panel, view, kColourBar, stop);
}

std::string plot_mesh(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop) {
  // The number of straight pieces of a side of the coarsest mesh. A side of the finest mesh has a
  // quarter of this number.
  constexpr int kPieces = 8;
  constexpr std::size_t kMostSides = 3500;  // with more sides, the view is made narrower
  double reach = kGapReach;
  auto view = gap_view(picture.flow.mesh, tabulation.radius, picture.gap);
  auto fine = sides(picture.flow.mesh, view.window, kPieces / 4);
  while (fine.size() > kMostSides) {
    reach /= 2;
    const double right = view.window.right;
    view = gap_view(picture.flow.mesh, tabulation.radius, picture.gap, reach);
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
      mirrored("finest mesh", "lines linewidth 0.5 linecolor rgb '#56B4E9'", fine));
  panel.curves.push_back(mirrored("coarsest mesh", "lines linewidth 1.4 linecolor rgb '#0072B2'",
                                  sides(picture.coarsest, view.window, kPieces)));
  std::ranges::move(outlines(picture.flow.mesh, view, tabulation.radius, picture.gap),
                    std::back_inserter(panel.curves));
  return draw(panel, view, kNoColourBar, stop);
}

std::string plot_flow(const freefem_axi::RowPicture& picture,
                      const freefem_axi::Tabulation& tabulation, const StopToken& stop) {
  const auto& flow = picture.flow;
  const auto view = surroundings(flow.mesh, tabulation.radius, picture.gap);
  const auto field = straightened(flow.mesh, flow.pressure, view.window);
  const auto pressure = colour_field(field, view);
  const double usual =
      tabulation.viscosity * std::abs(picture.reference_velocity) / tabulation.radius;
  auto colours = robust_colours(pressure.values, usual);
  // A thin film may have no pixels, so the extremes are those of the triangles.
  std::tie(colours.smallest, colours.largest) = extremes(field, view.window);
  return plot_pressure_and_streamlines("Flow at gap", picture, tabulation, view, pressure, colours,
                                       stop);
}

std::string plot_gap_flow(const freefem_axi::RowPicture& picture,
                          const freefem_axi::Tabulation& tabulation, const StopToken& stop) {
  const auto& flow = picture.flow;
  const auto view = gap_view(flow.mesh, tabulation.radius, picture.gap);
  const auto pressure = colour_field(straightened(flow.mesh, flow.pressure, view.window), view);
  return plot_pressure_and_streamlines("Flow in the gap", picture, tabulation, view, pressure,
                                       proportional_colours(pressure.values), stop);
}

}  // namespace viscontact::report
