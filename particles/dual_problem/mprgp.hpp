// Modified proportioning with reduced gradient projections, MPRGP (Dostal & Schoeberl 2005,
// "Minimizing quadratic functions subject to bound constraints with the rate of convergence and
// finite termination"), for the dual problem (5.4) of docs/physics.md, scaled as in
// dual_problem.hpp. dual_solver.cpp and fluid/contact_problem.cpp use it; nothing is thrown. Sums
// must be taken in blocks of the thread pool, so that the results do not depend on the number of
// threads.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "viscontact/particles/dual_problem/dual_problem.hpp"

namespace viscontact::particles {

/// The state of the iteration: z, its gradient g and the direction in which z moves. Free contacts
/// have z above the bound. PassStatistics below defines the free and the chopped gradient. A step
/// is one of three:
///
/// - proportioning: along the chopped gradient, if it is larger than the free gradient;
/// - otherwise a preconditioned conjugate gradient step;
/// - expansion: if that step would leave the bounds, a projected step instead.
///
/// `Preconditioner` has apply(gradient, swept, y). With kMaySweep it also has sweeps(), factorise()
/// and both sweep_forward(), as in dual_solver.cpp.
template <SolvableDualProblem Problem, class Preconditioner>
class Mprgp {
 public:
  /// Starts from problem.z, projected on its bounds. `problem` must outlive the object.
  Mprgp(Problem& problem, Preconditioner preconditioner)
      : problem_(problem),
        preconditioner_(std::move(preconditioner)),
        y_(problem.displacement_count()),
        y_direction_(problem.displacement_count()),
        gradient_(problem.count()),
        direction_(problem.count()),
        swept_(problem.count()) {
    refresh();
  }

  /// Projects z on its bounds and computes the gradient from z itself, which removes the rounding
  /// errors of many updates.
  void refresh() {
    problem_.pool().for_blocks(problem_.count(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c)
        problem_.z[c] = std::max(problem_.z[c], problem_.bound[c]);
    });
    problem_.to_bodies(problem_.z, y_);
    statistics_ = problem_.pool().template sum_of_blocks<PassStatistics>(
        problem_.count(), [&](std::size_t begin, std::size_t end) {
          PassStatistics statistics;
          for (std::size_t c = begin; c < end; ++c) {
            gradient_[c] = problem_.linear_term[c] + problem_.to_contact(c, y_.data()) +
                           regularisation_ * problem_.z[c];
            statistics.add(gradient_[c], problem_.z[c] - problem_.bound[c], problem_.per_allowed[c],
                           1 / step_);
          }
          return statistics;
        });
    restart_ = true;
  }

  /// Largest residual, divided by what is allowed: at most 1 if all contacts have converged.
  double residual() const { return statistics_.residual; }

  /// Solves the problem without the regularisation from now on.
  void drop_regularisation() {
    regularisation_ = 0;
    refresh();
  }

  /// Makes a new factor for the preconditioner. Returns false if there is none.
  bool factorise() {
    restart_ = true;
    return preconditioner_.factorise();
  }

  /// Number of steps since the set of free contacts last changed.
  int steps_between_same() const { return steps_between_same_; }

  /// Makes one step. Returns the number of products with W that it took.
  int step() {
    if (statistics_.chopped_square > statistics_.free_slope) return leave_bounds();
    if (restart_) start_directions();
    before_ = problem_.z;
    ++steps_between_same_;
    // If contacts contradict each other, the objective falls almost without end. The bound is a
    // free choice.
    constexpr double kEndless = 1e12;
    const double length = slope_ / curvature_;
    if (!(length < kEndless)) return go_to_bound();
    move(length);
    if (statistics_.distance_to_bound < 0) return expand(length);
    // The next direction is conjugate to this one.
    const double slope = preconditioner_.apply(gradient_, swept_, y_);
    const double beta = slope / slope_;
    slope_ = slope;
    combine_directions(beta);
    return 1;
  }

 private:
  /// Statistics of one pass over the contacts at z with gradient g.
  struct PassStatistics {
    double residual = 0;  ///< largest DualProblem::residual
    /// phi.g of the free gradient phi (g on the free contacts), in which phi is reduced so that a
    /// projected gradient step along it stays within the bounds.
    double free_slope = 0;
    /// |beta|^2 of the chopped gradient beta: the negative part of g on the contacts at their
    /// bound, which would leave the bound.
    double chopped_square = 0;
    double distance_to_bound = std::numeric_limits<double>::infinity();  ///< smallest z - bound

