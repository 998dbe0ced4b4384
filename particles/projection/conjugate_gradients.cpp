// Projected conjugate gradients, MPRGP (Dostal & Schoeberl 2005), for the dual problem (5.4) of
// docs/physics.md, scaled as in contact_graph.hpp. "Free" contacts have z above the bound. Sums
// must be taken in blocks of the thread pool, so that the results do not depend on the number of
// threads.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "viscontact/particles/projection/active_set_newton.hpp"
#include "viscontact/particles/projection/projection.hpp"

namespace viscontact::particles {
namespace {

/// Statistics of one pass over the contacts at z with gradient g.
struct PassStatistics {
  double residual = 0;  ///< largest ContactGraph::residual
  /// phi.g of the free gradient phi (g on the free contacts), in which phi is reduced so that a
  /// projected gradient step along it stays within the bounds.
  double free_slope = 0;
  /// |beta|^2 of the chopped gradient beta: the negative part of g on the contacts at their bound,
  /// which would leave the bound.
  double chopped_square = 0;
  double distance_to_bound = std::numeric_limits<double>::infinity();  ///< smallest z - bound
  PassStatistics& operator+=(const PassStatistics& other) {
    residual = std::max(residual, other.residual);
    free_slope += other.free_slope;
    chopped_square += other.chopped_square;
    distance_to_bound = std::min(distance_to_bound, other.distance_to_bound);
    return *this;
  }
};

/// Added to the diagonal of W, which is 1. Redundant contacts make W singular: along some
/// directions the slope and the curvature are only rounding errors, and impulses would move along
/// them without end. 1e-14 is far above rounding errors, and far below the curvatures of a chain of
/// 10 000 contacts (1e-8) and below any tolerance. Where particles are jammed in a wedge, impulses
/// may be so large that this term leaves a gap. It is dropped if the solution takes long.
constexpr double kRegularisation = 1e-14;

/// Entries `begin` to `end` as an array of Eigen, which sums faster because it uses several partial
/// sums.
Eigen::Map<Eigen::ArrayXd> part(std::vector<double>& numbers, std::size_t begin, std::size_t end) {
  return {numbers.data() + begin, static_cast<Eigen::Index>(end - begin)};
}

/// The state of the iteration: z, its gradient g and the direction in which z moves. The
/// preconditioner is a factor of W, if there is one, and otherwise a sweep of symmetric
/// Gauss-Seidel over the free contacts. Each block of the thread pool is swept by itself, so that
/// the blocks can be swept at once. The number of blocks does not depend on the number of threads.
template <int D>
class Iteration {
 public:
  Iteration(ContactGraph<D>& graph, ActiveSetFactor<D>& factor)
      : graph_(graph),
        factor_(factor),
        y_(graph.bodies() * D),
        y_direction_(graph.bodies() * D),
        gradient_(graph.count()),
        direction_(graph.count()),
        half_swept_(graph.count()),
        swept_(graph.count()) {
    refresh();
  }

  /// Computes the gradient from z itself, which removes the rounding errors of many updates.
  void refresh() {
    graph_.to_bodies(graph_.z, y_);
    statistics_ = graph_.pool().template sum_of_blocks<PassStatistics>(
        graph_.count(), [&](std::size_t begin, std::size_t end) {
          PassStatistics statistics;
          for (std::size_t c = begin; c < end; ++c) {
            gradient_[c] = graph_.linear_term[c] + graph_.to_contact(c, y_.data()) +
                           regularisation_ * graph_.z[c];
            add(gradient_[c], graph_.z[c] - graph_.bound[c], graph_.per_allowed[c], 1 / step_,
                statistics);
          }
          return statistics;
        });
    restart_ = true;
  }

  double residual() const { return statistics_.residual; }

  void drop_regularisation() {
    regularisation_ = 0;
    refresh();
  }

  /// Makes a factor of W between the contacts that are free now the preconditioner. Returns false
  /// if the factor would have too many entries or cannot be computed.
  bool factorise() {
    std::vector<char> active(graph_.count());
    for (std::size_t c = 0; c < graph_.count(); ++c) active[c] = graph_.is_free(c) ? 1 : 0;
    restart_ = true;
    return factor_.factorise(graph_, active);
  }

  /// Number of steps since the set of free contacts last changed.
  int steps_between_same() const { return steps_between_same_; }

