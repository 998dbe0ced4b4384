// Modified proportioning with reduced gradient projections (Dostal & Schoeberl 2005), MPRGP.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "viscontact/contact_solver/problem/dual_problem.hpp"

namespace viscontact::contact_solver {

struct MprgpTuning {
  // Added to the diagonal of W, which is 1. Redundant contacts make W singular: along some
  // directions the slope and the curvature are only rounding errors, and impulses would move along
  // them without end. It is above rounding errors, far below the curvatures of a chain of 10000
  // contacts (1e-8), and below any tolerance. Where particles are jammed in a wedge, impulses may
  // be so large that it leaves a gap; Mprgp::drop_regularisation() is for such impulses.
  static constexpr double kRegularisation = 1e-14;
  // First length of a projected gradient step: 2 over the largest eigenvalue of W, which is at most
  // 4 in packings of similar particles, because W has the diagonal 1. With a step shorter than
  // kShortest a rise of the objective is a rounding error.
  static constexpr double kLength = 0.5, kShortest = 1e-6;
  // If contacts contradict each other, the objective has no minimum, and the length of a step,
  // which is about 1 otherwise, is almost infinite: a conjugate gradient step longer than kEndless
  // ends at a bound, and one that leaves the bounds is at most kLongest.
  static constexpr double kEndless = 1e12, kLongest = 1e6;
  // Only one pass of so many computes all statistics where the preconditioner sweeps.
  static constexpr int kPassesBetweenMeasurements = 4;
};

/// Minimises z^T W z/2 + b^T z over z >= bound. Contacts with z above the bound are free. The free
/// gradient is the gradient g = W z + b on them, the chopped gradient the negative part of g on the
/// others, which would move them off the bound. Sums are taken in blocks of the thread pool, so
/// that results do not depend on the number of threads. Each step is one of three:
///
/// - proportioning is a step along the chopped gradient, made if this is larger than the free one;
/// - otherwise the step is one of preconditioned conjugate gradients;
/// - expansion: if such a step leaves the bounds, its end is projected on them.
///
/// `Preconditioner` has apply(gradient, swept, y), and, if its constant kMaySweep is true, also the
/// other functions of the class Preconditioner in dual_solver.cpp.
template <SolvableDualProblem Problem, class Preconditioner>
class Mprgp {
 public:
  /// `problem` must outlive the object.
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

  /// Projects z on its bounds and computes the gradient without the rounding errors of updates.
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

  /// Largest DualProblem::residual() [1]; at most 1 if all contacts have converged. It may be that
  /// of up to three steps before; after refresh() it is the present one. NaN if a number is NaN.
  double residual() const {
    // The sums are NaN if a gradient is; the largest residual, without branches, is not.
    const double sums = statistics_.free_slope + statistics_.chopped_square;
    return std::isnan(sums) ? sums : statistics_.residual;
  }

  /// From now on omits MprgpTuning::kRegularisation.
  void drop_regularisation() {
    regularisation_ = 0;
    refresh();
  }

  /// Makes a new factor for the preconditioner. If it returns false, the caller may go on without
  /// it.
  bool factorise() {
    restart_ = true;
    return preconditioner_.factorise();
  }

  /// Conjugate gradient steps since a contact last became free or reached its bound.
  int steps_between_same() const { return steps_between_same_; }

  /// Returns about the number of products with W that the step took, >= 1.
  int step() {
    if (statistics_.chopped_square > statistics_.free_slope) return leave_bounds();
    if (restart_) start_directions();
    before_ = problem_.z;
    ++steps_between_same_;
    const double length = slope_ / curvature_;
    if (!(length < MprgpTuning::kEndless)) return go_to_bound();
    move(length);
    if (statistics_.distance_to_bound < 0) return expand(length);
    const double slope = preconditioner_.apply(gradient_, swept_, y_);
    const double beta = slope / slope_;
    slope_ = slope;
    combine_directions(beta);
    return 1;
  }

