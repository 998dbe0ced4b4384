// Shows the loops of strokes in the plane of two arms over a map of displacement_curl().
#include "viscontact/swimmer/job/swimmer_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "viscontact/report/pictures/colours.hpp"
#include "viscontact/report/pictures/gnuplot.hpp"

namespace viscontact::swimmer {
namespace {

using Points = std::vector<std::pair<double, double>>;

// Indices of the colours of curves in kCurveColours: the two strokes, then the arms, of which there
// is one less than spheres, then the spheres, then other curves.
constexpr std::size_t kStroke = 0, kOptimalStroke = 1, kFirstArm = 2;
std::size_t first_sphere(const SwimmerResults& results) {
  return kFirstArm + results.c.spheres.radii.size() - 1;
}
std::size_t place_after_spheres(const SwimmerResults& results) {
  return first_sphere(results) + results.c.spheres.radii.size();
}

/// The decimal logarithm of |displacement_curl()| [1/L], for all pairs of the two arms in the
/// table.
report::ColourField curl_field(const Swimmer& swimmer) {
  constexpr std::size_t kPixels = 200;  // along each axis; a smooth field needs no more
  const auto [left, right] = swimmer.arm_interval(0);
  const auto [bottom, top] = swimmer.arm_interval(1);
  report::ColourField field{kPixels, kPixels, left, right, bottom, top, {}};
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

struct ShownStroke {
  std::string name;
  const char* colour;
  const StrokeResult* result;
};

std::vector<ShownStroke> strokes_of(const SwimmerResults& results) {
  std::vector<ShownStroke> strokes;
  if (results.stroke)
    strokes.push_back({"stroke", report::curve_colour(kStroke), &*results.stroke});
  if (results.optimal)
    strokes.push_back({"optimal stroke", report::curve_colour(kOptimalStroke), &*results.optimal});
  return strokes;
}

/// A panel with a curve over time / period for each stroke, so that strokes can be compared.
template <class Value>
report::PlotPanel panel_of_strokes(const SwimmerResults& results, const std::string& title,
                                   const std::string& label, const Value& value) {
  report::PlotPanel panel{title, {"time / period"}, {label}, {}};
  for (const auto& [name, colour, stroke] : strokes_of(results)) {
    report::PlotCurve curve{name, {colour}, {}};
    for (const auto& row : stroke->rows)
      curve.points.emplace_back(row.time / stroke->period, value(row));
    panel.curves.push_back(curve);
  }
  return panel;
}

/// A plot with one panel for each stroke, in which a curve over time [T] belongs to each component
/// of the vector `values` of a row. `place` is the index of the first component's colour.
template <class Values>
report::Plot plot_of_components(const SwimmerResults& results, const std::string& name,
                                const std::string& title, const std::string& label,
                                const std::string& component, std::size_t place,
                                const Values& values) {
  report::Plot plot{name, 360, {}};
  for (const auto& shown : strokes_of(results)) {
    const auto* stroke = shown.result;
    report::PlotPanel panel{fmt::format("{} of the {}", title, shown.name),
                            {"time" + results.c.units.in_brackets(0, 0, 1)},
                            {label},
                            {}};
    const auto count = values(stroke->rows.front()).size();
    for (Eigen::Index i = 0; i < count; ++i) {
      report::PlotCurve curve{fmt::format("{} {}", component, i + 1),
                              {report::curve_colour(place + static_cast<std::size_t>(i))},
                              {}};
      for (const auto& row : stroke->rows) curve.points.emplace_back(row.time, values(row)[i]);
      panel.curves.push_back(curve);
    }
    plot.panels.push_back(panel);
  }
  plot.height *= static_cast<int>(plot.panels.size());
  return plot;
}

/// A plot over the number of polynomials: the energy relative to that with the most polynomials,
/// minus 1, and the residual of Euler and Lagrange's equation. `place` is the index of the first
/// curve's colour.
report::Plot plot_convergence(const std::vector<OptimalStrokeStep>& steps, std::size_t place) {
  assert(!steps.empty());
  report::PlotPanel panel{"Convergence of the optimal stroke",
                          {"polynomials for each arm"},
                          {"relative difference", true},
                          {}};
  report::PlotCurve energy{"energy, less that with all polynomials",
                           {report::curve_colour(place), 2, {}, report::PointKind::kDisc},
                           {}};
  report::PlotCurve residual{"residual of Euler and Lagrange's equation",
                             {report::curve_colour(place + 1), 2, {}, report::PointKind::kDisc},
                             {}};
  for (const auto& step : steps) {
    const double excess = step.energy / steps.back().energy - 1;
    const auto count = static_cast<double>(step.polynomials);
    // Differences below this number are round-off, which a logarithmic axis would show as noise.
    constexpr double kRoundOff = 1e-13;
    if (excess > kRoundOff) energy.points.emplace_back(count, excess);
    residual.points.emplace_back(count, step.euler_lagrange_residual);
  }
  panel.curves = {energy, residual};
  return {"convergence", 400, {panel}};
}

/// The distance of tics on an axis whose ends are `range` > 0 apart: 1, 2 or 5 times a power of
/// ten, with at most seven tics. gnuplot's own tics are so close that numbers with many digits
/// overlap.
double tic_step(double range) {
  const double least = range / 6;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= least) return factor * power;
  return 10 * power;
}

/// The SVG of the loops over the map of curl_field().
std::string draw_loops(const SwimmerResults& results, const StopToken& stop) {
  const Swimmer swimmer(results.fit);
  const auto length = results.c.units.in_brackets(0, 1, 0);
  report::Panel panel{"Loops of the strokes over the displacement of a small loop per area",
                      "arm x1" + length,
                      "arm x2" + length,
                      false,
                      false,
                      {"set size ratio -1",
                       ("set palette defined (0 '#00224e', 0.25 '#35456c', 0.5 '#7c7b78',"
                        " 0.75 '#bcae6c', 1 '#fee838')"),
                       "set cblabel 'log10 of |dA2/dx1 - dA1/dx2|'", report::kLegendBelow},
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
  return report::draw_svg({panel}, 760, 700, stop);
}

std::vector<report::Plot> swimmer_plots(const SwimmerResults& results) {
  std::vector<report::Plot> plots;
  if (strokes_of(results).empty()) return plots;
  const auto& units = results.c.units;
  const auto length = units.in_brackets(0, 1, 0);
  plots.push_back({"position",
                   400,
                   {panel_of_strokes(results, "Position of the middle sphere", "position" + length,
                                     [](const SwimRow& row) { return row.position; })}});
  auto power = panel_of_strokes(results, "Power", "power" + units.in_brackets(1, 2, -3),
                                [](const SwimRow& row) { return row.power; });
  power.y.low = 0;
  plots.push_back({"power", 400, {power}});
  plots.push_back(plot_of_components(results, "arms", "Arms", "distance of centres" + length, "x",
                                     kFirstArm, [](const SwimRow& row) { return row.arms; }));
  plots.push_back(plot_of_components(
      results, "forces", "Forces on the fluid", "force" + units.in_brackets(1, 1, -2), "sphere",
      first_sphere(results), [](const SwimRow& row) { return row.forces; }));
  if (!results.convergence.empty())
    plots.push_back(plot_convergence(results.convergence, place_after_spheres(results)));
  return plots;
}

std::string seven_digits(double value) { return fmt::format("{:.7g}", value); }

std::string with_error(double value, double error) {
  return fmt::format("{:.9g} &plusmn; {:.1g}", value, error);
}

/// The table (HTML) of the sums, with a column for each stroke.
std::string strokes_table(const SwimmerResults& results) {
  const auto strokes = strokes_of(results);
  std::string head = "<tr><th></th>";
  for (const auto& stroke : strokes) head += "<th>" + stroke.name + "</th>";
  const auto row = [&](const std::string& name, const auto& value) {
    std::string cells = "<tr><td>" + name + "</td>";
    for (const auto& stroke : strokes) cells += "<td>" + value(*stroke.result) + "</td>";
    return cells + "</tr>\n";
  };
  return report::table_of(
      head + "</tr>\n" +
      row("displacement in a period [L]",
          [](const StrokeResult& s) {
            return with_error(s.sums.displacement, s.errors.displacement);
          }) +
      row("energy of a period [M L<sup>2</sup>/T<sup>2</sup>]",
          [](const StrokeResult& s) { return with_error(s.sums.energy, s.errors.energy); }) +
      row("the same at constant power",
          [](const StrokeResult& s) { return seven_digits(s.sums.energy_at_constant_power); }) +
      row("Lighthill's efficiency",
          [](const StrokeResult& s) { return seven_digits(s.sums.efficiency); }) +
      row("period [T]", [](const StrokeResult& s) { return seven_digits(s.period); }));
}

/// How the optimal stroke was found, as HTML; empty if there is none.
std::string search_words(const SwimmerResults& results) {
  const auto& steps = results.convergence;
  if (steps.empty()) return "";
  const auto& last = steps.back();
  return fmt::format(
      "<p>The optimal stroke has the least energy of all loops through its first shape with this "
      "displacement. It is found with {} polynomials for each arm{}. The residual of Euler and "
      "Lagrange's equation is {:.2g}.</p>\n",
      last.polynomials,
      steps.size() < 2 ? ""
                       : fmt::format("; with {} its energy is larger by the fraction {:.1g}",
                                     steps[steps.size() - 2].polynomials,
                                     steps[steps.size() - 2].energy / last.energy - 1),
      last.euler_lagrange_residual);
}

/// The table (HTML) of relative errors of the resistance matrices and of their fit.
std::string fit_table_of(const SwimmerResults& results) {
  const auto& fit = results.fit;
  double estimate = 0;
  for (const auto& row : results.table.rows)
    estimate = std::max(estimate, row.relative_error_estimate);
  return report::table_of(
      report::table_row("rows of the table", std::to_string(results.table.rows.size())) +
      report::table_row("largest error estimate of an entry, relative",
                        fmt::format("{:.2g}", estimate)) +
      report::table_row("terms of lubrication taken out", std::to_string(fit.lubrication_terms)) +
      report::table_row("largest residual of the fit, relative",
                        fmt::format("{:.2g}", fit.largest_relative_residual)) +
      report::table_row("error of a row predicted from the others, relative: largest",
                        fmt::format("{:.2g}", fit.largest_left_one_out_error)) +
      report::table_row("the same, root mean square",
                        fmt::format("{:.2g}", fit.rms_left_one_out_error)));
}

std::string parameters_of(const SwimmerResults& results) {
  const auto& spheres = results.c.spheres;
  std::string radii;
  for (const double radius : spheres.radii)
    radii += (radii.empty() ? "" : ", ") + fmt::format("{:g}", radius);
  std::string rows =
      report::table_row("viscosity [M/(L T)]", fmt::format("{:g}", spheres.viscosity)) +
      report::table_row("radii [L]", radii) +
      report::table_row("surroundings", report::escaped(surroundings_in_words(spheres)));
  for (std::size_t k = 0; k < results.c.gaps.size(); ++k) {
    const double both_radii = spheres.radii[k] + spheres.radii[k + 1];
    rows += report::table_row(
        fmt::format("arm x{} of the table [L]", k + 1),
        fmt::format("{} values from {:g} to {:g}", results.c.gaps[k].size(),
                    results.c.gaps[k].front() + both_radii, results.c.gaps[k].back() + both_radii));
  }
  return report::table_of(rows);
}

std::string files_words(const SwimmerResults& results) {
  std::string text =
      "<p>Files of this folder: <a href=\"table.csv\">table.csv</a>, <a "
      "href=\"fit.json\">fit.json</a>, <a href=\"swimmer.json\">swimmer.json</a>";
  if (results.stroke) text += ", <a href=\"stroke.csv\">stroke.csv</a>";
  if (results.optimal) text += ", <a href=\"optimal_stroke.csv\">optimal_stroke.csv</a>";
  return text + ".</p>\n";
}

/// The section (HTML) with the loops; empty if they are not drawn.
std::string loops_section(const report::Report& report) {
  const auto loops = report.figures({"loops"});
  return report::section(
      "Loops in the plane of the arms",
      loops.empty() ? ""
                    : "<p>The displacement of a stroke is the integral of the coloured quantity "
                      "over the area in its loop, positive for loops run counter-clockwise.</p>\n" +
                          loops);
}

}  // namespace

void write_swimmer_report(const SwimmerResults& results, const std::filesystem::path& folder,
                          const results::Provenance& provenance, const StopToken& stop) {
  assert(!results.stroke || !results.stroke->rows.empty());
  const auto& units = results.c.units;
  report::Report report(folder, kSwimmerPictures);
  report.draw(swimmer_plots(results), stop);
  // The map needs a plane of two arms.
  if (report.is_drawn() && results.c.gaps.size() == 2)
    report.add_picture("loops", draw_loops(results, stop));
  report.write(
      results.c.title.empty() ? "Swimmer" : results.c.title,
      fmt::format(
          "<p class=summary>A swimmer of {} spheres on a line in a fluid without inertia</p>\n",
          results.c.spheres.radii.size()),
      report::section("Strokes",
                      strokes_of(results).empty()
                          ? ""
                          : units.in_brackets_of(strokes_table(results)) + search_words(results)) +
          loops_section(report) +
          report::section("Displacement and power", report.figures({"position", "power"})) +
          report::section("Arms and forces", report.figures({"arms", "forces"})) +
          report::section("How the optimal stroke converges", report.figures({"convergence"})) +
          report::section("Resistance matrices and their fit", fit_table_of(results)) +
          report::section("Parameters",
                          units.in_brackets_of(parameters_of(results)) + files_words(results)),
      provenance);
}

}  // namespace viscontact::swimmer