  /// Makes one step. Returns the number of products with W that it took.
  int step() {
    if (statistics_.chopped_square > statistics_.free_slope) return leave_bounds();
    if (restart_) start_directions();
    before_ = graph_.z;
    ++steps_between_same_;
    // Where contacts contradict each other, the objective falls almost without end along the
    // direction.
    constexpr double kEndless = 1e12;
    const double length = slope_ / curvature_;
    if (!(length < kEndless)) return go_to_bound();
    move_and_half_sweep(length);
    if (statistics_.distance_to_bound < 0) return expand(length);
    // The next direction is conjugate to this one.
    const double slope = precondition();
    const double beta = slope / slope_;
    slope_ = slope;
    combine_directions(beta);
    return 1;
  }

 private:
  /// This function has no branches, because which contacts are free is irregular in a packing and a
  /// processor could not predict them.
  static void add(double g, double distance_to_bound, double per_allowed, double per_step,
                  PassStatistics& statistics) {
    statistics.residual =
        std::max(statistics.residual, per_allowed * std::abs(std::min(g, distance_to_bound)));
    const bool is_free = distance_to_bound > 0;
    const double phi = is_free ? g : 0.0;
    statistics.free_slope += phi * std::min(g, distance_to_bound * per_step);
    const double beta = is_free ? 0.0 : std::min(g, 0.0);
    statistics.chopped_square += beta * beta;
    statistics.distance_to_bound = std::min(statistics.distance_to_bound, distance_to_bound);
  }

  /// Returns the objective z^T W z/2 + b^T z, W with the regularisation.
  double objective() {
    return graph_.pool().template sum_of_blocks<double>(
        graph_.count(), [&](std::size_t begin, std::size_t end) {
          return (part(graph_.z, begin, end) *
                  (part(gradient_, begin, end) + part(graph_.linear_term, begin, end)))
                     .sum() /
                 2;
        });
  }

  void start_directions() {
    std::fill(direction_.begin(), direction_.end(), 0.0);
    std::fill(y_direction_.begin(), y_direction_.end(), 0.0);
    curvature_ = 0;
    if (!factor_.exists()) half_sweep();
    restart_ = false;
    steps_between_same_ = 0;
    slope_ = precondition();
    combine_directions(0);
  }

  /// Sets direction = swept + beta * direction, and computes its displacements and its curvature.
  void combine_directions(double beta) {
    const double square = graph_.pool().template sum_of_blocks<double>(
        graph_.count(), [&](std::size_t begin, std::size_t end) {
          auto direction = part(direction_, begin, end);
          direction = part(swept_, begin, end) + beta * direction;
          return direction.square().sum();
        });
    curvature_ = graph_.combine(y_, beta, y_direction_) + regularisation_ * square;
  }

  /// Sets half_swept = (I + L)^-1 gradient, L the strictly lower triangle of W between the free
  /// contacts of a block.
  void half_sweep() {
    graph_.pool().for_blocks(graph_.count(), [&](std::size_t begin, std::size_t end) {
      auto sums = graph_.block_bodies(begin);
      for (std::size_t c = begin; c < end; ++c) {
        half_swept_[c] =
            graph_.is_free(c) ? gradient_[c] - graph_.to_contact_in_block(c, sums.data()) : 0.0;
        graph_.add_in_block(c, half_swept_[c], sums.data());
      }
    });
  }

