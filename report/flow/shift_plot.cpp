// Two panels over the gap: shifts and residuals.
#include "viscontact/report/flow/shift_plot.hpp"

#include <fmt/format.h>

#include <cmath>

#include "viscontact/report/gnuplot.hpp"

namespace viscontact {

std::string plot_wall_shift(const WallShift& shift, const std::string& wall) {
  Curve own{
      "shift of the row alone", "points pointtype 7 pointsize 0.7 linecolor rgb '#0072B2'", {}};
  Curve common{fmt::format("common shift {:.4g}", shift.shift),
               "lines linewidth 2 linecolor rgb '#D55E00'",
               {}};
  Curve residual{"smooth at gap + common shift, over rough, - 1",
                 "linespoints pointtype 7 pointsize 0.5 linecolor rgb '#0072B2'",
                 {}};
  Curve estimate{"the table's own error estimate",
                 "points pointtype 4 pointsize 0.6 linecolor rgb '#000000'",
                 {}};
  for (const auto& row : shift.rows) {
    own.points.emplace_back(row.gap, row.shift);
    common.points.emplace_back(row.gap, shift.shift);
    // A logarithmic scale has no zero, so a residual or an error estimate of 0 is not drawn.
    if (row.relative_residual != 0)
      residual.points.emplace_back(row.gap, std::abs(row.relative_residual));
    if (row.relative_error_estimate > 0)
      estimate.points.emplace_back(row.gap, row.relative_error_estimate);
  }
  Panel shifts;
  shifts.title = fmt::format("Smooth wall that drags like the rough one ({})", wall);
  shifts.x_label = "gap from the crests q";
  shifts.y_label = "shift below the crests";
  shifts.x_log = true;
  shifts.settings = {"set yrange [0:*]", "set key bottom right", "set format x '1e%T'"};
  shifts.curves = {own, common};
  Panel residuals;
  residuals.title = "How well one shift holds";
  residuals.x_label = shifts.x_label;
  residuals.y_label = "relative difference of drag";
  residuals.x_log = true;
  residuals.y_log = true;
  residuals.settings = {"set yrange [*:*]", "set key below Left reverse noopaque",
                        "set format x '1e%T'", "set format y '1e%T'"};
  for (const auto& curve : {residual, estimate})
    if (!curve.points.empty()) residuals.curves.push_back(curve);
  constexpr int kWidth = 860, kPanelHeight = 360;  // [pixels]
  if (residuals.curves.empty()) return draw_svg({shifts}, kWidth, kPanelHeight);
  return draw_svg({shifts, residuals}, kWidth, 2 * kPanelHeight);
}

}  // namespace viscontact
