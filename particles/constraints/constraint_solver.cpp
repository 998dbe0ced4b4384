// Sweeps and proximal steps (constraint_solver.hpp). Units are those of the case. What is not
// solved is reported, not thrown. The constants change how long a solution takes, and the results
// within the tolerances.
#include "viscontact/particles/constraints/constraint_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "viscontact/particles/constraints/cone.hpp"
#include "viscontact/particles/constraints/contact_sweeps.hpp"
#include "viscontact/particles/constraints/interior_points.hpp"
#include "viscontact/particles/constraints/proximal_step.hpp"

namespace viscontact::particles {
namespace {

/// The mobilities of the rows, equal for the tangential rows of a contact, on which the projection
/// acts together. With kLeastImpulses all gaps have the largest of theirs, so that contacts share
/// an impulse as if all were equally stiff.
template <int D>
std::vector<double> scales_of_rows(const ConstraintProblem<D>& problem, ConstraintStart start) {
  auto w = row_mobilities(problem);
  double largest = 0;
  for (const auto& block : problem.blocks) largest = std::max(largest, w[block.row]);
  for (const auto& block : problem.blocks) {
    if (!block.is_contact) continue;
    if (start == ConstraintStart::kLeastImpulses) w[block.row] = largest;
    for (std::size_t k = 2; k < block.rows; ++k)
      w[block.row + 1] = w[block.row + k] = std::max(w[block.row + 1], w[block.row + k]);
  }
  return w;
}

template <int D>
class Iteration {
 public:
  Iteration(ConstraintProblem<D>& problem, ConstraintStart start)
      : problem_(problem), w_(scales_of_rows(problem, start)), sweeps_(problem), start_(start) {
    for (const auto& block : problem.blocks) {
      if (!block.is_contact) continue;
      problem.impulses[block.row] = std::max(problem.impulses[block.row], block.lowest);
      has_given_loads_ |= block.friction_bound == FrictionBound::kGiven;
      has_cones_ |= block.is_in_cone();
    }
    best_.result.residual = std::numeric_limits<double>::infinity();
    update();
  }

