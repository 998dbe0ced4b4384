// Residuals of an iterate, and the steps that several strategies share.
#include "viscontact/contact_solver/iterate.hpp"

#include <algorithm>
#include <utility>

namespace viscontact::contact_solver {
namespace {

/// The row_mobilities() [T/M], with equally stiff gaps if `start` is kLeastImpulses.
template <int D>
std::vector<double> scales_of_rows(const ConstraintProblem<D>& problem, ConstraintStart start) {
  auto w = row_mobilities(problem);
  if (start != ConstraintStart::kLeastImpulses) return w;
  double largest = 0;
  for (const auto& block : problem.blocks) largest = std::max(largest, w[block.row]);
  for (const auto& block : problem.blocks)
    if (block.is_contact) w[block.row] = largest;
  return w;
}

}  // namespace

template <int D>
Iterate<D>::Iterate(ConstraintProblem<D>& of, int max_iterations, ConstraintStart start)
    : problem(of), most(max_iterations), w(scales_of_rows(of, start)) {
  if (start == ConstraintStart::kAcceleratedSweeps)
    accelerated_ = AcceleratedSweeps<D>::of(problem, w);
  if (!accelerated_) bind_optional(problem);
  for (const auto& block : problem.blocks) {
    if (!block.is_contact) continue;
    problem.impulses[block.row] = std::max(problem.impulses[block.row], block.lowest);
    has_given_loads |= block.friction_bound == FrictionBound::kGiven;
    has_cones |= block.is_in_cone();
  }
  best_.result.residual = std::numeric_limits<double>::infinity();
  update();
}

template <int D>
void Iterate<D>::count(Stage stage, int iterations) {
  best_.result.iterations += iterations;
  best_.result.stages[stage] += iterations;
}

template <int D>
void Iterate<D>::update() {
  motions = contact_solver::motions<D>(problem, problem.impulses);
  values.resize(problem.rows.size());
  residuals.resize(problem.blocks.size());
  residual = 0;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const auto& block = problem.blocks[b];
    for (std::size_t r = block.row; r < block.row + block.rows; ++r)
      values[r] = problem.rows[r].offset + problem.product(r, motions);
    residuals[b] =
        residual_of(block, &values[block.row], &problem.impulses[block.row], &w[block.row]);
    residual = largest_or_nan(residual, residuals[b].share(block));
    if (block.is_contact && block.rows > 1 && problem.impulses[block.row] > most_impulse)
      residual = std::numeric_limits<double>::infinity();
  }
  if (!best_.motions.empty() && !(residual < best_.result.residual)) return;
  if (residual < best_.result.residual) best_.result.residual = residual;
  best_.motions = motions;
  best_.residuals = residuals;
  best_impulses_ = problem.impulses;
}

template <int D>
void Iterate<D>::move_to(const std::vector<double>& impulses) {
  problem.impulses = impulses;
  update();
}

template <int D>
void Iterate<D>::return_to_best() {
  if (residual > best_.result.residual) move_to(std::vector(best_impulses_));
}

template <int D>
void Iterate<D>::forget_best() {
  best_.result.residual = std::numeric_limits<double>::infinity();
  update();
}

template <int D>
ConstraintSolution<D> Iterate<D>::finish() {
  problem.impulses = best_impulses_;
  return std::move(best_);
}

template <int D>
void Iterate<D>::note_progress() {
  if (!(best_.result.residual < IterateTuning::kGain * gained_residual_)) return;
  gained_residual_ = best_.result.residual;
  gained_at_ = iterations();
}

template <int D>
bool Iterate<D>::is_stagnant() const {
  return iterations() - gained_at_ >
         (has_cones ? IterateTuning::kPatienceOfCones : IterateTuning::kPatience);
}

template <int D>
void Iterate<D>::accelerate(SweepPlan plan, Stage stage) {
  plan.most = std::clamp(most - iterations(), 1, plan.most);
  const int taken = accelerated_->sweep(plan);
  count(stage, taken);
  excuse(taken);
  update();
}

template <int D>
void Iterate<D>::sweep() {
  if (!sweeps_) sweeps_.emplace(problem);
  sweeps_->sweep(IterateTuning::kSweeps, w);
  count(Stage::kSweeps, IterateTuning::kSweeps);
  update();
}

template <int D>
std::optional<int> Iterate<D>::compute_step(const std::vector<double>& center, int most_of_step,
                                            int last, Stage stage) {
  const int most_taken = std::clamp(last - iterations(), 1, most_of_step);
  const int taken = proximal().solve(center, motions, most_taken);
  count(Stage::kBranchPath, proximal().path_iterations());
  count(stage, taken - proximal().path_iterations());
  if (proximal().failed() || taken >= most_taken) return {};
  return taken;
}

template <int D>
void Iterate<D>::set_epsilon(double of_step) {
  epsilon = of_step;
  proximal().set_epsilon(of_step);
}

template <int D>
double Iterate<D>::largest_slip() const {
  double largest = 0;
  for (std::size_t b = 0; b < residuals.size(); ++b)
    largest = std::max(largest, residuals[b].tangential / problem.blocks[b].allowed_slip);
  return largest;
}

template <int D>
bool Iterate<D>::close_gaps(std::vector<double> center, int last) {
  using Tuning = IterateTuning;
  const auto before = problem.impulses;
  for (const auto& block : problem.blocks)
    for (std::size_t r = block.row + 1; block.is_contact && r < block.row + block.rows; ++r)
      center[r] += values[r] / w[r] * (1 / Tuning::kEpsilonOfSlips - 1 / epsilon);
  double of_gaps = epsilon;
  for (int n = 0; n < Tuning::kMostSteps && residual > 1; ++n) {
    for (const auto& block : problem.blocks)
      for (std::size_t k = 0; k < (block.is_contact ? 1 : block.rows); ++k)
        center[block.row + k] = problem.impulses[block.row + k];
    of_gaps = std::min(of_gaps, std::max(Tuning::kLeastEpsilon, of_gaps / Tuning::kFactor));
    proximal().set_epsilon(of_gaps, Tuning::kEpsilonOfSlips);
    if (!compute_step(center, Tuning::kMostOfStep, last, Stage::kClosedGaps)) break;
    move_to(proximal().impulses());
    if (!(largest_slip() <= 1)) break;
  }
  proximal().set_epsilon(epsilon);
  if (residual <= 1) return true;
  move_to(before);
  return false;
}

template <int D>
UnitMatrix<D>& Iterate<D>::matrix() {
  if (!matrix_) matrix_.emplace(problem, problem.is_convex);
  return *matrix_;
}

template <int D>
ProximalStep<D>& Iterate<D>::proximal() {
  if (!proximal_) proximal_.emplace(problem, w, matrix());
  return *proximal_;
}

template class Iterate<2>;
template class Iterate<3>;

}  // namespace viscontact::contact_solver
