#include "app/report_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/gnuplot.hpp"
#include "common/error.hpp"
#include "common/named.hpp"
#include "fitting/stokes_drag.hpp"
#include "reduced_model/models.hpp"

namespace viscontact {
namespace {

constexpr int kWidth = 860;
constexpr const char* kKeyBelow = "set key below Left reverse noopaque\nset xlabel offset 0,0.9";
constexpr const char* kDecades = "set format y '1e%T'";
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();  // interrupts a line

/// The model of that name; nothing for a user's own.
std::optional<ModelChoice> known_model(std::string_view name) {
  try {
    return find_model(name);
  } catch (const Error&) {
    return {};
  }
}

/// Colours that colour-blind readers tell apart (Okabe & Ito 2008), by place in the table of
/// models; curves that lie on each other differ in dash and width too.
std::string line_style(std::string_view model, bool film = false) {
  constexpr std::array kColours = {"#56B4E9", "#0072B2", "#000000", "#E69F00", "#009E73",
                                   "#CC79A7", "#D55E00", "#7F7F7F", "#8C564B", "#B8A100"};
  constexpr std::array kWidths = {5.0, 2.0, 1.6, 3.4, 2.2, 2.2, 1.4, 2.0, 1.6, 2.0};
  const auto choice = known_model(model);
  const auto place =
      choice ? static_cast<std::size_t>(choice->model - all_models().data()) : kColours.size() - 1;
  const auto i = std::min(place, kColours.size() - 1);
  const char* dash = film && choice && choice->smooth ? "(8,3,2,3)"
                     : film                           ? "(8,5)"
                     : choice && choice->exact_drag   ? "(2,4)"
                     : choice && choice->smooth       ? "(12,3,2,3)"
                     : place == 2                     ? "(10,4)"
                                                      : "1";
  return fmt::format("lines linecolor rgb '{}' linewidth {} dashtype {}", kColours[i], kWidths[i],
                     dash);
}

std::string legend_of(std::string_view model) {
  const auto choice = known_model(model);
  return choice ? description_of(*choice) : std::string(model);
}

/// Few enough rows for a page: every n-th, and with each skipped run its extremes of `value`, so
/// that no minimum is lost.
std::vector<const TrajectoryRow*> thinned(const std::vector<TrajectoryRow>& rows,
                                          double (*value)(const TrajectoryRow&)) {
  constexpr std::size_t kRuns = 400;
  std::vector<const TrajectoryRow*> kept;
  const std::size_t run = std::max<std::size_t>(1, rows.size() / kRuns);
  const auto less = [&](const TrajectoryRow& a, const TrajectoryRow& b) {
    return value(a) < value(b);
  };
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

double gap_of(const TrajectoryRow& row) { return row.gap; }

}  // namespace

std::string plot_fit(const ForceTable& table, const Fit& fit) {
  Curve points{"table (FreeFEM)", "points pointtype 6 pointsize 0.7 linecolor rgb '#000000'", {}};
  Curve line{
      fmt::format("fit, basis {}", fit.basis), "lines linecolor rgb '#0072B2' linewidth 2", {}};
  Curve residual{
      "fit - table", "linespoints pointtype 7 pointsize 0.4 linecolor rgb '#0072B2'", {}};
  Curve estimate{
      "table's own error estimate", "points pointtype 4 pointsize 0.6 linecolor rgb '#D55E00'", {}};
  const LubricationForce force(fit);
  const double stokes = stokes_resistance(fit.viscosity, fit.radius);
  for (const auto& row : table.rows) {
    points.points.emplace_back(row.gap, row.drag_factor);
    residual.points.emplace_back(
        row.gap, std::abs(force.resistance(row.gap) / (-row.force / row.reference_velocity) - 1));
    if (row.relative_error_estimate > 0)
      estimate.points.emplace_back(row.gap, row.relative_error_estimate);
  }
  constexpr int kSamples = 300;
  const auto [low, high] = fit.gap_interval;
  for (int i = 0; i <= kSamples; ++i) {
    const double gap = std::clamp(
        std::exp(std::lerp(std::log(low), std::log(high), static_cast<double>(i) / kSamples)), low,
        high);
    line.points.emplace_back(gap, force.resistance(gap) / stokes);
  }
  return draw_svg({{"Drag factor: force over Stokes drag",
                    "gap q",
                    "lambda",
                    true,
                    true,
                    {"set key top right"},
                    {line, points}},
                   {"Relative residual of the fit",
                    "gap q",
                    "relative",
                    true,
                    true,
                    {kDecades, "set key bottom right"},
                    {residual, estimate}}},
                  kWidth, 720);
}

std::string plot_gaps(const std::vector<Trajectory>& trajectories) {
  Panel panel{"Gap between sphere and plane", "time t", "gap q", false, false, {kKeyBelow}, {}};
  for (const auto& trajectory : trajectories) {
    Curve curve{legend_of(trajectory.model), line_style(trajectory.model), {}};
    for (const auto* row : thinned(trajectory.rows, gap_of))
      curve.points.emplace_back(row->time, row->gap);
    panel.curves.push_back(curve);
  }
  return draw_svg({panel}, kWidth, 520);
}

std::string plot_gaps_logarithmic(const std::vector<Trajectory>& trajectories, const Motion& motion,
                                  const LubricationForce& force) {
  Panel panel{"Gap, logarithmic", "time t", "gap q", false, true, {kDecades, kKeyBelow}, {}};
  std::vector<std::pair<double, double>> through;
  double thinnest = std::numeric_limits<double>::infinity();  // of what is worth seeing: not a
                                                              // released sphere's first step
  for (const auto& trajectory : trajectories) {
    Curve curve{legend_of(trajectory.model), line_style(trajectory.model), {}};
    Curve film{"", line_style(trajectory.model, true), {}};
    const auto choice = known_model(trajectory.model);
    const LubricationForce own_force = choice ? drag_of(*choice, force) : force;
    const auto contact = choice && choice->model->contact != nullptr
                             ? std::optional(choice->model->contact(motion, own_force))
                             : std::nullopt;
    for (const auto* row : thinned(trajectory.rows, gap_of)) {
      const bool in_contact = row->gamma && *row->gamma < 0;
      curve.points.emplace_back(row->time, row->gap > 0 && !in_contact ? row->gap : kGap);
      if (!contact) continue;
      double thickness = kGap;
      try {
        if (in_contact && contact->film_thickness) thickness = contact->film_thickness(*row->gamma);
      } catch (const Error&) {
        // Thinner than the fit knows: not drawn.
      }
      film.points.emplace_back(row->time, thickness);
      if (thickness > 0) thinnest = std::min(thinnest, thickness);
    }
    if (!contact)
      for (const auto& row : trajectory.rows)
        if (row.gap > 0) thinnest = std::min(thinnest, row.gap);
    // A model without contact that goes through the plane all the same: a cross at the lower edge.
    if (!contact && trajectory.rows.back().gap == 0)
      through.emplace_back(trajectory.rows.back().time, 0);
    panel.curves.push_back(curve);
    if (std::ranges::any_of(film.points,
                            [](const auto& point) { return std::isfinite(point.second); })) {
      panel.curves.push_back(film);
      panel.title = "Gap, logarithmic; broken lines: film recovered from gamma";
    }
  }
  if (thinnest > 0 && std::isfinite(thinnest)) {
    panel.settings.push_back(fmt::format("set yrange [{}:*]", thinnest / 2));
    for (auto& [time, gap] : through) gap = thinnest;
  }
  if (!through.empty())
    panel.curves.push_back(
        {"goes through the plane",
         "points pointtype 2 pointsize 1.6 linewidth 2.5 linecolor rgb '#D00000'", through});
  return draw_svg({panel}, kWidth, 560);
}

std::string plot_gamma(const std::vector<Trajectory>& trajectories) {
  Panel panel{"Adhesion potential: the impulse that the film has absorbed",
              "time t",
              "gamma",
              false,
              false,
              {kKeyBelow},
              {}};
  for (const auto& trajectory : trajectories) {
    if (!trajectory.rows.back().gamma) continue;
    Curve curve{legend_of(trajectory.model), line_style(trajectory.model), {}};
    for (const auto* row :
         thinned(trajectory.rows, [](const TrajectoryRow& r) { return r.gamma ? *r.gamma : 0; }))
      curve.points.emplace_back(row->time, row->gamma ? *row->gamma : kGap);
    panel.curves.push_back(curve);
  }
  return panel.curves.empty() ? "" : draw_svg({panel}, kWidth, 440);
}

std::string plot_solid_force(const std::vector<Trajectory>& trajectories) {
  Panel panel{"What the solid carries; impacts are cut off",
              "time t",
              "force of the solids",
              false,
              false,
              {kKeyBelow},
              {}};
  double load = 0;
  const auto solid_of = [](const TrajectoryRow& row) {
    return row.solid_force ? *row.solid_force : 0;
  };
  for (const auto& trajectory : trajectories) {
    if (std::ranges::none_of(trajectory.rows, [&](const auto& row) { return solid_of(row) > 0; }))
      continue;
    Curve curve{legend_of(trajectory.model), line_style(trajectory.model), {}};
    for (const auto* row : thinned(trajectory.rows, solid_of))
      curve.points.emplace_back(row->time, solid_of(*row));
    panel.curves.push_back(curve);
    for (const auto& row : trajectory.rows)
      if (row.external_force) load = std::max(load, std::abs(*row.external_force));
  }
  if (load > 0) panel.settings.push_back(fmt::format("set yrange [0:{}]", 1.3 * load));
  return panel.curves.empty() ? "" : draw_svg({panel}, kWidth, 440);
}

std::string plot_external_force(const ExternalForce& force, double end_time) {
  // Steps are drawn as such: two points at each jump.
  Panel panel{"External force", "time t", "f", false, false, {}, {}};
  Curve curve{"", "lines linecolor rgb '#000000' linewidth 2", {}};
  auto stops = force.jumps();
  std::erase_if(stops, [&](double t) { return t >= end_time; });
  stops.push_back(end_time);
  constexpr int kPoints = 2000;
  double from = 0;
  for (const double to : stops) {
    const int points = 2 + static_cast<int>(kPoints * (to - from) / end_time);
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
  const double margin = 0.08 * std::max(high - low, 1e-300);
  panel.settings.push_back(fmt::format("set yrange [{}:{}]", low - margin, high + margin));
  panel.curves.push_back(curve);
  return draw_svg({panel}, kWidth, 320);
}

std::string plot_minimal_gaps(const Comparison& comparison,
                              const std::optional<PublishedGap>& published) {
  // A row a model, from the top down.
  const auto rows = static_cast<int>(comparison.models.size());
  Panel panel{"Thinnest film of each model", "gap q", "", false, false, {}, {}};
  std::string ticks;
  std::vector<double> all;
  for (int i = 0; i < rows; ++i) {
    const auto& model = comparison.models[static_cast<std::size_t>(i)];
    const double y = rows - i;
    const bool recovered = model.recovered_minimal_gap.has_value();
    const double gap = model.recovered_minimal_gap.value_or(model.minimal_gap);
    ticks += fmt::format("{}'{}{}' {}", ticks.empty() ? "" : ", ", model.model,
                         gap > 0 ? "" : " (0)", y);
    if (!(gap > 0)) continue;
    all.push_back(gap);
    panel.curves.push_back({"",
                            fmt::format("points pointtype {} pointsize 1.2 linecolor rgb '#0072B2'",
                                        recovered ? 6 : 7),
                            {{gap, y}}});
  }
  if (published) {
    all.push_back(published->minimal_gap);
    panel.curves.push_back({fmt::format("{}: {:.4g}", published->source, published->minimal_gap),
                            "lines linecolor rgb '#D55E00' linewidth 2 dashtype (8,5)",
                            {{published->minimal_gap, 0.4}, {published->minimal_gap, rows + 0.6}}});
  }
  if (all.empty()) return "";
  const auto [low, high] = std::ranges::minmax(all);
  constexpr double kManyDecades = 30;  // beyond that ratio a linear axis shows the largest only
  panel.x_log = high / low > kManyDecades;
  constexpr double kClose = 1.3;  // an axis from 0 would hide the difference
  const bool close = high < kClose * low;
  const double span = std::max(high - low, 0.05 * high);
  panel.settings = {"set ytics (" + ticks + ")",
                    fmt::format("set yrange [0.4:{}]", rows + 0.6),
                    "set lmargin 38",
                    panel.x_log
                        ? fmt::format("set xrange [{}:{}]\nset format x '1e%T'", low / 3, high * 3)
                    : close ? fmt::format("set xrange [{}:{}]", low - span, high + span)
                            : fmt::format("set xrange [0:{}]", high * 1.15),
                    kKeyBelow,
                    "set xlabel offset 0,0.2"};
  panel.x_label = "gap q (filled: smallest gap computed; open: recovered from gamma)";
  return draw_svg({panel}, kWidth, 160 + 34 * rows);
}

std::string plot_uncertainty(const FitUncertainty& uncertainty) {
  Panel panel{"Gap without inertia: intervals around the fit's, relative",
              "time t",
              "q / q of the fit - 1",
              false,
              false,
              {kKeyBelow},
              {}};
  const auto curve = [&](const char* legend, const char* style,
                         std::array<double, 2> UncertainGap::*interval, std::size_t end) {
    Curve result{legend, style, {}};
    for (const auto& gap : uncertainty.gaps)
      result.points.emplace_back(gap.time, (gap.*interval)[end] / gap.gap - 1);
    panel.curves.push_back(result);
  };
  constexpr const char* kRandom = "lines linecolor rgb '#0072B2' linewidth 2";
  constexpr const char* kMisfit = "lines linecolor rgb '#D55E00' linewidth 2 dashtype (8,5)";
  curve("95 % of the draws of coefficients", kRandom, &UncertainGap::random, 0);
  curve("", kRandom, &UncertainGap::random, 1);
  curve("drag off by the largest misfit everywhere", kMisfit, &UncertainGap::misfit, 0);
  curve("", kMisfit, &UncertainGap::misfit, 1);
  return draw_svg({panel}, kWidth, 440);
}

}  // namespace viscontact
