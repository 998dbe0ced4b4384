// The report's plots of a fit, and of the effect of its errors on the motion (report_plots.hpp).
// Gaps [L] and times [T] are in the units of the case. The names of the plots are names of files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "viscontact/lubrication/stokes_drag.hpp"
#include "viscontact/report/pictures/colours.hpp"
#include "viscontact/report/report_plots.hpp"

namespace viscontact::report {

Plot plot_fit(const lubrication::ForceTable& table, const lubrication::Fit& fit) {
  PlotCurve points{"table (FreeFEM)", {kBlack, 0, {}, PointKind::kCircle, 0.7}, {}};
  PlotCurve line{fmt::format("fit, basis {}", fit.basis), {kBlue}, {}};
  PlotCurve residual{"|fit / table - 1|", {kBlue, 1.5, {}, PointKind::kDisc, 0.4}, {}};
  PlotCurve estimate{
      "table's own error estimate", {kVermilion, 0, {}, PointKind::kSquare, 0.6}, {}};
  const lubrication::LubricationForce force(fit);
  const double stokes = lubrication::stokes_resistance(fit.viscosity, fit.radius);
  for (const auto& row : table.rows) {
    points.points.emplace_back(row.gap, row.drag_factor);
    // The fit was made from another table if this one has rows outside the fit's interval.
    if (row.gap < fit.gap_interval[0] || row.gap > fit.gap_interval[1]) continue;
    residual.points.emplace_back(
        row.gap, std::abs(force.resistance(row.gap) / (-row.force / row.reference_velocity) - 1));
    if (row.relative_error_estimate > 0)
      estimate.points.emplace_back(row.gap, row.relative_error_estimate);
  }
  constexpr int kSamples = 300;  // points of the fit's curve
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