 private:
  struct PassStatistics {
    double residual = 0;  ///< of DualProblem::residual()
    /// Inner product of the free gradient and the reduced one, which is at most (z - bound)/(step
    /// length), so that a gradient step along it stays within the bounds.
    double free_slope = 0;
    double chopped_square = 0;
    double distance_to_bound = std::numeric_limits<double>::infinity();  ///< smallest z - bound

    /// Adds a contact with the gradient `g` and z - bound = `distance`; `per_step` is 1 over step_.
    /// There are no branches, because a processor could not predict which contacts are free.
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

  /// As an array of Eigen, which sums faster than a simple loop.
  static Eigen::Map<Eigen::ArrayXd> part(std::vector<double>& numbers, std::size_t begin,
                                         std::size_t end) {
    return {numbers.data() + begin, static_cast<Eigen::Index>(end - begin)};
  }

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

  void combine_directions(double beta) {
    const auto square = problem_.pool().template sum_of_blocks<double>(
        problem_.count(), [&](std::size_t begin, std::size_t end) {
          auto direction = part(direction_, begin, end);
          direction = part(swept_, begin, end) + beta * direction;
          return direction.square().sum();
        });
    curvature_ = problem_.combine(y_, beta, y_direction_) + regularisation_ * square;
  }

  /// Moves z by -length * direction. If the preconditioner sweeps, the forward half of its sweep is
  /// in the same loop, which reads the same rows, and only every fourth call computes all
  /// statistics.
  void move(double length) {
    [[maybe_unused]] const bool measure =
        restart_ || ++passes_ % MprgpTuning::kPassesBetweenMeasurements == 0;
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

  /// The loop of move(), with all statistics if kMeasure and the forward sweep if kSweep.
  template <bool kMeasure, bool kSweep>
  PassStatistics pass(double length) {
    return problem_.pool().template sum_of_blocks<PassStatistics>(
        problem_.count(), [&](std::size_t begin, std::size_t end) {
          // Local copies make the loop faster: a compiler cannot know that the loop does not change
          // the pointers inside the members, and would read them again for each contact.
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

  /// Projects z on the bounds after a step. If the objective has not fallen, goes to the first
  /// bound instead. Returns the number of products with W, as the next functions.
  int expand(double length) {
    // The objective is a quadratic function of the length, which gives its value before the step.
    const double before = objective() + length * (slope_ - length * curvature_ / 2);
    refresh();
    return objective() < before ? 1 : 2 + go_to_bound();
  }

  /// Goes from the point before the step to the first bound, and makes a projected gradient step.
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

  /// Halves the length step_ of a projected gradient step until the objective does not rise.
  int project_gradient() {
    const auto here = problem_.z;
    const double before = objective();
    for (int products = 1;; ++products) {
      for (std::size_t c = 0; c < problem_.count(); ++c)
        if (problem_.is_free(c))
          problem_.z[c] = std::max(problem_.bound[c], problem_.z[c] - step_ * gradient_[c]);
      refresh();
      if (objective() <= before || step_ < MprgpTuning::kShortest) return products;
      // An eigenvalue of W exceeds 4, as a particle with many contacts can cause.
      step_ /= 2;
      problem_.z = here;
      refresh();
    }
  }

  int leave_bounds() {
    for (std::size_t c = 0; c < problem_.count(); ++c)
      direction_[c] = !problem_.is_free(c) && gradient_[c] < 0 ? gradient_[c] : 0.0;
    const double curvature = problem_.to_bodies(direction_, y_direction_);
    restart_ = true;
    move(std::min(statistics_.chopped_square / curvature, MprgpTuning::kLongest));
    return 1;
  }

  Problem& problem_;
  Preconditioner preconditioner_;
  double step_ = MprgpTuning::kLength;  // of a projected gradient step
  std::vector<double> before_;
  std::vector<double> y_;            // B z after refresh(), later B swept
  std::vector<double> y_direction_;  // B direction
  std::vector<double> gradient_, direction_, swept_;
  PassStatistics statistics_;
  double regularisation_ = MprgpTuning::kRegularisation;
  double slope_ = 0;  // inner product of gradient and direction
  double curvature_ = 0;
  bool restart_ = true;
  int steps_between_same_ = 0;
  unsigned passes_ = 0;
};

}  // namespace viscontact::contact_solver
