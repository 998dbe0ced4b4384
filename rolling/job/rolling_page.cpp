// Pictures and tables of the motions by all models.
#include "viscontact/rolling/job/rolling_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viscontact/lubrication/regime.hpp"
#include "viscontact/lubrication/stokes_drag.hpp"
#include "viscontact/report/pictures/colours.hpp"

namespace viscontact::rolling {
namespace {

/// The index of the colour of a model, which is the same in all runs.
std::size_t place_of(const std::string& model) {
  const auto& models = rolling_models();
  const auto found = std::ranges::find(models, model, [](const auto& m) { return m.name; });
  return static_cast<std::size_t>(found - models.begin());
}

/// A plot of `value` of each row over time with a curve for each model. `label` names the vertical
/// axis with its unit.
template <class Value>
report::Plot plot_of(const RollingResults& results, const std::string& name,
                     const std::string& title, const std::string& label, bool logarithmic,
                     const Value& value) {
  report::PlotPanel panel{
      title, {"time" + results.c.units.in_brackets(0, 0, 1)}, {label, logarithmic}, {}};
  for (const auto& [model, rows] : results.trajectories) {
    report::PlotCurve curve{model, {report::curve_colour(place_of(model))}, {}};
    for (const auto& row : rows) curve.points.emplace_back(row.time, value(row));
    panel.curves.push_back(curve);
  }
  return {name, 400, {panel}};
}

const char* contact_in_words(SolidContact contact) {
  switch (contact) {
    case SolidContact::kRolling:
      return "rolls";
    case SolidContact::kSliding:
      return "slides";
    case SolidContact::kNone:
      break;
  }
  return "none";
}

/// The table (HTML) of the state of each model at the end of the motion. Its column "slip over
/// velocity" is empty if the sphere does not move along the plane.
std::string end_table(const RollingResults& results) {
  std::string rows =
      "<tr><th>model</th><th>gap [L]</th><th>velocity [L/T]</th><th>angular velocity [1/T]</th>"
      "<th>slip over velocity</th><th>solid contact</th><th>largest Reynolds number</th>"
      "<th>largest Stokes number</th></tr>\n";
  for (const auto& [model, trajectory] : results.trajectories) {
    const auto& last = trajectory.back();
    const double move = last.velocity - results.c.motion.plane_velocity;
    const double slip = move - results.c.radius * last.angular_velocity;
    const auto end = end_of(trajectory, results.c.motion, results.c.radius);
    const auto reynolds = reynolds_of(results.c, end);
    rows += fmt::format(
        "<tr><td>{}</td><td>{:.6g}</td><td>{:.8g}</td><td>{:.8g}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{:.3g}</td></tr>\n",
        model, last.gap, last.velocity, last.angular_velocity,
        move == 0 ? "" : fmt::format("{:.5g}", slip / move), contact_in_words(last.contact),
        reynolds ? fmt::format("{:.3g}", *reynolds) : "&ndash;", stokes_of(results.c, end));
  }
  for (const auto& model : results.failed)
    rows += fmt::format("<tr><td>{}</td><td colspan=7>failed: {}</td></tr>\n", model.model,
                        report::escaped(model.reason));
  return report::table_of(rows);
}

std::string parameters_of_rolling(const RollingResults& results) {
  const auto& m = results.c.motion;
  const auto row = [](const char* name, double value) {
    return report::table_row(name, fmt::format("{:g}", value));
  };
  return report::table_of(
      row("viscosity [M/(L T)]", results.c.viscosity) + row("radius [L]", results.c.radius) +
      row("mass [M]", m.mass) + row("moment of inertia [M L<sup>2</sup>]", m.moment_of_inertia) +
      row("force along the plane [M L/T<sup>2</sup>]", m.force) +
      row("force away from the plane [M L/T<sup>2</sup>]", m.normal_force) +
      row("torque [M L<sup>2</sup>/T<sup>2</sup>]", m.torque) +
      row("velocity of the plane [L/T]", m.plane_velocity) + row("roughness [L]", m.roughness) +
      row("coefficient of friction", m.friction));
}

std::vector<report::Plot> rolling_plots(const RollingResults& results) {
  const double radius = results.c.radius, plane = results.c.motion.plane_velocity;
  const auto& units = results.c.units;
  const auto velocity = "velocity" + units.in_brackets(0, 1, -1);
  std::vector<report::Plot> plots = {
      plot_of(results, "gap", "Gap", "gap" + units.in_brackets(0, 1, 0), true,
              [](const RollingRow& row) { return row.gap; }),
      plot_of(results, "velocity", "Velocity along the plane", velocity, false,
              [](const RollingRow& row) { return row.velocity; }),
      plot_of(results, "rotation", "Angular velocity times radius", velocity, false,
              [=](const RollingRow& row) { return radius * row.angular_velocity; }),
      plot_of(results, "slip", "Slip of the lowest point", velocity, false,
              [=](const RollingRow& row) {
                return row.velocity - plane - radius * row.angular_velocity;
              })};
  if (results.c.motion.friction > 0)
    plots.push_back(plot_of(results, "friction", "Friction of the solids",
                            "force" + units.in_brackets(1, 1, -2), false,
                            [](const RollingRow& row) { return row.friction_force; }));
  return plots;
}

}  // namespace

namespace {

/// m |dq/dt|/|gamma_min| [1] of the model of viscous contact, with the largest |dq/dt| of the rows;
/// nothing for other models and if the solids do not touch.
std::optional<double> film_of(const RollingCase& c, const std::string& model,
                              const RollingTrajectory& rows) {
  const auto& motion = c.motion;
  if (model != "viscous_contact" || !(motion.roughness > 0) ||
      !(motion.roughness < motion.initial_gap) || !end_of(rows, motion, c.radius).contact_time)
    return {};
  double speed = 0;
  for (const auto& row : rows) speed = std::max(speed, std::abs(row.normal_velocity));
  const double k = lubrication::stokes_resistance(c.viscosity, c.radius) * c.radius;
  return motion.mass * speed / (k * std::log(motion.initial_gap / motion.roughness));
}

}  // namespace

double stokes_of(const RollingCase& c, const RollingEnd& end) {
  return lubrication::stokes_number(c.motion.mass, c.radius, end.largest_speed, c.viscosity);
}

std::optional<double> reynolds_of(const RollingCase& c, const RollingEnd& end) {
  if (!(c.fluid_density > 0)) return {};
  return lubrication::reynolds_number(c.fluid_density, c.radius, end.largest_speed, c.viscosity);
}

std::vector<std::string> rolling_warnings(const RollingResults& results) {
  std::vector<std::string> warnings;
  if (results.c.gravity > 0)
    warnings.push_back(
        fmt::format("rolling.gravity, {:.6g}, is > 0 and lifts a heavy sphere off "
                    "the plane; gravity towards the plane is negative",
                    results.c.gravity));
  const double low = results.fit.gap_interval[0];
  for (const auto& [model, rows] : results.trajectories) {
    const double thinnest = std::ranges::min_element(rows, {}, &RollingRow::gap)->gap;
    // The relative rounding error of the gap of a sphere that rests at the smallest fitted gap.
    constexpr double kRounding = 1e-9;
    const auto end = end_of(rows, results.c.motion, results.c.radius);
    if (const auto reynolds = reynolds_of(results.c, end))
      if (const auto warning = lubrication::reynolds_warning(*reynolds))
        warnings.push_back(fmt::format("{}: {}", model, *warning));
    if (const auto film = film_of(results.c, model, rows))
      if (const auto warning =
              lubrication::film_warning(*film, "the models smooth and rough resolve the drag"))
        warnings.push_back(fmt::format("{}: {}", model, *warning));
    if (rows.back().time < results.c.motion.end_time)
      warnings.push_back(fmt::format(
          "{}: the sphere reaches the wall opposite, at the gap {:.6g}, at time {:.6g}; the motion "
          "ends there",
          model, end.last.gap, end.last.time));
    if (thinnest < (1 - kRounding) * low)
      warnings.push_back(fmt::format(
          "Extrapolation: {} gets down to a gap of {:.4g}, below the smallest fitted gap, {:.4g}",
          model, thinnest, low));
  }
  return warnings;
}

void write_rolling_report(const RollingResults& results, const std::filesystem::path& folder,
                          const results::Provenance& provenance, const StopToken& stop) {
  const auto& units = results.c.units;
  report::Report report(folder, kRollingPictures);
  report.draw(rolling_plots(results), stop);
  std::string opening =
      "<p class=summary>A sphere that moves along a plane in a viscous fluid and turns</p>\n";
  std::vector<std::string> warnings;
  for (const auto& warning : rolling_warnings(results))
    warnings.push_back(report::escaped(warning));
  std::string models;
  for (const auto& model : rolling_models())
    models += fmt::format("<li>{}: {}</li>\n", model.name, model.description);
  report.write(
      results.c.title.empty() ? "Rolling sphere" : results.c.title,
      opening + report::warnings_box(warnings),
      report::section("At the end",
                      units.in_brackets_of(end_table(results)) + "<ul>\n" + models + "</ul>\n") +
          report::section("Motion", report.figures()) +
          report::section("Parameters", units.in_brackets_of(parameters_of_rolling(results))),
      provenance);
}

}  // namespace viscontact::rolling