  /// Subtracts length * direction from z and updates the gradient and the statistics. half_sweep()
  /// is done in the same pass, because it reads the same rows. In three of four passes only the
  /// smallest distance to a bound is measured, because the other statistics can wait for a few
  /// steps.
  void move_and_half_sweep(double length) {
    constexpr int kPassesBetweenMeasurements = 4;
    const bool measure_residuals =
        restart_ || ++passes_since_measurement_ % kPassesBetweenMeasurements == 0;
    const auto pass = [&](auto measure_now, auto sweep) {
      return graph_.pool().template sum_of_blocks<PassStatistics>(
          graph_.count(), [&](std::size_t begin, std::size_t end) {
            const double* direction = direction_.data();
            const double* y_direction = y_direction_.data();
            const double* bound = graph_.bound.data();
            double* zs = graph_.z.data();
            double* gradient = gradient_.data();
            double* half_swept = half_swept_.data();
            const double per_step = 1 / step_;
            PassStatistics statistics;
            auto sums = decltype(sweep)::value ? graph_.block_bodies(begin) : std::vector<double>();
            for (std::size_t c = begin; c < end; ++c) {
              const double z = zs[c] - length * direction[c];
              const double g = gradient[c] - length * (graph_.to_contact(c, y_direction) +
                                                       regularisation_ * direction[c]);
              zs[c] = z;
              gradient[c] = g;
              const double distance_to_bound = z - bound[c];
              if constexpr (decltype(measure_now)::value)
                add(g, distance_to_bound, graph_.per_allowed[c], per_step, statistics);
              else
                statistics.distance_to_bound =
                    std::min(statistics.distance_to_bound, distance_to_bound);
              if constexpr (decltype(sweep)::value) {
                const double t =
                    distance_to_bound > 0 ? g - graph_.to_contact_in_block(c, sums.data()) : 0.0;
                half_swept[c] = t;
                graph_.add_in_block(c, t, sums.data());
              }
            }
            return statistics;
          });
    };
    constexpr std::true_type kYes;
    constexpr std::false_type kNo;
    if (factor_.exists())
      statistics_ = pass(kYes, kNo);
    else if (measure_residuals)
      statistics_ = pass(kYes, kYes);
    else
      statistics_.distance_to_bound = pass(kNo, kYes).distance_to_bound;
  }

  /// Sets swept to the preconditioner times the gradient, and y = B swept. Returns swept.gradient.
  double precondition() {
    const double product =
        factor_.exists() ? factor_.precondition(graph_, gradient_, swept_) : sweep_back();
    if (factor_.exists() || graph_.count() > ThreadPool::kBlock) graph_.to_bodies(swept_, y_);
    return product;
  }

  /// The backward half of the sweep: swept = (I + L^T)^-1 half_swept. Returns swept.gradient.
  double sweep_back() {
    return graph_.pool().template sum_of_blocks<double>(graph_.count(), [&](std::size_t begin,
                                                                            std::size_t end) {
      double product = 0;
      auto sums = graph_.block_bodies(begin);
      for (std::size_t c = end; c-- > begin;) {
        const double s =
            graph_.is_free(c) ? half_swept_[c] - graph_.to_contact_in_block(c, sums.data()) : 0.0;
        swept_[c] = s;
        product += s * gradient_[c];
        graph_.add_in_block(c, s, sums.data());
      }
      if (graph_.count() <= ThreadPool::kBlock) std::swap(y_, sums);  // B swept is known already
      return product;
    });
  }

  /// Handles a step of this length that left the bounds. Keeps all of it, projected on the bounds,
  /// if the objective falls; otherwise goes to the first bound.
  int expand(double length) {
    // Objective before the step, from the present value: the objective is quadratic along the
    // direction.
    const double before = objective() + length * (slope_ - length * curvature_ / 2);
    cut();
    return objective() < before ? 1 : 2 + go_to_bound();
  }

  /// Goes from the point before the step to the first bound along the direction, if there is a
  /// bound, and makes a projected gradient step from there. The objective falls in both.
  int go_to_bound() {
    double feasible = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < graph_.count(); ++c)
      if (direction_[c] > 0)
        feasible = std::min(feasible, (before_[c] - graph_.bound[c]) / direction_[c]);
    for (std::size_t c = 0; c < graph_.count(); ++c)
      graph_.z[c] = std::isfinite(feasible) ? before_[c] - feasible * direction_[c] : before_[c];
    cut();
    return 1 + project_gradient();
  }

  /// Makes a projected gradient step, so short that the objective does not rise.
  int project_gradient() {
    const auto here = graph_.z;
    const double before = objective();
    for (int products = 1;; ++products) {
      graph_.pool().for_blocks(graph_.count(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
          if (graph_.is_free(c))
            graph_.z[c] = std::max(graph_.bound[c], graph_.z[c] - step_ * gradient_[c]);
      });
      refresh();
      // Below this step length the change of the objective is a rounding error.
      constexpr double kShortest = 1e-6;
      if (objective() <= before || step_ < kShortest) return products;
      // The largest eigenvalue of W belongs to a particle with many contacts and may exceed 4.
      step_ /= 2;
      graph_.z = here;
      refresh();
    }
  }

  /// Projects z on the bounds.
  void cut() {
    graph_.pool().for_blocks(graph_.count(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c)
        graph_.z[c] = std::max(graph_.z[c], graph_.bound[c]);
    });
    refresh();
  }