    /// Adds a contact. `per_step` is 1 over the length of a projected gradient step. This function
    /// has no branches, because which contacts are free is irregular in a packing and a processor
    /// could not predict them.
    void add(double g, double distance, double per_allowed, double per_step) {
      const bool is_free = distance > 0;
      const double phi = is_free ? g : 0.0, beta = is_free ? 0.0 : std::min(g, 0.0);
      *this += {per_allowed * std::abs(std::min(g, distance)),
                phi * std::min(g, distance * per_step), beta * beta, distance};
    }
    PassStatistics& operator+=(const PassStatistics& other) {
      residual = std::max(residual, other.residual);
      free_slope += other.free_slope;
      chopped_square += other.chopped_square;
      distance_to_bound = std::min(distance_to_bound, other.distance_to_bound);
      return *this;
    }
  };

  /// Entries `begin` to `end` as an array of Eigen, which sums faster because it uses several
  /// partial sums.
  static Eigen::Map<Eigen::ArrayXd> part(std::vector<double>& numbers, std::size_t begin,
                                         std::size_t end) {
    return {numbers.data() + begin, static_cast<Eigen::Index>(end - begin)};
  }

  /// Returns the objective z^T W z/2 + b^T z, W with the regularisation.
  double objective() {
    return problem_.pool().template sum_of_blocks<double>(
        problem_.count(), [&](std::size_t begin, std::size_t end) {
          return (part(problem_.z, begin, end) *
                  (part(gradient_, begin, end) + part(problem_.linear_term, begin, end)))
                     .sum() /
                 2;
        });
  }

  void start_directions() {
    std::fill(direction_.begin(), direction_.end(), 0.0);
    std::fill(y_direction_.begin(), y_direction_.end(), 0.0);
    if constexpr (Preconditioner::kMaySweep)
      if (preconditioner_.sweeps()) preconditioner_.sweep_forward(gradient_);
    restart_ = false;
    steps_between_same_ = 0;
    slope_ = preconditioner_.apply(gradient_, swept_, y_);
    combine_directions(0);
  }

  /// Sets direction = swept + beta * direction, and computes its displacements and its curvature.
  void combine_directions(double beta) {
    const auto square = problem_.pool().template sum_of_blocks<double>(
        problem_.count(), [&](std::size_t begin, std::size_t end) {
          auto direction = part(direction_, begin, end);
          direction = part(swept_, begin, end) + beta * direction;
          return direction.square().sum();
        });
    curvature_ = problem_.combine(y_, beta, y_direction_) + regularisation_ * square;
  }

  /// Subtracts length * direction from z and updates the gradient and the statistics. The forward
  /// half of the sweep is done in the same pass, because it reads the same rows. In three of four
  /// passes only the smallest distance to a bound is measured, because the other statistics can
  /// wait for a few steps.
  void move(double length) {
    constexpr int kPassesBetweenMeasurements = 4;
    [[maybe_unused]] const bool measure =
        restart_ || ++passes_since_measurement_ % kPassesBetweenMeasurements == 0;
    if constexpr (Preconditioner::kMaySweep) {
      if (preconditioner_.sweeps()) {
        if (measure)
          statistics_ = pass<true, true>(length);
        else
          statistics_.distance_to_bound = pass<false, true>(length).distance_to_bound;
        return;
      }
    }
    statistics_ = pass<true, false>(length);
  }

