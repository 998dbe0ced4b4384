// The table of strategies for Coulomb's law, (5.7) and (5.8), docs/physics.md, and their steps.
#include "viscontact/contact_solver/coulomb_ladder.hpp"

#include <algorithm>
#include <cmath>

#include "viscontact/contact_solver/methods/coulomb_path.hpp"

namespace viscontact::contact_solver {
namespace {

struct CoulombTuning {
  // Coulomb's law is not the minimum of a convex function, and in large packings sweeps of one plan
  // may oscillate where those of another do not. Most packings take the first plan only.
  static constexpr std::array<SweepPlan, 3> kPlans{{
      {.most = 500, .longest = 40, .is_adaptive = true},
      {.most = 800, .longest = 40, .is_adaptive = true, .is_shuffled = true},
      {.most = 800,
       .longest = 800,
       .map = SweepPlan::Map::kProximal,
       .epsilon = 0.01,
       .longest_step = 0.82,
       .is_shuffled = true},
  }};
  // In problems of more blocks the plans are repeated, and the methods below are not tried, whose
  // factorisations would take too long: 50 ms for 2000 spheres, but 1 ms for 1000 discs. With plans
  // that are run once or four times, 2000 spheres with mu_s = 0.5 take 0.9 or 1.5 times as long,
  // because unsolved steps are divided; run once, they leave more steps with mu_s = 1 unsolved.
  static constexpr std::size_t kRepeated = 2;
  template <int D>
  static constexpr std::size_t kMostForFactors = D == 2 ? 20000 : 500;
  // Sweeps end if they do not reduce the residual to this part of itself. Slow progress is enough,
  // because a sweep takes a small part of the time of a factorisation.
  static constexpr double kGainOfSweeps = 0.7;
  // Epsilon of the first step; bench/README.md lists the results of other values.
  static constexpr double kFirstEpsilon = 0.1;
  // Epsilon falls by kLargeFactor after at most kFewIterations, by kFactor after another success,
  // and grows by kFactor after a failure.
  static constexpr double kLeastEpsilon = 1e-12, kLargestEpsilon = 1, kFactor = 3,
                          kLargeFactor = 10;
  static constexpr int kMostOfStep = 200, kFewIterations = 2;
  // Most problems are solved in fewer than kManySteps steps. Iterate::close_gaps() is tried then,
  // and again when the number of steps has grown by one part in kPartOfSteps.
  static constexpr int kManySteps = 15, kPartOfSteps = 4;
  // Iterations before a path, times contacts, and its bounds.
  static constexpr double kBeforePath = 1e5;
  static constexpr int kLeastBeforePath = 50, kMostBeforePath = 2000;
  // Iterations from the end of a path in which the residual must be halved.
  static constexpr int kAfterPath = 200;
  // Accuracies of the end of a path relative to the violations without impulses, and the one
  // beyond which the end is no guess. Most of the factorisations are made at errors of 1e-3 to
  // 1e-5, and about ten at errors from 1e-5 to 1e-7.
  static constexpr double kRough = 1e-4, kAccurate = 1e-7, kFar = 1e-3;
  // Points of a path. A long path is left for another one, which seldom is as long.
  static constexpr int kLongPath = 400, kLongLastPath = 2000;
  // Each point of a path takes a factorisation and three solutions with factors.
  static constexpr int kOfPoint = 4;
};

}  // namespace

// Stage; when it is entered; what begins it; its step; when it is left; what ends it.
template <int D>
const std::array<StageRow<CoulombLadder<D>>, 5> CoulombLadder<D>::kTable{{
    // With ConstraintStart::kAcceleratedSweeps.
    {Stage::kAcceleratedSweeps, &CoulombLadder::may_accelerate, nullptr, &CoulombLadder::accelerate,
     nullptr, nullptr},
    // At first, as long as 30 sweeps reduce the residual to 0.7 of itself.
    {Stage::kSweeps, &CoulombLadder::may_sweep, nullptr, &CoulombLadder::sweep,
     &CoulombLadder::do_sweeps_gain_little, nullptr},
    // As long as 200 iterations halve the residual; most solutions take 0 to 20. Otherwise the
    // solution goes on where it was before the path.
    {Stage::kStepsFromPath, &CoulombLadder::is_at_end_of_path, nullptr,
     &CoulombLadder::take_step_from_path, &CoulombLadder::are_steps_from_path_over,
     &CoulombLadder::leave_end_of_path},
    // At most three times, when steps have taken long. A path takes 40 to 80 factorisations in most
    // packings of 300 discs, and 100 to 500 with 1000 discs and films. Without paths 4 to 13 of 200
    // steps of bench/box2d.cpp did not converge.
    {Stage::kCoulombPath, &CoulombLadder::is_path_due, nullptr, &CoulombLadder::follow_path,
     nullptr, nullptr},
    // Otherwise, for 1e5 iterations over the number of contacts, 50 to 2000: such steps solve easy
    // problems in less time than a path takes, and with loads that are nearer to the guess. Within
    // such a step, Stage::kBranchPath follows failures of Newton's method; without it packings of
    // up to 300 discs take 1.1 to 1.45 times as long (bench/README.md).
    {Stage::kProximalSteps, &CoulombLadder::is_unsolved, &CoulombLadder::begin_proximal_steps,
     &CoulombLadder::take_proximal_step, &CoulombLadder::are_proximal_steps_over, nullptr},
}};

template <int D>
bool CoulombLadder<D>::is_too_large_for_factors() const {
  return at_.problem.blocks.size() > CoulombTuning::kMostForFactors<D>;
}

template <int D>
bool CoulombLadder<D>::is_done() const {
  return at_.is_at_end() ||
         (at_.can_accelerate() && !may_accelerate() && is_too_large_for_factors());
}

template <int D>
bool CoulombLadder<D>::may_accelerate() const {
  const std::size_t repeated = is_too_large_for_factors() ? CoulombTuning::kRepeated : 1;
  return at_.can_accelerate() && runs_ < repeated * CoulombTuning::kPlans.size();
}

template <int D>
void CoulombLadder<D>::accelerate(Stage stage) {
  at_.accelerate(CoulombTuning::kPlans[runs_++ % CoulombTuning::kPlans.size()], stage);
  if (!may_accelerate()) at_.return_to_best();
}

template <int D>
bool CoulombLadder<D>::may_sweep() const {
  return start_ != ConstraintStart::kLeastImpulses && at_.iterations() == 0 &&
         !do_sweeps_gain_little();
}

template <int D>
void CoulombLadder<D>::sweep(Stage) {
  before_sweeps_ = at_.residual;
  at_.sweep();
}

template <int D>
bool CoulombLadder<D>::do_sweeps_gain_little() const {
  return !(at_.residual > 1 && at_.residual < CoulombTuning::kGainOfSweeps * before_sweeps_);
}

template <int D>
void CoulombLadder<D>::begin_proximal_steps() {
  if (due_at_ < std::numeric_limits<int>::max()) return;
  at_.set_epsilon(CoulombTuning::kFirstEpsilon);
  // With kLeastImpulses paths are the last resort, because their ends do not depend on the guess.
  const double contacts = static_cast<double>(at_.problem.blocks.size());
  due_at_ = at_.iterations() +
            (start_ == ConstraintStart::kLeastImpulses
                 ? CoulombTuning::kMostBeforePath
                 : static_cast<int>(std::clamp<double>(CoulombTuning::kBeforePath / contacts,
                                                       CoulombTuning::kLeastBeforePath,
                                                       CoulombTuning::kMostBeforePath)));
}

template <int D>
void CoulombLadder<D>::take_proximal_step(Stage stage) {
  improve(stage);
  at_.note_progress();
}

template <int D>
void CoulombLadder<D>::improve(Stage stage) {
  using Tuning = CoulombTuning;
  const auto center = at_.problem.impulses;
  const auto taken = at_.compute_step(center, Tuning::kMostOfStep, at_.most, stage);
  if (taken) at_.move_to(at_.proximal().impulses());
  if (!taken || !std::isfinite(at_.residual)) {
    at_.move_to(center);
    if (at_.epsilon == Tuning::kLargestEpsilon) at_.sweep();
    at_.set_epsilon(std::min(Tuning::kLargestEpsilon, Tuning::kFactor * at_.epsilon));
    return;
  }
  if (at_.residual > 1 && ++steps_ >= std::max(Tuning::kManySteps, next_try_) &&
      at_.largest_slip() <= 1) {
    if (at_.close_gaps(center, at_.most)) return;
    next_try_ = steps_ + steps_ / Tuning::kPartOfSteps;
  }
  if (at_.proximal().followed_path()) return;
  const double factor = *taken <= Tuning::kFewIterations ? Tuning::kLargeFactor : Tuning::kFactor;
  at_.set_epsilon(std::max(Tuning::kLeastEpsilon, at_.epsilon / factor));
}

template <int D>
bool CoulombLadder<D>::is_path_due() const {
  return is_unsolved() && at_.iterations() >= due_at_ && paths_ < CoulombPath<D>::kPaths;
}

template <int D>
void CoulombLadder<D>::follow_path(Stage stage) {
  before_path_ = at_.problem.impulses;
  epsilon_before_path_ = at_.epsilon;
  if (const auto end = end_of_path(paths_++, stage)) {
    // Where particles are jammed, impulses that balance each other may have any size. A solution
    // with an impulse larger than sum_of_impulses_at_work() has no meaning.
    is_at_end_of_path_ = true;
    path_ended_at_ = at_.iterations();
    at_.most_impulse = sum_of_impulses_at_work();
    begin_at(*end, CoulombTuning::kFirstEpsilon);
  }
  at_.note_progress();
}

template <int D>
std::optional<std::vector<double>> CoulombLadder<D>::end_of_path(int number, Stage stage) {
  using Tuning = CoulombTuning;
  const int longest =
      number + 1 < CoulombPath<D>::kPaths ? Tuning::kLongPath : Tuning::kLongLastPath;
  const int left = at_.most - at_.iterations();
  CoulombPath<D> path(at_.problem, at_.w, at_.matrix());
  const int taken = Tuning::kOfPoint *
                    path.follow(number, at_.problem.is_rough ? Tuning::kRough : Tuning::kAccurate,
                                std::clamp(left / Tuning::kOfPoint, 1, longest));
  at_.count(stage, taken);
  at_.excuse(taken);
  at_.set_epsilon(at_.epsilon);  // because the path has overwritten the matrix
  if (!(path.reached() <= Tuning::kFar)) return {};
  return path.impulses();
}

template <int D>
void CoulombLadder<D>::begin_at(const std::vector<double>& impulses, double epsilon) {
  at_.move_to(impulses);
  at_.set_epsilon(epsilon);
  halved_ = at_.residual;
  due_at_ = at_.iterations() + CoulombTuning::kAfterPath;
}

template <int D>
void CoulombLadder<D>::take_step_from_path(Stage stage) {
  take_proximal_step(stage);
  if (!(at_.residual < halved_ / 2)) return;
  halved_ = at_.residual;
  due_at_ = at_.iterations() + CoulombTuning::kAfterPath;
}

template <int D>
bool CoulombLadder<D>::are_steps_from_path_over() const {
  return at_.iterations() >= due_at_;
}

template <int D>
void CoulombLadder<D>::leave_end_of_path() {
  is_at_end_of_path_ = false;
  at_.excuse(at_.iterations() - path_ended_at_);
  at_.most_impulse = std::numeric_limits<double>::infinity();
  begin_at(before_path_, epsilon_before_path_);
}

template <int D>
double CoulombLadder<D>::sum_of_impulses_at_work() const {
  const auto& problem = at_.problem;
  double sum = 0;
  std::vector<Motion<D>> free;
  for (const auto& unit : problem.units) {
    free.push_back(unit.free);
    const auto impulse = unit.impulse_of(unit.free);
    double square = 0;
    for (std::size_t k = 0; k < D; ++k) square += impulse[k] * impulse[k];
    sum += std::sqrt(square);
  }
  for (const auto& block : problem.blocks) {
    // Springs and stops may have rows of angles, whose impulses are moments.
    if (block.is_contact ? block.rows == 1 : block.compliance > 0) continue;
    if (block.is_contact) sum += std::abs(block.lowest);
    for (std::size_t r = block.row; r < block.row + (block.is_contact ? 1 : block.rows); ++r) {
      const double value = problem.rows[r].offset + problem.product(r, free);
      if (!block.is_contact || value < 0) sum += std::abs(value) / at_.w[r];
    }
  }
  return sum;
}

template class CoulombLadder<2>;
template class CoulombLadder<3>;

}  // namespace viscontact::contact_solver
