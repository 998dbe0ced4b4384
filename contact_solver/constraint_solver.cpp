// Which of the methods for (5.6) to (5.9), docs/physics.md, solves a problem, and when.
#include "viscontact/contact_solver/constraint_solver.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "viscontact/contact_solver/block_factor.hpp"
#include "viscontact/contact_solver/cone.hpp"
#include "viscontact/contact_solver/contact_sweeps.hpp"
#include "viscontact/contact_solver/coulomb_path.hpp"
#include "viscontact/contact_solver/interior_points.hpp"
#include "viscontact/contact_solver/proximal_step.hpp"

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

/// One solution: the present impulses, what follows from them, and the best impulses so far.
template <int D>
class Iteration {
 public:
  /// `problem` must outlive the object. Its normal impulses are raised to their lowest values.
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
    solve_with_paths(max_iterations);
    return finish();
  }

 private:
  /// Each sweep counts as an iteration.
  void sweep() {
    constexpr int kSweeps = 30;
    sweeps_.sweep(kSweeps, w_);
    best_.result.iterations += kSweeps;
    update();
  }

  /// A sweep takes a small part of the time of a factorisation, so that slow progress is enough.
  void sweep_while_it_gains(int max_iterations) {
    constexpr double kGain = 0.7;
    double before = std::numeric_limits<double>::infinity();
    while (residual_ > 1 && residual_ < kGain * before &&
           best_.result.iterations < max_iterations) {
      before = residual_;
      sweep();
    }
  }

  /// Records the number of iterations when the best residual has been halved again.
  void note_progress() {
    constexpr double kGain = 0.5;
    if (!(best_.result.residual < kGain * gained_residual_)) return;
    gained_residual_ = best_.result.residual;
    gained_at_ = best_.result.iterations;
  }
  /// True if the best residual was not halved in the last kPatience iterations, without those of
  /// paths. With 2000 in place of 3000 and Coulomb's law, three more of the 200 steps of
  /// bench/box2d.cpp ended without a solution when there were no paths. Convex problems whose loads
  /// are not given take 20 to 70 iterations, unless they have no solution.
  bool is_stagnant() const {
    constexpr int kPatience = 3000, kPatienceOfCones = 300;
    return best_.result.iterations - gained_at_ > (has_cones_ ? kPatienceOfCones : kPatience);
  }

  /// Takes proximal steps with Coulomb's law and, where these are many, steps from ends of paths.
  void solve_with_paths(int max_iterations) {
    // Proximal steps solve easy problems in less time than a path takes, and with loads that are
    // nearer to the guess. From the end of a path, most solutions take 0 to 20 iterations. With
    // kLeastImpulses paths are the last resort, because their ends do not depend on the guess.
    constexpr double kBeforePath = 1e5;  // iterations times contacts
    constexpr int kMostAfterPath = 200, kLeastBeforePath = 50, kMostBeforePath = 2000;
    const double contacts = static_cast<double>(problem_.blocks.size());
    const int most_before = start_ == ConstraintStart::kLeastImpulses
                                ? kMostBeforePath
                                : static_cast<int>(std::clamp<double>(
                                      kBeforePath / contacts, kLeastBeforePath, kMostBeforePath));
    int paths = 0, path_ended_at = 0, next = best_.result.iterations + most_before;
    bool is_after_path = false;
    auto before = problem_.impulses;
    double epsilon_before = epsilon_, halved = 0;
    const auto begin_at = [&](const std::vector<double>& impulses, double epsilon) {
      problem_.impulses = impulses;
      update();
      epsilon_ = epsilon;
      proximal_->set_epsilon(epsilon);
      halved = residual_;
      next = best_.result.iterations + kMostAfterPath;
    };
    while (residual_ > 1 && best_.result.iterations < max_iterations && !is_stagnant()) {
      const bool has_paths = is_after_path || paths < CoulombPath<D>::kPaths;
      if (best_.result.iterations < next || !has_paths) {
        take_proximal_step(max_iterations);
        // Steps go on from the end of a path while they halve the residual.
        if (is_after_path && residual_ < halved / 2) {
          halved = residual_;
          next = best_.result.iterations + kMostAfterPath;
        }
      } else if (is_after_path) {
        // The iterations since the end of the path do not count in is_stagnant().
        is_after_path = false;
        gained_at_ += best_.result.iterations - path_ended_at;
        most_impulse_ = std::numeric_limits<double>::infinity();
        begin_at(before, epsilon_before);
      } else {
        before = problem_.impulses;
        epsilon_before = epsilon_;
        if (const auto end = end_of_path(paths++, max_iterations)) {
          // Where particles are jammed, impulses that balance each other may have any size. A
          // solution with an impulse larger than sum_of_impulses_at_work() has no meaning.
          is_after_path = true;
          path_ended_at = best_.result.iterations;
          most_impulse_ = sum_of_impulses_at_work();
          begin_at(*end, kFirstEpsilon);
        }
      }
      note_progress();
    }
  }

  /// Returns the impulses at the end of a path, or nothing if it ends far from a solution.
  std::optional<std::vector<double>> end_of_path(int number, int max_iterations) {
    // These are accuracies relative to the violations without impulses. Most of the factorisations
    // are made at errors of 1e-3 to 1e-5, and about ten at errors from 1e-5 to 1e-7.
    constexpr double kRough = 1e-4, kAccurate = 1e-7, kFar = 1e-3;
    // A long path is left for another one, which seldom is as long.
    const int longest = number + 1 < CoulombPath<D>::kPaths ? 400 : 2000;
    // Each point of the path takes a factorisation and three solutions with factors.
    constexpr int kForPoint = 4;
    const int left = max_iterations - best_.result.iterations;
    CoulombPath<D> path(problem_, w_, matrix());
    const int taken = kForPoint * path.follow(number, problem_.is_rough ? kRough : kAccurate,
                                              std::clamp(left / kForPoint, 1, longest));
    best_.result.iterations += taken;
    gained_at_ += taken;
    proximal_->set_epsilon(epsilon_);  // because the path has overwritten its matrix
    if (!(path.reached() <= kFar)) return {};
    return path.impulses();
  }

  /// A bound of the impulses that a solution can need [M L/T]: the sum of those that stop the free
  /// motion of each unit, of those that remove its violations of contacts with friction and rigid
  /// links, and of the lowest impulses of such contacts.
  double sum_of_impulses_at_work() const {
    double sum = 0;
    std::vector<Motion<D>> free;
    for (const auto& unit : problem_.units) {
      free.push_back(unit.free);
      const auto impulse = unit.impulse_of(unit.free);
      double square = 0;
      for (std::size_t k = 0; k < D; ++k) square += impulse[k] * impulse[k];
      sum += std::sqrt(square);
    }
    for (const auto& block : problem_.blocks) {
      // Springs and stops may have rows of angles, whose impulses are moments.
      if (block.is_contact ? block.rows == 1 : block.compliance > 0) continue;
      if (block.is_contact) sum += std::abs(block.lowest);
      for (std::size_t r = block.row; r < block.row + (block.is_contact ? 1 : block.rows); ++r) {
        const double value = problem_.rows[r].offset + problem_.product(r, free);
        if (!block.is_contact || value < 0) sum += std::abs(value) / w_[r];
      }
    }
    return sum;
  }

  /// Between jammed particles that stick, impulses that balance each other must grow until a
  /// contact slips or opens. Small epsilons reach this state fast, but steps fail more often.
  /// Therefore epsilon falls after a success and grows after a failure, and sweeps follow on
  /// failures with the largest one.
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
    // Most problems are solved in fewer than kManySteps steps. close_gaps() is tried then, and
    // again when the number of steps has grown by a quarter.
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

  /// The largest tangential residual over its allowed one [1].
  double largest_slip() const {
    double largest = 0;
    for (std::size_t b = 0; b < residuals_.size(); ++b)
      largest = std::max(largest, residuals_[b].tangential / problem_.blocks[b].allowed_slip);
    return largest;
  }

  /// Makes the residuals of gaps and links allowed, after a step from the impulses `center` has
  /// made those of the slips allowed. Between jammed particles that stick, slips are never 0, so
  /// that further steps would increase impulses without end. Therefore the steps start from the
  /// last impulses in the rows of gaps and links only. The tangential rows keep a center with which
  /// the present motions give the present friction, and a large epsilon. Returns true if the
  /// problem is solved; otherwise restores the impulses.
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

  /// A first solution replaces given loads by its own, unless they are kept or the solution is
  /// rough.
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

  /// Sets the given loads to the loads of the solids at the present impulses.
  void take_loads() {
    for (auto& block : problem_.blocks)
      if (block.friction_bound == FrictionBound::kGiven)
        block.given_load = load_of_solids(problem_.impulses[block.row], block.capacity);
  }

  void find_interior_solution(int max_iterations) {
    // Accuracies relative to the violations without impulses. With 1e-6 in place of kAccurate
    // spheres take 3 to 7 % less time, but proximal steps fail where several contacts are near the
    // tips of their cones. A solution with kRough only finds the pairs that take part, and first
    // loads. In bench/box2d.cpp it misses no more pairs with 1e-2 than with 1e-3, but some more
    // with 3e-2.
    constexpr double kRough = 1e-2, kAccurate = 1e-9, kExact = 1e-13;
    constexpr int kMostIterations = 60;
    if (!interior_) interior_.emplace(problem_, w_, matrix());
    const int most = std::clamp(max_iterations - best_.result.iterations, 1, kMostIterations);
    best_.result.iterations += interior_->solve(problem_.is_rough  ? kRough
                                                : problem_.is_near ? kExact
                                                                   : kAccurate,
                                                most);
    problem_.impulses = interior_->impulses();
    update();
  }

  /// Few proximal steps follow, because the interior points have found which contacts stick.
  void solve_convex(int max_iterations) {
    if (residual_ <= 1 || best_.result.iterations >= max_iterations) return;
    // Proximal steps from a near solution change its slips little. Interior points would have
    // errors in the slips, which bodies that turn pass on to gaps, so that corrections for finite
    // turns would not vanish. Most such solutions take two to eight iterations.
    constexpr int kMostNear = 20;
    if (problem_.is_near &&
        take_convex_steps(std::min(max_iterations, best_.result.iterations + kMostNear)))
      return;
    // Sweeps seldom solve a problem, and the time of interior points does not depend on their
    // start. If rows are redundant, impulses found by sweeps would depend on the order of the rows.
    find_interior_solution(max_iterations);
    if (!problem_.is_rough) take_convex_steps(max_iterations);
  }

  /// Returns true if the problem is solved.
  bool take_convex_steps(int max_iterations) {
    // The errors of the impulses are the rounding errors of the gaps divided by epsilon. With a
    // smaller epsilon than this one they are too large.
    constexpr double kFirstEpsilonOfConvex = 1e-5;
    epsilon_ = kFirstEpsilonOfConvex;
    is_rising_ = true;
    if (!proximal_) proximal_.emplace(problem_, w_, matrix());
    proximal_->set_epsilon(epsilon_);
    while (residual_ > 1 && best_.result.iterations < max_iterations && !is_stagnant()) {
      take_convex_step(max_iterations);
      note_progress();
    }
    return residual_ <= 1;
  }

  /// Without rounding errors each step would lead nearer to the solution. The errors of the
  /// impulses are those of the gaps over epsilon. Therefore epsilon rises to kFirstEpsilon, then
  /// falls so that impulses between jammed particles grow fast, and rises again.
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
    // If the residual hardly falls although contacts hardly slip, particles are jammed. The
    // projection of FrictionBound::kCone changes normal and tangential impulses together, and
    // forbids close_gaps().
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

  /// Adds the change of the impulses since `center` times the largest number with which no contact
  /// begins to slip or open. Jammed particles get the same change in each step until then.
  void extend_change(const std::vector<double>& center) {
    const auto& p = problem_.impulses;
    double length = std::numeric_limits<double>::infinity();
    for (const auto& block : problem_.blocks) {
      if (!block.is_contact) continue;
      const auto bounded_by = [&](ConePoint here, ConePoint change) {
        // Contacts that slip or are open already do not limit the length.
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

  UnitMatrix<D>& matrix() {
    if (!matrix_) matrix_.emplace(problem_, problem_.is_convex);
    return *matrix_;
  }

  /// The first iterate is stored also if its residual is NaN, because finish() must return one.
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
      if (block.is_contact && block.rows > 1 && problem_.impulses[block.row] > most_impulse_)
        residual_ = std::numeric_limits<double>::infinity();
    }
    if (!best_.motions.empty() && !(residual_ < best_.result.residual)) return;
    if (residual_ < best_.result.residual) best_.result.residual = residual_;
    best_.motions = motions_;
    best_.residuals = residuals_;
    best_impulses_ = problem_.impulses;
  }

  ConstraintSolution<D> finish() {
    problem_.impulses = best_impulses_;
    return std::move(best_);
  }

  // Epsilon [1] of the first proximal step with Coulomb's law, as of ProximalStep; bench/README.md
  // lists the results of other values.
  static constexpr double kFirstEpsilon = 0.1;

  ConstraintProblem<D>& problem_;
  std::vector<double> w_;  // scales_of_rows() [T/M]
  ContactSweeps<D> sweeps_;
  ConstraintStart start_;
  std::optional<UnitMatrix<D>> matrix_;
  std::optional<InteriorPoints<D>> interior_;
  std::optional<ProximalStep<D>> proximal_;
  std::vector<double> values_;  // of the rows at the present impulses [L]
  std::vector<double> best_impulses_;
  std::vector<Motion<D>> motions_;
  std::vector<BlockResidual> residuals_;
  ConstraintSolution<D> best_;
  double gained_residual_ = std::numeric_limits<double>::infinity();  // see note_progress()
  int gained_at_ = 0;                                                 // see note_progress()
  bool is_rising_ = false, has_given_loads_ = false, has_cones_ = false;
  int steps_ = 0, next_try_ = 0;  // proximal steps so far; the one after which to try close_gaps()
  double residual_ = 0, epsilon_ = kFirstEpsilon;  // residual_: largest over allowed one [1]
  // Normal impulse beyond which iterates do not count [M L/T].
  double most_impulse_ = std::numeric_limits<double>::infinity();
};

}  // namespace

