// Steps and rows in time that the models of motion share. Another step_count() or row_times()
// changes trajectories and must raise kModelsRevision.
#include "viscontact/reduced_model/motion.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "viscontact/common/error.hpp"

namespace viscontact::reduced_model {
namespace {

/// Free choices of the times of steps and rows; motion.hpp repeats both.
struct TimeGridTuning {
  static constexpr double kMostSteps = 1e8;  // so many rows of a trajectory take 5 GB
  // A shorter part of a step, and a shorter distance from a jump, is the rounding error of a time.
  static constexpr double kRounding = 1e-6;
};

}  // namespace

double Motion::restitution() const {
  const auto found = parameters.find(kRestitution.key);
  return found == parameters.end() ? 0 : found->second;
}

double Motion::parameter(const ModelParameter& which) const {
  const auto found = parameters.find(which.key);
  if (found == parameters.end())
    throw Error(ErrorKind::kBadInput, "the parameter {} of the model has no value", which.key);
  return found->second;
}

void report_progress(const Motion& motion, double time) {
  motion.stop.throw_if_stop_requested();
  if (motion.progress) motion.progress(time);
}

int step_count(double end, double step) {
  const double steps = std::ceil(end / step - TimeGridTuning::kRounding);
  if (!(steps <= TimeGridTuning::kMostSteps))
    throw Error(ErrorKind::kBadInput,
                "the time step {} makes {:.3g} steps to time {}; at most {:.0e} are allowed", step,
                steps, end, TimeGridTuning::kMostSteps);
  return std::max(1, static_cast<int>(steps));
}

std::vector<double> row_times(const Motion& motion, const ModelParameter& parameter) {
  const double spacing = motion.parameter(parameter);
  const int steps = step_count(motion.end_time, spacing);
  auto jumps = motion.external_force.jumps();
  std::erase_if(jumps,
                [&](double t) { return t >= motion.end_time || are_one_time(t, motion.end_time); });
  // A multiple of the spacing that is so close to a jump differs from it by rounding only. The
  // multiple is left out, and the jump is kept.
  const auto is_a_jump = [&](double t) {
    const auto next = std::ranges::lower_bound(jumps, t);
    const auto close = [&](double jump) {
      return std::abs(t - jump) < TimeGridTuning::kRounding * spacing;
    };
    return (next != jumps.end() && close(*next)) ||
           (next != jumps.begin() && close(*std::prev(next)));
  };
  std::vector<double> grid;
  for (int n = 0; n <= steps; ++n) {
    const double t = step_time(n, steps, motion.end_time, spacing);
    if (n == 0 || n == steps || !is_a_jump(t)) grid.push_back(t);
  }
  std::vector<double> times;
  std::ranges::merge(grid, jumps, std::back_inserter(times));
  return times;
}

}  // namespace viscontact::reduced_model
