// Ends of time steps. Every constant decides the bits of results.
#include "viscontact/particles/steps/step_times.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace viscontact::particles {
namespace {

struct StepEndTuning {
  // Differences of times below this fraction of h count as rounding errors. Rounding errors are
  // smaller in runs of up to 1e9 steps.
  static constexpr double kTiny = 1e-6;
  // A step of the length h that begins at most 1.125 h before a jump would end after the jump, or
  // at most h/8 before it. It is shortened.
  static constexpr double kNear = 1.125;
};

}  // namespace

std::vector<double> jump_times(const Setting& setting) {
  std::vector<double> times;
  const auto add = [&](const PiecewiseConstant& function) {
    const auto& pieces = function.pieces;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const Vector after = k + 1 < pieces.size() ? pieces[k + 1].value : Vector{};
      if (pieces[k].until > 0 && pieces[k].value != after) times.push_back(pieces[k].until);
    }
  };
  if (setting.scheme == Scheme::kLeapfrog) {
    for (const auto* map : {&setting.forces, &setting.torques})
      for (const auto& [particle, function] : *map) add(function);
    for (const auto& plane : setting.planes)
      if (plane.load) add(plane.load->force);
  } else if (setting.laws.restitution.is_on()) {
    for (const auto& plane : setting.planes) add(plane.velocity);
    for (const auto& [particle, motion] : setting.given_motions) add(motion.velocity);
  }
  if (const auto& flow = setting.lubrication)
    for (std::size_t k = 0; k + 1 < flow->pieces.size(); ++k) {
      const auto &piece = flow->pieces[k], &next = flow->pieces[k + 1];
      if (piece.gradient != next.gradient || piece.stress != next.stress)
        times.push_back(piece.until);
    }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

double leapfrog_step_end(double time, double grid_end, double h, std::span<const double> jumps) {
  assert(h > 0);
  assert(std::ranges::is_sorted(jumps));
  const auto next = std::ranges::upper_bound(jumps, time + StepEndTuning::kTiny * h);
  const double until_jump = next == jumps.end() ? 2 * h : *next - time;
  // A step that would end after the jump or shortly before it is shortened so that the jump is in
  // the middle of the next one, which gets the same length.
  if (until_jump <= h / 2) return time + 2 * until_jump;
  if (until_jump <= StepEndTuning::kNear * h) return time + until_jump * 2 / 3;
  const double rest = grid_end - time;
  // The steps return to the grid in one step of the length `rest` or, below h/2, in two.
  if (rest < h / 2 - StepEndTuning::kTiny * h) return time + (rest + h) / 2;
  return grid_end;
}

std::optional<StepInterval> StepGrid::next(const State& state, double end) const {
  assert(time_step_ > 0);
  const double tiny = StepGrid::tiny(time_step_);
  if (!(end > state.time + tiny)) return std::nullopt;
  const double on_grid =
      state.grid_time + static_cast<double>(state.steps + 1 - state.grid_step) * time_step_;
  StepInterval step{time_step_, on_grid};
  if (leapfrog_) {
    step.end = leapfrog_step_end(state.time, on_grid, time_step_, jumps_);
  } else if (const auto jump = std::ranges::upper_bound(jumps_, state.time + tiny);
             jump != jumps_.end() && *jump < on_grid - tiny) {
    step.end = *jump;
  }
  const bool is_cut = step.end > end + tiny;
  if (is_cut) {
    step.end = end;
    step.new_grid = end;
  } else if (step.end != on_grid) {
    // The next step ends on the grid again.
    step.new_grid = (step.end < on_grid - tiny ? on_grid : on_grid + time_step_) - time_step_;
  }
  step.reaches_end = step.end >= end - tiny;
  // A step from one point of the grid to the next has the length h without rounding errors.
  if (is_cut || std::abs(step.end - state.time - time_step_) > tiny) step.h = step.end - state.time;
  return step;
}

double StepGrid::tiny(double h) { return StepEndTuning::kTiny * h; }

void StepGrid::count(State& state, const StepInterval& step) {
  ++state.steps;
  if (!step.new_grid) return;
  state.grid_time = *step.new_grid;
  state.grid_step = state.steps;
}

}  // namespace viscontact::particles
