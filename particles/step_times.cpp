// Places the steps of the leapfrog scheme around jumps of forces (step_times.hpp).
#include "viscontact/particles/step_times.hpp"

#include <algorithm>

namespace viscontact::particles {

std::vector<double> jump_times(std::span<const PiecewiseConstant* const> functions) {
  std::vector<double> times;
  for (const auto* function : functions) {
    const auto& pieces = function->pieces;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const Vector after = k + 1 < pieces.size() ? pieces[k + 1].value : Vector{};
      if (pieces[k].until > 0 && pieces[k].value != after) times.push_back(pieces[k].until);
    }
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

double leapfrog_step_end(double time, double grid_end, double h, std::span<const double> jumps) {
  // Differences of times below this share of a step are rounding errors.
  constexpr double kTiny = 1e-6;
  const auto next = std::ranges::upper_bound(jumps, time + kTiny * h);
  const double until_jump = next == jumps.end() ? 2 * h : *next - time;
  // At most this far from a jump, a whole step would leave less than h/8 to it.
  constexpr double kNear = 1.125;
  if (until_jump <= h / 2) return time + 2 * until_jump;
  if (until_jump <= kNear * h) return time + until_jump * 2 / 3;
  const double rest = grid_end - time;
  // Back on the grid in one step, or in two of equal length if it is near.
  if (rest < h / 2 - kTiny * h) return time + (rest + h) / 2;
  return grid_end;
}

}  // namespace viscontact::particles