  ConstraintSolution<D> solve(int max_iterations) {
    if (problem_.is_convex) {
      solve_with_own_loads(max_iterations);
      return finish();
    }
    if (start_ == ConstraintStart::kSweeps) sweep_while_it_gains(max_iterations);
    if (residual_ <= 1 || best_.result.iterations >= max_iterations) return finish();
    proximal_.emplace(problem_, w_, matrix());
    proximal_->set_epsilon(epsilon_);
    while (residual_ > 1 && best_.result.iterations < max_iterations && !is_stagnant()) {
      take_proximal_step(max_iterations);
      note_progress();
    }
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
  /// Before interior points, which need the same time whatever they begin with, and where units
  /// make long chains, only sweeps that are about to solve the problem are worth their time.
  void sweep_while_it_gains(int max_iterations) {
    const double gain = problem_.is_convex || problem_.has_long_chains ? 0.1 : 0.7;
    double before = std::numeric_limits<double>::infinity();
    while (residual_ > 1 && residual_ < gain * before && best_.result.iterations < max_iterations) {
      before = residual_;
      sweep();
    }
  }

  /// Notes when the best residual has been halved.
  void note_progress() {
    constexpr double kGain = 0.5;
    if (!(best_.result.residual < kGain * gained_residual_)) return;
    gained_residual_ = best_.result.residual;
    gained_at_ = best_.result.iterations;
  }
  /// Whether the best residual was not halved for a long time. With a patience of 2000 iterations,
  /// three more of the 200 steps of bench/box2d.cpp ended without a solution.
  bool is_stagnant() const {
    constexpr int kPatience = 3000;
    return best_.result.iterations - gained_at_ > kPatience;
  }

  /// Takes a proximal step, or goes back and makes the next one easier to solve. Between jammed
  /// particles that stick, impulses that balance each other must grow until a contact slips or
  /// opens. Small epsilons reach this state fast, but Newton's method then fails more often.
  /// Therefore epsilon falls after a success and grows after a failure. If even the easiest step
  /// fails, sweeps continue.
  void take_proximal_step(int max_iterations) {
    constexpr int kMostIterations = 200, kFewIterations = 2;
    constexpr double kLeastEpsilon = 1e-12, kLargestEpsilon = 1, kFactor = 3, kLargeFactor = 10;
    const auto center = problem_.impulses;
    const int most = std::clamp(max_iterations - best_.result.iterations, 1, kMostIterations);
    const int taken = proximal_->solve(center, motions_, most);
    best_.result.iterations += taken;
    if (!proximal_->failed() && taken < most) {
      problem_.impulses = proximal_->impulses();
      update();
    }
    if (proximal_->failed() || taken >= most || !std::isfinite(residual_)) {
      problem_.impulses = center;
      update();
      if (epsilon_ == kLargestEpsilon) sweep();
      epsilon_ = std::min(kLargestEpsilon, kFactor * epsilon_);
      proximal_->set_epsilon(epsilon_);
      return;
    }
    // Most problems are solved in fewer steps, with slips far below what is allowed.
    constexpr int kManySteps = 15, kShareOfSteps = 4;
    if (residual_ > 1 && ++steps_ >= std::max(kManySteps, next_try_) && largest_slip() <= 1) {
      if (close_gaps(center, max_iterations)) return;
      next_try_ = steps_ + steps_ / kShareOfSteps;
    }
    if (proximal_->followed_path()) return;
    epsilon_ /= taken <= kFewIterations ? kLargeFactor : kFactor;
    epsilon_ = std::max(kLeastEpsilon, epsilon_);
    proximal_->set_epsilon(epsilon_);
  }

  /// The largest residual of tangential rows, divided by what is allowed.
  double largest_slip() const {
    double largest = 0;
    for (std::size_t b = 0; b < residuals_.size(); ++b)
      largest = std::max(largest, residuals_[b].tangential / problem_.blocks[b].allowed_slip);
    return largest;
  }

  /// Makes gaps and bilateral rows exact after a step from the impulses `center` whose slips are
  /// allowed. Between jammed particles that stick, slips are never 0: impulses would grow without
  /// end, and this changes gaps by more than their small tolerance. Therefore further steps change
  /// the center of normal impulses only. For the slips, epsilon is so large that the small changes
  /// of the gaps hardly change the friction, and the center is the one with which all contacts keep
  /// their branches. Returns whether the problem is solved.
  bool close_gaps(std::vector<double> center, int max_iterations) {
    constexpr int kMostSteps = 12, kMostIterations = 200;
    constexpr double kEpsilonOfSlips = 1e-3, kLeastEpsilon = 1e-6, kFactor = 3;
    const auto before = problem_.impulses;
    for (const auto& block : problem_.blocks)
      for (std::size_t r = block.row + 1; block.is_contact && r < block.row + block.rows; ++r)
        center[r] += values_[r] / w_[r] * (1 / kEpsilonOfSlips - 1 / epsilon_);
    double of_gaps = epsilon_;
    for (int n = 0; n < kMostSteps && residual_ > 1; ++n) {
      for (const auto& block : problem_.blocks)
        for (std::size_t k = 0; k < (block.is_contact ? 1 : block.rows); ++k)
          center[block.row + k] = problem_.impulses[block.row + k];
      of_gaps = std::min(of_gaps, std::max(kLeastEpsilon, of_gaps / kFactor));
      proximal_->set_epsilon(of_gaps, kEpsilonOfSlips);
      const int most = std::clamp(max_iterations - best_.result.iterations, 1, kMostIterations);
      const int taken = proximal_->solve(center, motions_, most);
      best_.result.iterations += taken;
      if (proximal_->failed() || taken >= most) break;
      problem_.impulses = proximal_->impulses();
      update();
      if (!(largest_slip() <= 1)) break;
    }
    proximal_->set_epsilon(epsilon_);
    if (residual_ <= 1) return true;
    problem_.impulses = before;
    update();
    return false;
  }

  /// Solves a convex problem. If loads of its contacts are given, interior points first solve it
  /// with these. The loads of that solution are then given in a second solution. A rough solution
  /// only finds loads for the next one.
  void solve_with_own_loads(int max_iterations) {
    if (has_given_loads_ && !problem_.keeps_loads && !problem_.is_rough) {
      find_interior_solution(max_iterations);
      take_loads();
      // The best solution so far belongs to other loads, and does not count.
      best_.result.residual = std::numeric_limits<double>::infinity();
      update();
    }
    solve_convex(max_iterations);
  }

  /// Gives contacts the loads that they have in the present solution.
  void take_loads() {
    for (auto& block : problem_.blocks)
      if (block.friction_bound == FrictionBound::kGiven)
        block.given_load = FrictionLaw::carried(problem_.impulses[block.row], block.capacity);
  }

  /// Solves a convex problem by interior points.
  void find_interior_solution(int max_iterations) {
    // In space, the proximal steps that follow are as fast as further iterations of interior points.
    constexpr double kRough = 1e-3, kAccurate = D == 2 ? 1e-9 : 1e-6;
    constexpr int kMostIterations = 60;
    if (!interior_) interior_.emplace(problem_, w_, matrix());
    const int most = std::clamp(max_iterations - best_.result.iterations, 1, kMostIterations);
    best_.result.iterations += interior_->solve(problem_.is_rough ? kRough : kAccurate, most);
    problem_.impulses = interior_->impulses();
    update();
  }

  /// Solves a convex problem by interior points. Where these are not accurate enough, proximal
  /// steps follow, which take a few iterations, because it is known which contacts stick and slide.
  void solve_convex(int max_iterations) {
    // Where rows are redundant, sweeps depend on their order, and so would loads. Interior points
    // do not.
    if (!has_given_loads_ && start_ == ConstraintStart::kSweeps)
      sweep_while_it_gains(max_iterations);
    if (residual_ <= 1 || best_.result.iterations >= max_iterations) return;
    find_interior_solution(max_iterations);
    if (problem_.is_rough) return;
    // With a smaller epsilon the rounding errors of the gaps, divided by epsilon, would be larger.
    constexpr double kFirstEpsilonOfConvex = 1e-5;
    epsilon_ = kFirstEpsilonOfConvex;
    is_rising_ = true;
    if (!proximal_) proximal_.emplace(problem_, w_, matrix());
    proximal_->set_epsilon(epsilon_);
    while (residual_ > 1 && best_.result.iterations < max_iterations && !is_stagnant()) {
      take_convex_step(max_iterations);
      note_progress();
    }
  }

  /// Takes a proximal step for a convex problem. Each step leads nearer to the solution
  /// but for rounding errors, which are those of the gaps divided by epsilon. Therefore epsilon
  /// rises until the errors are gone. Where impulses between jammed particles must grow, it falls
  /// and rises again.
  void take_convex_step(int max_iterations) {
    constexpr int kMostIterations = 50;
    constexpr double kLeastEpsilon = 1e-8, kFactor = 10, kLittle = 0.9;
    const auto center = problem_.impulses;
    const double before = residual_;
    const int most = std::clamp(max_iterations - best_.result.iterations, 1, kMostIterations);
    const int taken = proximal_->solve(center, motions_, most);
    best_.result.iterations += taken;
    problem_.impulses = proximal_->impulses();
    update();
    const bool is_solved = !proximal_->failed() && taken < most && std::isfinite(residual_);
    const bool is_largest = epsilon_ >= kFirstEpsilon, is_least = epsilon_ <= kLeastEpsilon;
    // If gaps hardly improve although contacts hardly slip, particles are jammed. This test does
    // not hold for contacts in cones, whose projection moves normal and tangential impulses
    // together.
    constexpr double kLittleSlip = 0.01, kSlow = 0.1;
    if (is_solved && !has_cones_ && residual_ > 1 && residual_ > kSlow * before &&
        largest_slip() <= kLittleSlip && close_gaps(center, max_iterations))
      return;
    if (!is_solved) {
      problem_.impulses = center;
      update();
      if (is_largest) sweep();
    } else if (residual_ > 1 && residual_ > kLittle * before && residual_ < before / kLittle) {
      extend_change(center);
    }
    is_rising_ = !is_largest && (is_rising_ || is_least || !is_solved);
    epsilon_ = is_rising_ ? std::min(kFirstEpsilon, kFactor * epsilon_)
                          : std::max(kLeastEpsilon, epsilon_ / kFactor);
    proximal_->set_epsilon(epsilon_);
  }

  /// Between jammed particles, impulses that balance each other grow by the same small amounts in
  /// each step, and the residual stays, until a contact slips or opens. This function adds all
  /// these amounts at once.
  void extend_change(const std::vector<double>& center) {
    const auto& p = problem_.impulses;
    double length = std::numeric_limits<double>::infinity();
    for (const auto& block : problem_.blocks) {
      if (!block.is_contact) continue;
      const auto bounded_by = [&](ConePoint here, ConePoint change) {
        // Contacts on the boundary stay there.
        constexpr double kInside = 1e-9;
        if (determinant(here) > kInside * here[0] * here[0])
          length =
              std::min(length, length_to_boundary({here, here[0] - beside_axis(here)}, change));
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
    for (std::size_t r = 0; r < p.size(); ++r) problem_.impulses[r] += length * (p[r] - center[r]);
    update();
  }

  /// The matrix of Newton's methods. It is analysed when it is needed first.
  UnitMatrix<D>& matrix() {
    if (!matrix_) matrix_.emplace(problem_, problem_.is_convex);
    return *matrix_;
  }

  /// Computes motions and residuals, and keeps the solution if it is the best so far.
  void update() {
    motions_ = motions<D>(problem_, problem_.impulses);
    values_.resize(problem_.rows.size());
    residuals_.resize(problem_.blocks.size());
    residual_ = 0;
    for (std::size_t b = 0; b < problem_.blocks.size(); ++b) {
      const auto& block = problem_.blocks[b];
      for (std::size_t r = block.row; r < block.row + block.rows; ++r)
        values_[r] = problem_.rows[r].offset + problem_.product(r, motions_);
      residuals_[b] =
          residual_of(block, &values_[block.row], &problem_.impulses[block.row], &w_[block.row]);
      const double share = residuals_[b].share(block);
      residual_ = largest_or_nan(residual_, share);
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
  ConstraintStart start_;
  std::optional<UnitMatrix<D>> matrix_;
  std::optional<InteriorPoints<D>> interior_;
  std::optional<ProximalStep<D>> proximal_;
  std::vector<double> values_;  // of the rows
  std::vector<double> best_impulses_;
  std::vector<Motion<D>> motions_;
  std::vector<BlockResidual> residuals_;
  ConstraintSolution<D> best_;
  double gained_residual_ = std::numeric_limits<double>::infinity();  // see note_progress()
  int gained_at_ = 0;
  bool is_rising_ = false, has_given_loads_ = false, has_cones_ = false;
  int steps_ = 0, next_try_ = 0;  // of the proximal method; the step in which to close the gaps
  double residual_ = 0, epsilon_ = kFirstEpsilon;
};

}  // namespace

template <int D>
ConstraintSolution<D> solve_constraints(ConstraintProblem<D>& problem, int max_iterations,
                                        ConstraintStart start) {
  return Iteration<D>(problem, start).solve(max_iterations);
}

template ConstraintSolution<2> solve_constraints<2>(ConstraintProblem<2>&, int, ConstraintStart);
template ConstraintSolution<3> solve_constraints<3>(ConstraintProblem<3>&, int, ConstraintStart);

}  // namespace viscontact::particles
