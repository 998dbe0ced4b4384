// Draws loops over the map of the curl, and curves over time (swimmer_plots.hpp).
#include "viscontact/report/swimmer/swimmer_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "viscontact/report/pictures/colours.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"

namespace viscontact::report {
namespace {

using Points = std::vector<std::pair<double, double>>;

// Places of the curves of the page in kCurveColours: the two strokes, the arms, the spheres, and
// what belongs to none of them. There is one arm less than spheres.
constexpr std::size_t kStroke = 0, kOptimalStroke = 1, kFirstArm = 2;
std::size_t first_sphere(const SwimmerResults& results) {
  return kFirstArm + results.c.spheres.radii.size() - 1;
}
std::size_t place_after_spheres(const SwimmerResults& results) {
  return first_sphere(results) + results.c.spheres.radii.size();
}

/// log10 of the displacement per area on the whole table.
ColourField curl_field(const reduced_model::Swimmer& swimmer) {
  constexpr std::size_t kPixels = 200;  // each way; finer than the eye sees in a smooth field
  const auto [left, right] = swimmer.arm_interval(0);
  const auto [bottom, top] = swimmer.arm_interval(1);
  ColourField field{kPixels, kPixels, left, right, bottom, top, {}};
  const auto place = [](double from, double to, std::size_t i) {
    return std::lerp(from, to, (static_cast<double>(i) + 0.5) / kPixels);
  };
  for (std::size_t row = 0; row < kPixels; ++row)
    for (std::size_t column = 0; column < kPixels; ++column)
      field.values.push_back(std::log10(std::abs(displacement_curl(
          swimmer, Eigen::Vector2d(place(left, right, column), place(bottom, top, row))))));
  return field;
}

Points loop_of(const StrokeResult& stroke) {
  Points points;
  for (const auto& row : stroke.rows) points.emplace_back(row.arms[0], row.arms[1]);
  return points;
}

/// A stroke as the page shows it.
struct ShownStroke {
  std::string name;
  const char* colour;
  const StrokeResult* result;
};

std::vector<ShownStroke> strokes_of(const SwimmerResults& results) {
  std::vector<ShownStroke> strokes;
  if (results.stroke) strokes.push_back({"stroke", curve_colour(kStroke), &*results.stroke});
  if (results.optimal)
    strokes.push_back({"optimal stroke", curve_colour(kOptimalStroke), &*results.optimal});
  return strokes;
}

/// A curve over time for each stroke: the time is in periods, so that strokes can be compared.
template <class Value>
PlotPanel panel_of_strokes(const SwimmerResults& results, const std::string& title,
                           const std::string& label, const Value& value) {
  PlotPanel panel{title, {"time / period"}, {label}, {}};
  for (const auto& [name, colour, stroke] : strokes_of(results)) {
    PlotCurve curve{name, {colour}, {}};
    for (const auto& row : stroke->rows)
      curve.points.emplace_back(row.time / stroke->period, value(row));
    panel.curves.push_back(curve);
  }
  return panel;
}

/// Panels with a curve for each component of a vector, one panel for each stroke. `place` is the
/// place of the first component's colour.
template <class Values>
Plot plot_of_components(const SwimmerResults& results, const std::string& name,
                        const std::string& title, const std::string& label,
                        const std::string& component, std::size_t place, const Values& values) {
  Plot plot{name, 360, {}};
  for (const auto& shown : strokes_of(results)) {
    const auto* stroke = shown.result;
    PlotPanel panel{fmt::format("{} of the {}", title, shown.name), {"time"}, {label}, {}};
    const auto count = values(stroke->rows.front()).size();
    for (Eigen::Index i = 0; i < count; ++i) {
      PlotCurve curve{fmt::format("{} {}", component, i + 1),
                      {curve_colour(place + static_cast<std::size_t>(i))},
                      {}};
      for (const auto& row : stroke->rows) curve.points.emplace_back(row.time, values(row)[i]);
      panel.curves.push_back(curve);
    }
    plot.panels.push_back(panel);
  }
  plot.height *= static_cast<int>(plot.panels.size());
  return plot;
}

/// What the energies with fewer polynomials exceed the last one by, and Euler and Lagrange's
/// residuals. `place` is the place of the first curve's colour.
Plot plot_convergence(const reduced_model::OptimalStroke& search, std::size_t place) {
  PlotPanel panel{"Convergence of the optimal stroke",
                  {"polynomials for each arm"},
                  {"relative difference", true},
                  {}};
  PlotCurve energy{
      "energy, less that with all polynomials", {curve_colour(place), 2, {}, PointKind::kDisc}, {}};
  PlotCurve residual{"residual of Euler and Lagrange's equation",
                     {curve_colour(place + 1), 2, {}, PointKind::kDisc},
                     {}};
  for (const auto& step : search.convergence) {
    const double excess = step.energy / search.convergence.back().energy - 1;
    const auto count = static_cast<double>(step.polynomials);
    // Differences below this are round-off, which a logarithmic axis would show as noise.
    constexpr double kRoundOff = 1e-13;
    if (excess > kRoundOff) energy.points.emplace_back(count, excess);
    residual.points.emplace_back(count, step.euler_lagrange_residual);
  }
  panel.curves = {energy, residual};
  return {"convergence", 400, {panel}};
}

/// The distance of tics, 1, 2 or 5 times a power of ten, so that at most seven are in the range.
/// gnuplot's own tics are so close that their numbers overlap if they have many digits.
double tic_step(double range) {
  const double least = range / 6;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

}  // namespace

std::string draw_loops(const SwimmerResults& results, const StopToken& stop) {
  const reduced_model::Swimmer swimmer(results.fit);
  Panel panel{"Loops of the strokes over the displacement of a small loop per area",
              "arm x1",
              "arm x2",
              false,
              false,
              {"set size ratio -1",
               ("set palette defined (0 '#00224e', 0.25 '#35456c', 0.5 '#7c7b78',"
                " 0.75 '#bcae6c', 1 '#fee838')"),
               "set cblabel 'log10 of |dA2/dx1 - dA1/dx2|'", kLegendBelow},
              {}};
  panel.field = curl_field(swimmer);
  panel.settings.push_back(
      fmt::format("set xrange [{}:{}]", panel.field->left, panel.field->right));
  const double step = tic_step(panel.field->right - panel.field->left);
  panel.settings.push_back(fmt::format("set xtics {0}; set ytics {0}", step));
  panel.settings.push_back(
      fmt::format("set yrange [{}:{}]", panel.field->bottom, panel.field->top));
  for (const auto& [name, colour, stroke] : strokes_of(results)) {
    const auto style = fmt::format("lines linewidth 2.5 linecolor rgb '{}'", colour);
    panel.curves.push_back({name, style, loop_of(*stroke)});
    const auto start = fmt::format("points pointtype 7 pointsize 1 linecolor rgb '{}'", colour);
    panel.curves.push_back({"", start, {loop_of(*stroke).front()}});
  }
  return draw_svg({panel}, 760, 700, stop);
}

std::vector<Plot> swimmer_plots(const SwimmerResults& results) {
  using reduced_model::SwimRow;
  std::vector<Plot> plots;
  if (strokes_of(results).empty()) return plots;
  plots.push_back({"position",
                   400,
                   {panel_of_strokes(results, "Position of the middle sphere", "position",
                                     [](const SwimRow& row) { return row.position; })}});
  auto power =
      panel_of_strokes(results, "Power", "power", [](const SwimRow& row) { return row.power; });
  power.y.low = 0;
  plots.push_back({"power", 400, {power}});
  plots.push_back(plot_of_components(results, "arms", "Arms", "distance of centres", "x", kFirstArm,
                                     [](const SwimRow& row) { return row.arms; }));
  plots.push_back(plot_of_components(results, "forces", "Forces on the fluid", "force", "sphere",
                                     first_sphere(results),
                                     [](const SwimRow& row) { return row.forces; }));
  if (results.search)
    plots.push_back(plot_convergence(*results.search, place_after_spheres(results)));
  return plots;
}

}  // namespace viscontact::report
