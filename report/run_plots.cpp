// Gaps that are not > 0 are not drawn on logarithmic axes. report.cpp has the names of the plots
// (kPlotNames) and the labels of their axes (kDimensions).
#include "viscontact/report/run_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/stokes_drag.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/pictures/colours.hpp"

namespace viscontact::report {
namespace {

// A value in place of y that interrupts a line.
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

/// Free choices of the plots, by eye.
struct RunPlotTuning {
  // Most parts of a trajectory, and about the parts of all trajectories.
  static constexpr std::size_t kRuns = 400, kRunsOfAll = 3200;
  // Points of an external force, about, for the whole time, and of a fit's curve; a picture shows
  // no more.
  static constexpr int kPointsOfForce = 2000, kPointsOfFit = 300;
  // Top of the axis of the solids' force over the largest external force, because impacts are much
  // larger.
  static constexpr double kAboveLoad = 1.3;
  // Margin of the axis of an external force over its range.
  static constexpr double kMargin = 0.08;
  // If the largest of the thinnest films is more than kManyDecades times the smallest, the axis is
  // logarithmic, because a linear axis would show the largest only. If it is less than kClose times
  // the smallest, the axis does not begin at 0, because the difference could not be seen.
  static constexpr double kManyDecades = 30, kClose = 1.3;
};

using Value = double (*)(const reduced_model::TrajectoryRow&);

/// The style of the line of a model, or, if `film` is true, of the film from its gamma. The place
/// of the model in the list of all models decides which row of kLines it gets; after the last row
/// the first begins again, with longer dashes. Widths of lines [pixels] differ, so that equal
/// curves can be seen. A name that is no model gets a colour of its own.
CurveStyle line_style(std::string_view model, bool film = false) {
  struct Line {
    const char* colour;
    double width;
    bool dashed = false;
  };
  constexpr auto kLines = std::to_array<Line>({{kSkyBlue, 5.0},
                                               {kBlue, 2.0},
                                               {kBlack, 1.6, true},
                                               {kOrange, 3.4},
                                               {kBluishGreen, 2.2},
                                               {kReddishPurple, 2.2},
                                               {kVermilion, 1.4},
                                               {"#7F7F7F", 2.0},
                                               {"#8C564B", 1.6}});
  const auto choice = reduced_model::known_model(model);
  if (!choice) return {"#B8A100", 2.0, {}};
  const auto row = static_cast<std::size_t>(choice->model - reduced_model::all_models().data());
  const auto cycle = row / std::size(kLines);
  const Line& line = kLines[row % std::size(kLines)];
  CurveStyle style{line.colour, line.width, {}};
  if (film && choice->smooth)
    style.dash = {8, 3, 2, 3};
  else if (film)
    style.dash = {8, 5};
  else if (choice->exact_drag)
    style.dash = {2, 4};
  else if (choice->smooth)
    style.dash = {12, 3, 2, 3};
  else if (line.dashed || cycle > 0)
    style.dash = {10 + 8 * static_cast<double>(cycle), 4};
  return style;
}

/// The words of the legend; the name itself if it is no model.
std::string legend_of(std::string_view model) {
  const auto choice = reduced_model::known_model(model);
  return choice ? reduced_model::description_of(*choice) : std::string(model);
}

/// The rows in parts of equal length, of which the first row is kept, and the rows in which `value`
/// is smallest and largest, so that the page stays small. `trajectories` is the number of all
/// trajectories.
std::vector<const reduced_model::TrajectoryRow*> thinned(
    const std::vector<reduced_model::TrajectoryRow>& rows, std::size_t trajectories, Value value) {
  assert(!rows.empty() && trajectories > 0);
  std::vector<const reduced_model::TrajectoryRow*> kept;
  const std::size_t run = std::max<std::size_t>(
      1,
      rows.size() / std::min(RunPlotTuning::kRuns, 1 + RunPlotTuning::kRunsOfAll / trajectories));
  const auto less = [&](const reduced_model::TrajectoryRow& a,
                        const reduced_model::TrajectoryRow& b) { return value(a) < value(b); };
  for (std::size_t i = 0; i < rows.size(); i += run) {
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = rows.begin() + static_cast<std::ptrdiff_t>(std::min(rows.size(), i + run));
    const auto [low, high] = std::minmax_element(begin, end, less);
    kept.push_back(&*begin);
    for (const auto extreme : {std::min(low, high), std::max(low, high)})
      if (&*extreme != kept.back()) kept.push_back(&*extreme);
  }
  if (kept.back() != &rows.back()) kept.push_back(&rows.back());
  return kept;
}

/// The curve of `y`. If the rows must be thinned, the extremes of the value `kept` remain.
PlotCurve curve_of(const reduced_model::Trajectory& trajectory, std::size_t trajectories, Value y,
                   Value kept) {
  PlotCurve curve{legend_of(trajectory.model), line_style(trajectory.model), {}};
  for (const auto* row : thinned(trajectory.rows, trajectories, kept))
    curve.points.emplace_back(row->time, y(*row));
  return curve;
}

double gap_of(const reduced_model::TrajectoryRow& row) { return row.gap; }

}  // namespace

Plot plot_gaps(const std::vector<reduced_model::Trajectory>& trajectories) {
  PlotPanel panel{"Gap between sphere and plane", {"time t"}, {"gap q"}, {}};
  for (const auto& trajectory : trajectories)
    panel.curves.push_back(curve_of(trajectory, trajectories.size(), gap_of, gap_of));
  return {"gap", 520, {panel}};
}

Plot plot_gaps_logarithmic(const std::vector<reduced_model::Trajectory>& trajectories,
                           const reduced_model::Motion& motion,
                           const lubrication::LubricationForce& force) {
  PlotPanel panel{"Gap, logarithmic", {"time t"}, {"gap q", true}, {}};
  std::vector<std::pair<double, double>> through;
  // The axis must show the gaps of models without contact and the films from gamma. The gaps of
  // contact models do not count, because they are very small just after the release.
  double thinnest = std::numeric_limits<double>::infinity();
  for (const auto& trajectory : trajectories) {
    PlotCurve curve{legend_of(trajectory.model), line_style(trajectory.model), {}};
    PlotCurve film{"", line_style(trajectory.model, true), {}};
    const auto choice = reduced_model::known_model(trajectory.model);
    const lubrication::LubricationForce own_force =
        choice ? reduced_model::drag_of(*choice, force) : force;
    const auto contact =
        choice && choice->model->contact != nullptr
            ? std::optional(reduced_model::contact_model_of(*choice, motion, own_force))
            : std::nullopt;
    for (const auto* row : thinned(trajectory.rows, trajectories.size(), gap_of)) {
      const bool in_contact = row->gamma && *row->gamma < 0;
      curve.points.emplace_back(row->time, row->gap > 0 && !in_contact ? row->gap : kGap);
      if (!contact) continue;
      double thickness = kGap;
      try {
        if (in_contact && contact->film_thickness) thickness = contact->film_thickness(*row->gamma);
      } catch (const Error&) {
        // The thickness is below the range of the fit or of a double, and is not drawn.
      }
      film.points.emplace_back(row->time, thickness);
      if (thickness > 0) thinnest = std::min(thinnest, thickness);
    }
    if (!contact)
      for (const auto& row : trajectory.rows)
        if (row.gap > 0) thinnest = std::min(thinnest, row.gap);
    // A cross at the lower end marks where a model without contact goes through the plane.
    if (!contact && trajectory.rows.back().gap == 0)
      through.emplace_back(trajectory.rows.back().time, 0);
    panel.curves.push_back(curve);
    if (std::ranges::any_of(film.points,
                            [](const auto& point) { return std::isfinite(point.second); })) {
      panel.curves.push_back(film);
      panel.title = "Gap, logarithmic; broken lines: film from gamma";
    }
  }
  if (thinnest > 0 && std::isfinite(thinnest)) {
    panel.y.low = thinnest / 2;
    for (auto& [time, gap] : through) gap = thinnest;
  }
  std::ranges::sort(through);
  if (!through.empty())
    panel.curves.push_back(
        {"goes through the plane", {"#D00000", 0, {}, PointKind::kCross, 1.6}, through});
  return {"gap_logarithmic", 560, {panel}};
}

Plot plot_lubrication_force(const std::vector<reduced_model::Trajectory>& trajectories) {
  PlotPanel panel{"Force of the fluid on the sphere, > 0 away from the wall",
                  {"time t"},
                  {"lubrication force"},
                  {}};
  const Value force_of = [](const reduced_model::TrajectoryRow& row) {
    return row.lubrication_force ? *row.lubrication_force : 0;
  };
  double low = 0, high = 0;
  bool is_cut = false;
  for (const auto& trajectory : trajectories) {
    const auto& rows = trajectory.rows;
    if (std::ranges::none_of(rows,
                             [](const auto& row) { return row.lubrication_force.has_value(); }))
      continue;
    panel.curves.push_back(curve_of(trajectory, trajectories.size(), force_of, force_of));
    const auto choice = reduced_model::known_model(trajectory.model);
    const bool is_mean = choice && choice->model->contact != nullptr;
    for (const auto& row : rows) {
      const double load = row.external_force ? -*row.external_force : 0;
      const double force = is_mean ? load : force_of(row);
      low = std::min({low, load, force});
      high = std::max({high, load, force});
    }
  }
  for (const auto& curve : panel.curves)
    for (const auto& [time, force] : curve.points) is_cut = is_cut || force < low || force > high;
  if (is_cut) panel.title += "; impacts are cut off";
  const double margin = 0.1 * (high - low);
  if (margin > 0) {
    panel.y.low = low - margin;
    panel.y.high = high + margin;
  }
  return {"lubrication_force", 440, {panel}};
}

Plot plot_gamma(const std::vector<reduced_model::Trajectory>& trajectories) {
  PlotPanel panel{
      "Adhesion potential: the impulse that the film has absorbed", {"time t"}, {"gamma"}, {}};
  for (const auto& trajectory : trajectories)
    if (trajectory.rows.back().gamma)
      panel.curves.push_back(curve_of(
          trajectory, trajectories.size(),
          [](const reduced_model::TrajectoryRow& row) { return row.gamma ? *row.gamma : kGap; },
          [](const reduced_model::TrajectoryRow& row) { return row.gamma ? *row.gamma : 0; }));
  return {"gamma", 440, {panel}};
}

Plot plot_solid_force(const std::vector<reduced_model::Trajectory>& trajectories) {
  PlotPanel panel{
      "Force of the solid contact; impacts are cut off", {"time t"}, {"force of the solids"}, {}};
  double load = 0;
  const Value solid_of = [](const reduced_model::TrajectoryRow& row) {
    return row.solid_force ? *row.solid_force : 0;
  };
  for (const auto& trajectory : trajectories) {
    if (std::ranges::none_of(trajectory.rows, [&](const auto& row) { return solid_of(row) > 0; }))
      continue;
    panel.curves.push_back(curve_of(trajectory, trajectories.size(), solid_of, solid_of));
    for (const auto& row : trajectory.rows)
      if (row.external_force) load = std::max(load, std::abs(*row.external_force));
  }
  panel.y.low = 0;
  if (load > 0) panel.y.high = RunPlotTuning::kAboveLoad * load;
  return {"solid_force", 440, {panel}};
}

Plot plot_external_force(const reduced_model::ExternalForce& force, double end_time) {
  assert(end_time > 0);
  // A jump of the force has two points, before and after it, so that it is drawn as a step.
  PlotPanel panel{"External force", {"time t"}, {"f"}, {}};
  PlotCurve curve{"external force", {kBlack}, {}};
  auto stops = force.jumps();
  std::erase_if(stops, [&](double t) { return t >= end_time; });
  stops.push_back(end_time);
  double from = 0;
  for (const double to : stops) {
    const int points = 2 + static_cast<int>(RunPlotTuning::kPointsOfForce * (to - from) / end_time);
    for (int i = 0; i <= points; ++i) {
      const double t = from + (to - from) * i / points;
      curve.points.emplace_back(t, force.value(i == points ? std::nextafter(to, from) : t));
    }
    from = to;
  }
  double low = 0, high = 0;
  for (const auto& [t, f] : curve.points) {
    low = std::min(low, f);
    high = std::max(high, f);
  }
  const double margin = RunPlotTuning::kMargin * std::max(high - low, 1e-300);
  panel.y.low = low - margin;
  panel.y.high = high + margin;
  panel.curves.push_back(curve);
  return {"external_force", 340, {panel}};
}

Plot plot_minimal_gaps(const reduced_model::Comparison& comparison,
                       const std::optional<case_file::PublishedGap>& published) {
  // Each model has a row; that of the first model is at the top.
  const auto rows = comparison.models.size();
  PlotPanel panel{"Thinnest film of each model", {"gap q"}, {}, {}};
  PlotCurve computed{"smallest gap computed", {kBlue, 0, {}, PointKind::kDisc, 1.2}, {}};
  PlotCurve from_gamma{"film from gamma", {kBlue, 0, {}, PointKind::kCircle, 1.2}, {}};
  panel.rows.resize(rows);
  std::vector<double> all;
  for (std::size_t i = 0; i < rows; ++i) {
    const auto& model = comparison.models[i];
    const double gap = model.film_from_gamma.value_or(model.minimal_gap);
    panel.rows[rows - 1 - i] = model.model + (gap > 0 ? "" : " (0)");
    if (!(gap > 0)) continue;
    all.push_back(gap);
    (model.film_from_gamma ? from_gamma : computed)
        .points.emplace_back(gap, static_cast<double>(rows - i));
  }
  const double top = static_cast<double>(rows) + 0.6, bottom = 0.4;
  for (auto* curve : {&computed, &from_gamma}) {
    std::ranges::stable_sort(curve->points, {}, &std::pair<double, double>::first);
    if (!curve->points.empty()) panel.curves.push_back(*curve);
  }
  if (published) {
    all.push_back(published->minimal_gap);
    panel.curves.push_back({fmt::format("{}: {:.4g}", published->source, published->minimal_gap),
                            {kVermilion, 2, {8, 5}},
                            {{published->minimal_gap, bottom}, {published->minimal_gap, top}}});
  }
  if (all.empty()) return {};
  const auto [low, high] = std::ranges::minmax(all);
  const double span = std::max(high - low, 0.05 * high);
  panel.x.logarithmic = high / low > RunPlotTuning::kManyDecades;
  panel.x.low = panel.x.logarithmic ? low / 3 : high < RunPlotTuning::kClose * low ? low - span : 0;
  panel.x.high = panel.x.logarithmic                  ? high * 3
                 : high < RunPlotTuning::kClose * low ? high + span
                                                      : high * 1.15;
  panel.y.low = bottom;
  panel.y.high = top;
  return {"thinnest_film", 180 + 34 * static_cast<int>(rows), {panel}};
}

Plot plot_fit(const lubrication::MotionTable& table, const lubrication::Fit& fit) {
  PlotCurve points{"table (FreeFEM)", {kBlack, 0, {}, PointKind::kCircle, 0.7}, {}};
  PlotCurve line{fmt::format("fit, basis {}", fit.basis), {kBlue}, {}};
  PlotCurve residual{"|fit / table - 1|", {kBlue, 1.5, {}, PointKind::kDisc, 0.4}, {}};
  PlotCurve estimate{
      "table's own error estimate", {kVermilion, 0, {}, PointKind::kSquare, 0.6}, {}};
  const lubrication::LubricationForce force(fit);
  const double stokes = lubrication::stokes_resistance(fit.viscosity, fit.radius);
  for (const auto& row : table.rows) {
    points.points.emplace_back(row.gap, row.force_factor);
    // Rows outside the fit's interval mean that the fit was made from another table.
    if (row.gap < fit.gap_interval[0] || row.gap > fit.gap_interval[1]) continue;
    residual.points.emplace_back(
        row.gap, std::abs(force.resistance(row.gap) / (-row.force / row.reference_velocity) - 1));
    if (row.relative_error_estimate > 0)
      estimate.points.emplace_back(row.gap, row.relative_error_estimate);
  }
  constexpr int kSamples = RunPlotTuning::kPointsOfFit;
  const auto [low, high] = fit.gap_interval;
  for (int i = 0; i <= kSamples; ++i) {
    const double gap = std::clamp(
        std::exp(std::lerp(std::log(low), std::log(high), static_cast<double>(i) / kSamples)), low,
        high);
    line.points.emplace_back(gap, force.resistance(gap) / stokes);
  }
  // A table with several velocities has each gap several times; curves need the gaps in order.
  for (auto* curve : {&points, &residual, &estimate})
    std::ranges::stable_sort(curve->points, {}, &std::pair<double, double>::first);
  // A logarithmic axis has no zero, so a residual of 0 is not drawn.
  for (auto& [gap, value] : residual.points)
    if (value == 0) value = std::numeric_limits<double>::quiet_NaN();
  PlotPanel residuals{"Relative residual of the fit",
                      {"gap q", true},
                      {"relative", true},
                      {residual},
                      KeyPlace::kBottomRight};
  if (!estimate.points.empty()) residuals.curves.push_back(estimate);
  return {"fit",
          720,
          {{"Drag factor: force over Stokes drag",
            {"gap q", true},
            {"lambda", true},
            {line, points},
            KeyPlace::kTopRight},
           residuals}};
}

Plot plot_uncertainty(const reduced_model::FitUncertainty& uncertainty) {
  PlotPanel panel{"Gap without inertia: intervals, relative to the gap with the fit",
                  {"time t"},
                  {"q / q of the fit - 1"},
                  {}};
  const auto curve = [&](const char* legend, const CurveStyle& style,
                         std::array<double, 2> reduced_model::UncertainGap::*interval,
                         std::size_t end) {
    PlotCurve result{legend, style, {}};
    for (const auto& gap : uncertainty.gaps)
      result.points.emplace_back(gap.time, (gap.*interval)[end] / gap.gap - 1);
    panel.curves.push_back(result);
  };
  const CurveStyle random{kBlue}, misfit{kVermilion, 2, {8, 5}};
  curve("95 % of the random draws of coefficients", random, &reduced_model::UncertainGap::random,
        0);
  curve("", random, &reduced_model::UncertainGap::random, 1);
  curve("drag wrong by the largest misfit at every gap", misfit,
        &reduced_model::UncertainGap::misfit, 0);
  curve("", misfit, &reduced_model::UncertainGap::misfit, 1);
  return {"uncertainty", 440, {panel}};
}

}  // namespace viscontact::report
