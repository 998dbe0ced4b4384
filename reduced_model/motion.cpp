#include "reduced_model/motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"

namespace viscontact {

int step_count(double end, double step) {
  constexpr double kMostSteps = 1e8;  // a trajectory of that many rows is 5 GB
  const double steps = std::ceil(end / step - 1e-6);
  if (!(steps <= kMostSteps))
    throw Error(
        ExitCode::kBadInput,
        fmt::format("time step {} makes {:.3g} steps to time {}; at most {:.0e} are allowed", step,
                    steps, end, kMostSteps));
  return std::max(1, static_cast<int>(steps));
}

double step_time(int index, int count, double end, double step) {
  return index == count ? end : index * step;
}

std::vector<double> row_times(const Motion& motion) {
  const double h = motion.reference_time_step;
  const int steps = step_count(motion.end_time, h);
  std::vector<double> times;
  for (int n = 0; n <= steps; ++n) times.push_back(step_time(n, steps, motion.end_time, h));
  for (const double jump : motion.external_force.jumps()) {
    if (jump >= motion.end_time) break;
    // A row that round-off alone sets apart from a jump gives way to it.
    std::erase_if(times, [&](double t) {
      return std::abs(t - jump) < 1e-6 * h && t > 0 && t < motion.end_time;
    });
    times.insert(std::ranges::upper_bound(times, jump), jump);
  }
  return times;
}

}  // namespace viscontact