template <int D>
ConstraintSolution<D> solve_constraints(ConstraintProblem<D>& problem, int max_iterations,
                                        ConstraintStart start) {
  assert(problem.impulses.size() == problem.rows.size());
  return Iteration<D>(problem, start).solve(max_iterations);
}

template <int D>
ConstraintSolution<D> solve_with_given_loads(ConstraintProblem<D>& problem, bool without_friction) {
  give_loads(problem);
  if (without_friction) {
    for (auto& block : problem.blocks) block.given_load = 0;
    std::ranges::fill(problem.impulses, 0.0);
    problem.keeps_loads = problem.is_near = false;
  }
  auto solution = solve_constraints(problem, kMostOfGivenLoads);
  problem.keeps_loads = true;
  return solution;
}

template <int D>
std::vector<double> least_violations(const ConstraintProblem<D>& problem) {
  // Each proximal step minimises the sum of v^2/(kEpsilon w) over the violated rows plus the square
  // of the change of the motions in the norm of the masses over the length of the step, which keeps
  // the matrix regular. A step multiplies errors by about kEpsilon if the rows determine the
  // motions well.
  constexpr double kEpsilon = 1e-6;
  constexpr int kSteps = 30;
  const auto w = row_mobilities(problem);
  UnitMatrix<D> matrix(problem, true);
  auto y = motions<D>(problem, std::vector<double>(problem.rows.size(), 0.0));
  std::vector<double> violations(problem.blocks.size());
  for (int n = 0;; ++n) {
    matrix.set_to_masses();
    std::vector<Motion<D>> missing(y.size(), Motion<D>{});
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
      const auto& block = problem.blocks[b];
      violations[b] = 0;
      if (!block.is_contact && block.compliance > 0) continue;
      for (std::size_t r = block.row; r < block.row + (block.is_contact ? 1 : block.rows); ++r) {
        const double value = problem.rows[r].offset + problem.product(r, y);
        if (block.is_contact && value >= 0) continue;
        violations[b] = std::max(violations[b], std::abs(value));
        const double weight = 1 / (kEpsilon * w[r]);
        matrix.add_product(b, r, r, weight);
        problem.add_impulse(r, -weight * value, missing);
      }
    }
    if (n == kSteps || !matrix.factorise()) break;
    const auto change = matrix.solution_of(missing);
    for (std::size_t u = 0; u < y.size(); ++u)
      for (std::size_t k = 0; k < y[u].size(); ++k) y[u][k] += change[u][k];
  }
  return violations;
}

template ConstraintSolution<2> solve_constraints<2>(ConstraintProblem<2>&, int, ConstraintStart);
template ConstraintSolution<3> solve_constraints<3>(ConstraintProblem<3>&, int, ConstraintStart);
template ConstraintSolution<2> solve_with_given_loads<2>(ConstraintProblem<2>&, bool);
template ConstraintSolution<3> solve_with_given_loads<3>(ConstraintProblem<3>&, bool);
template std::vector<double> least_violations<2>(const ConstraintProblem<2>&);
template std::vector<double> least_violations<3>(const ConstraintProblem<3>&);

}  // namespace viscontact::contact_solver
