// Sweeps and proximal steps (constraint_solver.hpp). The constants change how
// long a solution takes, and the results within the tolerances.
#include "viscontact/particles/constraints/constraint_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "viscontact/particles/constraints/contact_sweeps.hpp"
#include "viscontact/particles/constraints/proximal_step.hpp"

namespace viscontact::particles {
namespace {

/// The mobilities of the rows, equal for the tangential rows of a contact, on which the projection
/// acts together.
template <int D>
std::vector<double> scales_of_rows(const ConstraintProblem<D>& problem) {
  auto w = row_mobilities(problem);
  for (const auto& block : problem.blocks)
    if (block.is_contact)
      for (std::size_t k = 2; k < block.rows; ++k)
        w[block.row + 1] = w[block.row + k] = std::max(w[block.row + 1], w[block.row + k]);
  return w;
}

template <int D>
class Iteration {
 public:
  explicit Iteration(ConstraintProblem<D>& problem)
      : problem_(problem), w_(scales_of_rows(problem)), sweeps_(problem) {
    for (const auto& block : problem.blocks)
      if (block.is_contact)
        problem.impulses[block.row] = std::max(problem.impulses[block.row], block.lowest);
    best_.result.residual = std::numeric_limits<double>::infinity();
    update();
  }

  ConstraintSolution<D> solve(int max_iterations) {
    sweep_while_it_gains(max_iterations);
    if (residual_ <= 1 || best_.result.iterations >= max_iterations) return finish();
    proximal_.emplace(problem_, w_);
    proximal_->set_epsilon(epsilon_);
    while (residual_ > 1 && best_.result.iterations < max_iterations)
      problem_.lifts_sliding ? take_convex_step(max_iterations)
                             : take_proximal_step(max_iterations);
    return finish();
  }

 private:
  void sweep() {
    constexpr int kSweeps = 30;
    sweeps_.sweep(kSweeps, w_);
    best_.result.iterations += kSweeps;
    update();
  }

  /// A sweep costs a small part of a factorisation, so that sweeps go on as long as they gain.
  void sweep_while_it_gains(int max_iterations) {
    constexpr double kGain = 0.7;
    double before = std::numeric_limits<double>::infinity();
    while (residual_ > 1 && residual_ < kGain * before &&
           best_.result.iterations < max_iterations) {
      before = residual_;
      sweep();
    }
  }

  /// Takes a proximal step, or goes back and makes the next one easier to solve. Between jammed
  /// particles that stick, impulses that balance each other must grow until a contact slips or
  /// opens. Small epsilons go there fast, but Newton's method then fails more often, so that
  /// epsilon follows what it achieves. Where even the easiest step fails, sweeps go on.
  void take_proximal_step(int max_iterations) {
    constexpr int kMostIterations = 50, kFewIterations = 4;
    constexpr double kLeastEpsilon = 1e-12, kLargestEpsilon = 1, kFactor = 3, kMuchWorse = 5;
    const auto center = problem_.impulses;
    const double before = residual_;
    const int most = std::clamp(max_iterations - best_.result.iterations, 1, kMostIterations);
    const int taken = proximal_->solve(center, motions_, most);
    best_.result.iterations += taken;
    problem_.impulses = proximal_->impulses();
    update();
    if (proximal_->failed() || taken == most || !(residual_ <= kMuchWorse * before)) {
      problem_.impulses = center;
      update();
      if (epsilon_ == kLargestEpsilon) sweep();
      epsilon_ = std::min(kLargestEpsilon, kFactor * epsilon_);
      proximal_->set_epsilon(epsilon_);
    } else if (taken <= kFewIterations && epsilon_ > kLeastEpsilon) {
      epsilon_ /= kFactor;
      proximal_->set_epsilon(epsilon_);
    }
  }

  /// Takes a proximal step for the convex relaxation (5.9). Each step leads nearer to the solution
  /// but for rounding errors, which are those of the gaps divided by epsilon. Therefore epsilon
  /// falls until the impulses between jammed particles have grown as far as they must, then rises
  /// until the errors are gone, and falls again if that was not far enough.
  void take_convex_step(int max_iterations) {
    constexpr int kMostIterations = 50;
    constexpr double kLeastEpsilon = 1e-8, kFactor = 10;
    const auto center = problem_.impulses;
    const int most = std::clamp(max_iterations - best_.result.iterations, 1, kMostIterations);
    const int taken = proximal_->solve(center, motions_, most);
    best_.result.iterations += taken;
    problem_.impulses = proximal_->impulses();
    update();
    const bool is_solved = !proximal_->failed() && taken < most;
    const bool is_largest = epsilon_ >= kFirstEpsilon, is_least = epsilon_ <= kLeastEpsilon;
    if (!is_solved) {
      problem_.impulses = center;
      update();
      if (is_largest) sweep();
    }
    is_rising_ = !is_largest && (is_rising_ || is_least || !is_solved);
    epsilon_ = is_rising_ ? std::min(kFirstEpsilon, kFactor * epsilon_)
                          : std::max(kLeastEpsilon, epsilon_ / kFactor);
    proximal_->set_epsilon(epsilon_);
  }

  /// Computes motions and residuals, and keeps the solution if it is the best so far.
  void update() {
    motions_ = motions<D>(problem_, problem_.impulses);
    residuals_.resize(problem_.blocks.size());
    residual_ = 0;
    for (std::size_t b = 0; b < problem_.blocks.size(); ++b) {
      const auto& block = problem_.blocks[b];
      std::array<double, kMostRows> v{};
      for (std::size_t k = 0; k < block.rows; ++k) {
        const auto& row = problem_.rows[block.row + k];
        v[k] = row.offset + product<D>(row, motions_);
      }
      const double* p = &problem_.impulses[block.row];
      residuals_[b] = residual_of(block, problem_.lifts_sliding, v.data(), p, &w_[block.row]);
      const double share = residuals_[b].share(block);
      residual_ = share <= residual_ ? residual_ : share;  // keeps what is not a number
    }
    if (!(residual_ < best_.result.residual)) return;
    best_.result.residual = residual_;
    best_.motions = motions_;
    best_.residuals = residuals_;
    best_impulses_ = problem_.impulses;
  }

  ConstraintSolution<D> finish() {
    problem_.impulses = best_impulses_;
    return std::move(best_);
  }

  static constexpr double kFirstEpsilon = 0.1;

  ConstraintProblem<D>& problem_;
  std::vector<double> w_;
  ContactSweeps<D> sweeps_;
  std::optional<ProximalStep<D>> proximal_;
  std::vector<double> best_impulses_;
  std::vector<Motion<D>> motions_;
  std::vector<BlockResidual> residuals_;
  ConstraintSolution<D> best_;
  bool is_rising_ = false;
  double residual_ = 0, epsilon_ = kFirstEpsilon;
};

}  // namespace

template <int D>
ConstraintSolution<D> solve_constraints(ConstraintProblem<D>& problem, int max_iterations) {
  return Iteration<D>(problem).solve(max_iterations);
}

template ConstraintSolution<2> solve_constraints<2>(ConstraintProblem<2>&, int);
template ConstraintSolution<3> solve_constraints<3>(ConstraintProblem<3>&, int);

}  // namespace viscontact::particles
