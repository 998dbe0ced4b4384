// The table of strategies for convex problems, (5.9) and (5.17), docs/physics.md, and their steps.
#include "viscontact/contact_solver/convex_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viscontact/contact_solver/problem/cone.hpp"

namespace viscontact::contact_solver {
namespace {

struct ConvexTuning {
  // Accuracies of interior points relative to the violations without impulses. With 1e-6 in place
  // of kAccurate spheres take 3 to 7 % less time, but proximal steps fail where several contacts
  // are near the tips of their cones. A solution with kRough only finds the pairs that take part,
  // and first loads. In bench/box2d.cpp it misses no more pairs with 1e-2 than with 1e-3, but some
  // more with 3e-2. kExact is for problems that are near their solution.
  static constexpr double kRough = 1e-2, kAccurate = 1e-9, kExact = 1e-13;
  static constexpr int kMostInteriorPoints = 60;
  // Accelerated sweeps: packings of 10 000 spheres took up to 2139. Extrapolations over 200 to 2000
  // sweeps are as good, over 100 take half as many sweeps more, over 30 four times as many.
  static constexpr SweepPlan kSweeps{.most = 3000, .longest = 300};
  // Most solutions near their guess take two to eight iterations.
  static constexpr int kMostNearGuess = 20;
  // Epsilon begins at kFirstEpsilon. The errors of the impulses are the rounding errors of the gaps
  // divided by epsilon, and with a smaller first epsilon they are too large.
  static constexpr double kFirstEpsilon = 1e-5, kLeastEpsilon = 1e-8, kLargestEpsilon = 0.1,
                          kFactor = 10;
  static constexpr int kMostOfStep = 50;
  // A step that changes the residual by less than this factor is extended.
  static constexpr double kLittle = 0.9;
  // If the residual falls by less than the factor kSlow although all slips are below kLittleSlip of
  // the allowed ones, particles are jammed, and Iterate::close_gaps() is tried.
  static constexpr double kSlow = 0.1, kLittleSlip = 0.01;
  // Contacts that slip or are open, but for rounding errors, do not limit extended steps.
  static constexpr double kInside = 1e-9;
};

}  // namespace

// Stage; when it is entered; what begins it; its step; when it is left; what ends it.
template <int D>
const std::array<StageRow<ConvexLadder<D>>, 5> ConvexLadder<D>::kTable{{
    // Once, if the problem does not keep the loads that bound its friction and is not rough.
    // Further such solutions, each with the loads of the one before, do not converge
    // (bench/README.md).
    {Stage::kFirstLoads, &ConvexLadder::needs_loads, nullptr, &ConvexLadder::find_loads, nullptr,
     nullptr},
    // Once, with ConstraintStart::kAcceleratedSweeps.
    {Stage::kAcceleratedSweeps, &ConvexLadder::may_accelerate, nullptr, &ConvexLadder::accelerate,
     nullptr, nullptr},
    // Once, for at most 20 iterations. Proximal steps from a near solution change its slips little.
    // Interior points would have errors in the slips, which bodies that turn pass on to gaps, so
    // that corrections for finite turns would not vanish.
    {Stage::kStepsNearGuess, &ConvexLadder::is_near, &ConvexLadder::begin_steps_near_guess,
     &ConvexLadder::take_step, &ConvexLadder::are_steps_over, nullptr},
    // Once. Sweeps seldom solve a problem, and the time of interior points, 10 to 25
    // factorisations, does not depend on their start. If rows are redundant, impulses found by
    // sweeps would depend on the order of the rows.
    {Stage::kInteriorPoints, &ConvexLadder::has_no_interior_solution, nullptr,
     &ConvexLadder::find_interior_solution, nullptr, nullptr},
    // Until the problem is solved, unless it is rough: few steps, because the interior points have
    // found which contacts stick.
    {Stage::kStepsFromInside, &ConvexLadder::shall_be_accurate, &ConvexLadder::begin_steps,
     &ConvexLadder::take_step, &ConvexLadder::are_steps_over, nullptr},
}};

template <int D>
void ConvexLadder<D>::find_loads(Stage stage) {
  if (at_.can_accelerate())
    at_.accelerate(ConvexTuning::kSweeps, stage);
  else
    take_interior_points(stage);
  for (auto& block : at_.problem.blocks)
    if (block.friction_bound == FrictionBound::kGiven)
      block.given_load = load_of_solids(at_.problem.impulses[block.row], block.capacity);
  at_.forget_best();
  needs_loads_ = false;
}

template <int D>
void ConvexLadder<D>::accelerate(Stage stage) {
  has_accelerated_ = true;
  at_.accelerate(ConvexTuning::kSweeps, stage);
  if (at_.residual <= 1) return;
  bind_optional(at_.problem);
  at_.forget_best();
}

template <int D>
void ConvexLadder<D>::begin_steps_near_guess() {
  begin_steps();
  is_near_ = false;
  last_ = std::min(at_.most, at_.iterations() + ConvexTuning::kMostNearGuess);
}

template <int D>
void ConvexLadder<D>::find_interior_solution(Stage stage) {
  take_interior_points(stage);
  has_interior_solution_ = true;
}

template <int D>
void ConvexLadder<D>::take_interior_points(Stage stage) {
  using Tuning = ConvexTuning;
  const auto& problem = at_.problem;
  if (!interior_) interior_.emplace(problem, at_.w, at_.matrix());
  const int most = std::clamp(at_.most - at_.iterations(), 1, Tuning::kMostInteriorPoints);
  const double accuracy = problem.is_rough  ? Tuning::kRough
                          : problem.is_near ? Tuning::kExact
                                            : Tuning::kAccurate;
  at_.count(stage, interior_->solve(accuracy, most));
  at_.move_to(interior_->impulses());
}

template <int D>
void ConvexLadder<D>::begin_steps() {
  is_rising_ = true;
  last_ = at_.most;
  at_.set_epsilon(ConvexTuning::kFirstEpsilon);
}

template <int D>
void ConvexLadder<D>::take_step(Stage stage) {
  improve(stage);
  at_.note_progress();
}

template <int D>
void ConvexLadder<D>::improve(Stage stage) {
  using Tuning = ConvexTuning;
  const auto center = at_.problem.impulses;
  const double before = at_.residual;
  const auto taken = at_.compute_step(center, Tuning::kMostOfStep, last_, stage);
  at_.move_to(at_.proximal().impulses());
  const bool is_solved = taken && std::isfinite(at_.residual);
  const bool is_largest = at_.epsilon >= Tuning::kLargestEpsilon,
             is_least = at_.epsilon <= Tuning::kLeastEpsilon;
  // The projection of FrictionBound::kCone changes normal and tangential impulses together, and
  // forbids close_gaps().
  if (is_solved && !at_.has_cones && at_.residual > 1 && at_.residual > Tuning::kSlow * before &&
      at_.largest_slip() <= Tuning::kLittleSlip && at_.close_gaps(center, last_))
    return;
  if (!is_solved) {
    at_.move_to(center);
    if (is_largest) at_.sweep();
  } else if (at_.residual > 1 && at_.residual > Tuning::kLittle * before &&
             at_.residual < before / Tuning::kLittle) {
    extend_change(center);
  }
  is_rising_ = !is_largest && (is_rising_ || is_least || !is_solved);
  at_.set_epsilon(is_rising_ ? std::min(Tuning::kLargestEpsilon, Tuning::kFactor * at_.epsilon)
                             : std::max(Tuning::kLeastEpsilon, at_.epsilon / Tuning::kFactor));
}

template <int D>
void ConvexLadder<D>::extend_change(const std::vector<double>& center) {
  auto& problem = at_.problem;
  const auto p = problem.impulses;
  double length = std::numeric_limits<double>::infinity();
  for (const auto& block : problem.blocks) {
    if (!block.is_contact) continue;
    const auto bounded_by = [&](ConePoint here, ConePoint change) {
      if (determinant(here) > ConvexTuning::kInside * here[0] * here[0])
        length = std::min(length, length_to_boundary({here, here[0] - beside_axis(here)}, change));
    };
    ConePoint here{p[block.row] - block.lowest}, change{p[block.row] - center[block.row]};
    if (!block.is_in_cone()) bounded_by(here, change);
    if (block.rows == 1) continue;
    for (std::size_t k = 1; k < block.rows; ++k) {
      here[k] = p[block.row + k] / block.friction;
      change[k] = (p[block.row + k] - center[block.row + k]) / block.friction;
    }
    if (!block.is_in_cone()) {
      here[0] = block.given_load;
      change[0] = 0;
    }
    bounded_by(here, change);
  }
  if (!std::isfinite(length)) return;
  for (std::size_t r = 0; r < p.size(); ++r) problem.impulses[r] += length * (p[r] - center[r]);
  at_.update();
}

template class ConvexLadder<2>;
template class ConvexLadder<3>;

}  // namespace viscontact::contact_solver