  /// Makes the best step along the chopped gradient, which moves contacts away from their bounds.
  int leave_bounds() {
    for (std::size_t c = 0; c < graph_.count(); ++c)
      direction_[c] = !graph_.is_free(c) && gradient_[c] < 0 ? gradient_[c] : 0.0;
    const double curvature = graph_.to_bodies(direction_, y_direction_);
    // Largest step length, where the length 1 is right for a single contact (W = 1). Contacts that
    // contradict each other would make the length infinite.
    constexpr double kLongest = 1e6;
    restart_ = true;
    move_and_half_sweep(std::min(statistics_.chopped_square / curvature, kLongest));
    return 1;
  }

  ContactGraph<D>& graph_;
  ActiveSetFactor<D>& factor_;
  /// Length of a projected gradient step. W has the diagonal 1, and in packings of similar
  /// particles all its eigenvalues are at most 4.
  double step_ = 0.5;
  std::vector<double> before_;           // z before the step
  std::vector<double> y_, y_direction_;  // displacements B z of bodies [L]
  std::vector<double> gradient_, direction_, half_swept_, swept_;
  PassStatistics statistics_;
  double regularisation_ = kRegularisation;
  double slope_ = 0;      // gradient.direction
  double curvature_ = 0;  // direction^T W direction
  bool restart_ = true;
  int steps_between_same_ = 0;
  unsigned passes_since_measurement_ = 0;
};

}  // namespace

template <int D>
SolverResult conjugate_gradients(ContactGraph<D>& graph, int max_iterations,
                                 ActiveSetFactor<D>& factor) {
  Iteration<D> iteration(graph, factor);
  SolverResult solved;
  // A factor pays if many iterations with the same free contacts have not converged. While the set
  // of free contacts changes, the factor would soon be out of date. A rough solution, the first
  // part of a step, changes the set often and seldom needs a factor. If a factor exists, a few
  // iterations without convergence show that it belongs to other contacts than are free now. Box2d
  // with 1000 discs took 9.97e9 instructions with the values 30 (rough), 30 (accurate) and 10 (with
  // a factor), and 9.23e9 with 30, 10 and 10. The first value matters little: 30 and 60 take the same
  // number of iterations to 1 %.
  constexpr int kPatienceWithFactor = 10;
  const int patience_without = graph.is_rough ? 40 : 10;
  // Newton's method finishes in a few iterations where contacts form almost no cycles (chains,
  // columns). There it comes first, unless the guess is already exact, because small residuals
  // leave large errors in a long chain. In packings Newton's method may cycle, so that it is tried
  // only after many iterations.
  constexpr int kLongPatience = 300, kNewtonIterations = 10;
  constexpr std::size_t kLongChain = 6;  // shorter chains take fewer sweeps than a factor costs
  const bool has_chains =
      graph.largest_island > kLongChain && graph.count() < graph.bodies() + graph.bodies() / 8;
  // A guess with a residual of at most this fraction of the allowed residual counts as exact.
  constexpr double kNearlySolved = 1e-4;
  if (has_chains && iteration.residual() > kNearlySolved) {
    solved = active_set_newton(graph, kNewtonIterations);
    if (solved.residual <= 1) return solved;
    iteration.refresh();
  }
  int next_newton = kLongPatience;
  bool fresh = true, factorisable = true;
  for (;;) {
    solved.residual = iteration.residual();
    if (solved.residual <= 1 || solved.iterations >= max_iterations) {
      if (fresh) return solved;
      iteration.refresh();  // the updated gradient has accumulated rounding errors
      fresh = true;
      continue;
    }
    if (solved.iterations >= next_newton) {
      const auto newton = active_set_newton(graph, kNewtonIterations);
      solved.iterations += newton.iterations;
      iteration.drop_regularisation();
      next_newton = std::max(kLongPatience, 2 * solved.iterations);
      fresh = true;
      continue;
    }
    const int patience = factor.exists() ? kPatienceWithFactor : patience_without;
    if (factorisable && iteration.steps_between_same() >= patience)
      factorisable = iteration.factorise();
    solved.iterations += iteration.step();
    fresh = false;
  }
}

template SolverResult conjugate_gradients<2>(ContactGraph<2>&, int, ActiveSetFactor<2>&);
template SolverResult conjugate_gradients<3>(ContactGraph<3>&, int, ActiveSetFactor<3>&);

}  // namespace viscontact::particles
