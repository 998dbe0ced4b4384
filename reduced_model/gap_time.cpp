// The inverse of the gap that is interpolated between rows, by bisection.
#include "viscontact/reduced_model/gap_time.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {
namespace {

/// What a trajectory says of its gap at the time of a row.
struct Sample {
  double time = 0;
  double gap = 0;                ///< [L], >= 0
  std::optional<double> growth;  ///< rate of ln(gap) [1/T]; nothing in contact
};

/// The share of the step from `a` to `b` [1] after which the gap is `gap`, which lies between those
/// of both.
double share_of_step(const Sample& a, const Sample& b, double gap) {
  if (a.gap == gap) return 0;
  if (!(a.gap > 0 && b.gap > 0)) return (gap - a.gap) / (b.gap - a.gap);
  const double step = b.time - a.time, whole = std::log(b.gap / a.gap);
  const double part = std::log(gap / a.gap);
  if (!a.growth || !b.growth) return part / whole;
  const double first = *a.growth * step, last = *b.growth * step;
  double low = 0, high = 1;
  // Each bisection gains a bit.
  for (int k = 0; k < 53; ++k) {
    const double s = (low + high) / 2;
    const double cubic = s * (s * (3 - 2 * s) * whole + (1 - s) * ((1 - s) * first - s * last));
    ((cubic < part) == (whole > 0) ? low : high) = s;
  }
  return high;
}

}  // namespace

std::vector<GapTime> gap_times(const std::vector<TrajectoryRow>& rows, std::span<const double> gaps,
                               const std::function<double(const TrajectoryRow&)>& film,
                               double thickest_film) {
  assert(!rows.empty());
  std::vector<GapTime> times;
  for (const double gap : gaps) times.push_back({gap, {}});
  if (times.empty()) return times;
  const auto sample_of = [&](const TrajectoryRow& row) -> Sample {
    if (film && row.gamma && *row.gamma < 0) return {row.time, film(row), {}};
    if (row.gap < thickest_film || row.gap == 0)
      return {row.time, std::max(row.gap, thickest_film), {}};
    return {row.time, row.gap, row.velocity / row.gap};
  };
  Sample before = sample_of(rows.front());
  for (auto& of : times)
    if (before.gap == of.gap) of.time = before.time;
  for (const auto& row : rows) {
    const Sample after = sample_of(row);
    for (auto& of : times)
      if (!of.time && (before.gap - of.gap) * (after.gap - of.gap) <= 0 && before.gap != after.gap)
        of.time = std::lerp(before.time, after.time, share_of_step(before, after, of.gap));
    before = after;
  }
  return times;
}

}  // namespace viscontact::reduced_model
