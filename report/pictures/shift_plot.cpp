// Draws shifts [L] and relative residuals over the gap [L], in two panels (shift_plot.hpp).
#include "viscontact/report/pictures/shift_plot.hpp"

#include <fmt/format.h>

#include <cmath>

#include "viscontact/report/pictures/gnuplot.hpp"

namespace viscontact::report {

std::string plot_wall_shift(const fitting::WallShift& shift, const std::string& wall, TextKind kind,
                            const StopToken& stop) {
  Curve own{
      "shift of the row alone", "points pointtype 7 pointsize 0.7 linecolor rgb '#0072B2'", {}};
  Curve common{fmt::format("common shift {:.4g}", shift.shift),
               "lines linewidth 2 linecolor rgb '#D55E00'",
               {}};
  Curve residual{"|smooth wall at gap + common shift / rough wall - 1|",
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
  const Panel shifts{fmt::format("Smooth wall with the same drag as the rough one ({})", wall),
                     "gap from the crests q",
                     "shift below the crests",
                     true,
                     false,
                     {"set yrange [0:*]", "set key bottom right", "set format x '1e%T'"},
                     {own, common}};
  Panel residuals{"Residuals with the common shift",
                  shifts.x_label,
                  "relative difference of drag",
                  true,
                  true,
                  {"set yrange [*:*]", kLegendBelow, "set format x '1e%T'", "set format y '1e%T'"},
                  {}};
  for (const auto& curve : {residual, estimate})
    if (!curve.points.empty()) residuals.curves.push_back(curve);
  constexpr int kWidth = 860, kPanelHeight = 360;  // [pixels]
  if (residuals.curves.empty()) return draw_picture(kind, {shifts}, kWidth, kPanelHeight, stop);
  return draw_picture(kind, {shifts, residuals}, kWidth, 2 * kPanelHeight, stop);
}

}  // namespace viscontact::report