  template <bool kMeasure, bool kSweep>
  PassStatistics pass(double length) {
    return problem_.pool().template sum_of_blocks<PassStatistics>(
        problem_.count(), [&](std::size_t begin, std::size_t end) {
          // Local copies make the loop faster, because a compiler cannot know that the loop leaves
          // the pointers of the members unchanged.
          const double* direction = direction_.data();
          const double* y_direction = y_direction_.data();
          const double* bound = problem_.bound.data();
          double* zs = problem_.z.data();
          double* gradient = gradient_.data();
          const double per_step = 1 / step_;
          PassStatistics statistics;
          std::vector<double> sums;
          if constexpr (kSweep) sums = problem_.block_bodies(begin);
          for (std::size_t c = begin; c < end; ++c) {
            const double z = zs[c] - length * direction[c];
            const double g = gradient[c] - length * (problem_.to_contact(c, y_direction) +
                                                     regularisation_ * direction[c]);
            zs[c] = z;
            gradient[c] = g;
            const double distance = z - bound[c];
            if constexpr (kMeasure)
              statistics.add(g, distance, problem_.per_allowed[c], per_step);
            else
              statistics.distance_to_bound = std::min(statistics.distance_to_bound, distance);
            if constexpr (kSweep) preconditioner_.sweep_forward(c, g, distance > 0, sums.data());
          }
          return statistics;
        });
  }

  /// Expansion, after a step of this length that left the bounds. If the objective falls, keeps the
  /// whole step, projected on the bounds. Otherwise goes to the first bound.
  int expand(double length) {
    // The objective before the step follows from its present value, because it is quadratic along
    // the direction.
    const double before = objective() + length * (slope_ - length * curvature_ / 2);
    refresh();
    return objective() < before ? 1 : 2 + go_to_bound();
  }

  /// Goes from the point before the step to the first bound along the direction, if there is a
  /// bound, and makes a projected gradient step from there. The objective falls in both.
  int go_to_bound() {
    double feasible = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < problem_.count(); ++c)
      if (direction_[c] > 0)
        feasible = std::min(feasible, (before_[c] - problem_.bound[c]) / direction_[c]);
    for (std::size_t c = 0; c < problem_.count(); ++c)
      problem_.z[c] = std::isfinite(feasible) ? before_[c] - feasible * direction_[c] : before_[c];
    refresh();
    return 1 + project_gradient();
  }

  /// Makes a projected gradient step, so short that the objective does not rise.
  int project_gradient() {
    const auto here = problem_.z;
    const double before = objective();
    for (int products = 1;; ++products) {
      for (std::size_t c = 0; c < problem_.count(); ++c)
        if (problem_.is_free(c))
          problem_.z[c] = std::max(problem_.bound[c], problem_.z[c] - step_ * gradient_[c]);
      refresh();
      // Below this step length the change of the objective is a rounding error.
      constexpr double kShortest = 1e-6;
      if (objective() <= before || step_ < kShortest) return products;
      // The largest eigenvalue of W belongs to a particle with many contacts and may exceed 4.
      step_ /= 2;
      problem_.z = here;
      refresh();
    }
  }

  /// Proportioning: makes the best step along the chopped gradient, which moves contacts away from
  /// their bounds.
  int leave_bounds() {
    for (std::size_t c = 0; c < problem_.count(); ++c)
      direction_[c] = !problem_.is_free(c) && gradient_[c] < 0 ? gradient_[c] : 0.0;
    const double curvature = problem_.to_bodies(direction_, y_direction_);
    // Largest step length, where the length 1 is right for a single contact (W = 1). Contacts that
    // contradict each other would make the length infinite.
    constexpr double kLongest = 1e6;
    restart_ = true;
    move(std::min(statistics_.chopped_square / curvature, kLongest));
    return 1;
  }

  Problem& problem_;
  Preconditioner preconditioner_;
  /// Length of a projected gradient step. W has the diagonal 1, and in packings of similar
  /// particles all its eigenvalues are at most 4.
  double step_ = 0.5;
  std::vector<double> before_;           // z before the step
  std::vector<double> y_, y_direction_;  // displacements B z of bodies [L]
  std::vector<double> gradient_, direction_, swept_;
  PassStatistics statistics_;
  /// Added to the diagonal of W, which is 1. Redundant contacts make W singular: along some
  /// directions the slope and the curvature are only rounding errors, and impulses would move along
  /// them without end. 1e-14 is far above rounding errors, and far below the curvatures of a chain
  /// of 10 000 contacts (1e-8) and below any tolerance. Where particles are jammed in a wedge,
  /// impulses may be so large that this term leaves a gap. It is then dropped.
  double regularisation_ = 1e-14;
  double slope_ = 0;      // gradient.direction
  double curvature_ = 0;  // direction^T W direction
  bool restart_ = true;
  int steps_between_same_ = 0;
  unsigned passes_since_measurement_ = 0;
};

}  // namespace viscontact::particles
