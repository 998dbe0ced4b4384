// Gauss-Newton iteration for the one unknown, the depth of the smooth wall below the crests.
#include "viscontact/fitting/wall_shift.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::fitting {
namespace {

double resistance_of(const lubrication::MotionRow& row) {
  return -row.force / row.reference_velocity;
}

/// The gap [L] at which the smooth wall has this resistance [M/T], which decreases with the gap, by
/// bisection of ln(gap) to round-off. `row` is for the message of Error(kBadInput), which is thrown
/// if no gap of the fitted interval has this resistance.
double smooth_gap_of(const lubrication::LubricationForce& smooth, double resistance,
                     const lubrication::MotionRow& row) {
  auto [low, high] = smooth.interval();
  if (!(resistance <= smooth.resistance(low) && resistance >= smooth.resistance(high)))
    throw Error(
        ErrorKind::kBadInput,
        "no gap in the fit's interval [{1}, {2}] has the drag that the table has at gap {0}",
        row.gap, low, high);
  while (true) {
    const double middle = std::sqrt(low * high);
    if (!(middle > low && middle < high)) return middle;
    (smooth.resistance(middle) > resistance ? low : high) = middle;
  }
}

}  // namespace

WallShift fit_wall_shift(const lubrication::MotionTable& rough,
                         const lubrication::LubricationForce& smooth) {
  assert(!rough.rows.empty());
  if (!equal_up_to_rounding(rough.viscosity, smooth.viscosity()) ||
      !equal_up_to_rounding(rough.radius, smooth.radius()))
    throw Error(ErrorKind::kBadInput,
                "the table has viscosity {} and radius {}, and the fit has viscosity {} and radius "
                "{}; they must be equal",
                rough.viscosity, rough.radius, smooth.viscosity(), smooth.radius());
  const auto [smallest, largest] = smooth.interval();
  if (smallest == 0 || largest == smooth.largest_gap())
    throw Error(ErrorKind::kBadInput,
                "the smooth wall has a formula for gaps outside its fitted interval; give a force "
                "without one (OutsideInterval)");
  WallShift result;
  // Bounds of the shift, so that all shifted gaps are in the interval of the smooth force.
  double least = 0;
  double most = largest;
  for (const auto& row : rough.rows) {
    const double shift = smooth_gap_of(smooth, resistance_of(row), row) - row.gap;
    result.rows.push_back({row.gap, shift, 0, row.relative_error_estimate});
    least = std::max(least, smallest - row.gap);
    most = std::min(most, largest - row.gap);
  }

  if (!(least <= most))
    throw Error(ErrorKind::kBadInput,
                "no shift of the wall brings all gaps of the table into the fit's interval [{}, "
                "{}]; give a table with fewer gaps or a fit of more",
                smallest, largest);

  // Gauss-Newton starts at the median of the shifts that single rows need, within the bounds.
  auto shifts = result.rows;
  std::ranges::sort(shifts, {}, &ShiftedRow::shift);
  double shift = std::clamp(shifts[shifts.size() / 2].shift, least, most);
  // The limit only ends an iteration that does not converge; wall_shift.hpp repeats it.
  constexpr int kMostSteps = 100;
  // The iteration ends if the shift changes by at most this fraction of (first gap + |shift|),
  // which is a change of the size of rounding errors.
  constexpr double kTolerance = 1e-14;
  for (int step = 0;; ++step) {
    if (step == kMostSteps)
      throw Error(ErrorKind::kNotConverged, "no common shift of the wall fits the table");
    double slope2 = 0, slope_residual = 0;
    for (const auto& row : rough.rows) {
      const double gap = row.gap + shift;
      const double ratio = smooth.resistance(gap) / resistance_of(row);
      const double slope = smooth.resistance_log_slope(gap) / gap / resistance_of(row);
      slope2 += slope * slope;
      slope_residual += slope * (ratio - 1);
    }
    const double next = std::clamp(shift - slope_residual / slope2, least, most);
    const double change = std::abs(next - shift);
    shift = next;
    if (change <= kTolerance * (result.rows.front().gap + std::abs(shift))) break;
  }

  result.shift = shift;
  double sum2 = 0;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    auto& row = result.rows[i];
    row.relative_residual = smooth.resistance(row.gap + shift) / resistance_of(rough.rows[i]) - 1;
    sum2 += row.relative_residual * row.relative_residual;
    result.largest_relative_residual =
        std::max(result.largest_relative_residual, std::abs(row.relative_residual));
  }
  result.rms_relative_residual = std::sqrt(sum2 / static_cast<double>(result.rows.size()));
  return result;
}

}  // namespace viscontact::fitting
