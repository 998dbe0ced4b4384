// Sweeps, proximal steps and their acceleration (constraint_solver.hpp). The constants change how
// long a solution takes, and the results within the tolerances.
#include "viscontact/particles/constraints/constraint_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "viscontact/particles/constraints/anderson.hpp"
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
      : problem_(problem),
        w_(scales_of_rows(problem)),
        sweeps_(problem),
        lifts_(problem.blocks.size(), 0.0) {
    for (const auto& block : problem.blocks)
      if (block.is_contact)
        problem.impulses[block.row] = std::max(problem.impulses[block.row], block.lowest);
    best_.result.residual = std::numeric_limits<double>::infinity();
    update();
  }

  ConstraintSolution<D> solve(int max_iterations) {
    int& iterations = best_.result.iterations;
    if (residual_ <= 1) return finish();
    constexpr int kSweeps = 30;
    sweep(kSweeps);
    if (residual_ <= 1 || iterations >= max_iterations) return finish();
    proximal_.emplace(problem_, w_);
    proximal_->set_epsilon(epsilon_);
    while (residual_ > 1 && iterations < max_iterations) {
      const auto center = problem_.impulses;
      const double before = residual_;
      iterations += proximal_->solve(center, motions_, lifts_, true,
                                     std::max(1, max_iterations - iterations));
      if (proximal_->failed())
        iterations += proximal_->solve(center, motions_, lifts_, false,
                                       std::max(1, max_iterations - iterations));
      problem_.impulses = proximal_->impulses();
      update();
      constexpr double kMuchWorse = 1e9;
      if (proximal_->failed() || !(residual_ <= kMuchWorse * best_.result.residual)) {
        if (plain_.empty())
          retreat(kSweeps);
        else
          retract();
      } else {
        advance(center, before);
      }
    }
    return finish();
  }

 private:
  void sweep(int count) {
    sweeps_.sweep(count, w_);
    best_.result.iterations += count;
    update();
  }

  /// Computes motions and residuals, and keeps the solution if it is the best so far.
  void update() {
    motions_ = motions<D>(problem_, problem_.impulses);
    residuals_.resize(problem_.blocks.size());
    residual_ = 0;
    for (std::size_t b = 0; b < problem_.blocks.size(); ++b) {
      const auto& block = problem_.blocks[b];
      std::array<double, kMostRows> v{};
      double slip = 0;
      for (std::size_t k = 0; k < block.rows; ++k) {
        const auto& row = problem_.rows[block.row + k];
        v[k] = row.offset + product<D>(row, motions_);
        if (k > 0) slip += v[k] * v[k];
      }
      const double* p = &problem_.impulses[block.row];
      residuals_[b] = residual_of(block, problem_.lifts_sliding, v.data(), p, &w_[block.row]);
      const double share = residuals_[b].share(block);
      residual_ = share <= residual_ ? residual_ : share;  // keeps what is not a number
      if (problem_.lifts_sliding && block.is_contact)
        lifts_[b] = block.bound(p[0]) > 0 ? block.friction * std::sqrt(slip) : 0;
    }
    if (!(residual_ < best_.result.residual)) return;
    best_.result.residual = residual_;
    best_.motions = motions_;
    best_.residuals = residuals_;
    best_impulses_ = problem_.impulses;
  }

  /// Goes on from where the last extrapolation began.
  void retract() {
    problem_.impulses = std::move(plain_);
    plain_.clear();
    acceleration_.forget();
    update();
  }

  /// Goes on by sweeps from the best solution, with steps that are easier to solve.
  void retreat(int sweeps) {
    problem_.impulses = best_impulses_;
    sweep(sweeps);
    acceleration_.forget();
    steps_ = 0;
    at_reduction_ = residual_;
  }

  /// Goes on after a step from `center`, whose residual was `before`.
  void advance(const std::vector<double>& center, double before) {
    // An epsilon that gains less than a half in some steps is too large, because the constraints
    // nearly contradict each other or form a long chain.
    constexpr int kPatience = 8;
    constexpr double kWorse = 3, kLeastEpsilon = 1e-9;
    plain_.clear();
    if (residual_ <= 1) return;
    if (residual_ > kWorse * before) acceleration_.forget();
    if (++steps_ >= kPatience) {
      steps_ = 0;
      const bool gained = residual_ < at_reduction_ / 2;
      at_reduction_ = residual_;
      if (!gained && epsilon_ > kLeastEpsilon) {
        epsilon_ /= 10;
        proximal_->set_epsilon(epsilon_);
        acceleration_.forget();
        return;
      }
    }
    plain_ = problem_.impulses;
    acceleration_.improve(center, problem_.impulses, w_);
    if (acceleration_.size() == 0) plain_.clear();
  }

  ConstraintSolution<D> finish() {
    problem_.impulses = best_impulses_;
    return std::move(best_);
  }

  static constexpr double kFirstEpsilon = 0.1;
  static constexpr std::size_t kMemory = 8;

  ConstraintProblem<D>& problem_;
  std::vector<double> w_;
  ContactSweeps<D> sweeps_;
  std::optional<ProximalStep<D>> proximal_;
  AndersonAcceleration acceleration_{kMemory};
  std::vector<double> lifts_, best_impulses_;
  std::vector<double> plain_;  // impulses before the last extrapolation; empty if there was none
  std::vector<Motion<D>> motions_;
  std::vector<BlockResidual> residuals_;
  ConstraintSolution<D> best_;
  double residual_ = 0, epsilon_ = kFirstEpsilon;
  double at_reduction_ = std::numeric_limits<double>::infinity();
  int steps_ = 0;
};

}  // namespace

template <int D>
ConstraintSolution<D> solve_constraints(ConstraintProblem<D>& problem, int max_iterations) {
  return Iteration<D>(problem).solve(max_iterations);
}

template ConstraintSolution<2> solve_constraints<2>(ConstraintProblem<2>&, int);
template ConstraintSolution<3> solve_constraints<3>(ConstraintProblem<3>&, int);

}  // namespace viscontact::particles
