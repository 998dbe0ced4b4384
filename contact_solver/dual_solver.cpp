// When to use conjugate gradients, a sparse factor or Newton's method for (5.4), docs/physics.md.
#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/contact_solver/active_set_newton.hpp"
#include "viscontact/contact_solver/mass_dual_problem.hpp"
#include "viscontact/contact_solver/mprgp.hpp"

namespace viscontact::contact_solver {
namespace {

/// Approximates the inverse of W between the free contacts (z above its bound): by a sparse factor
/// if there is one, and otherwise by a sweep of symmetric Gauss-Seidel, (I + L^T)^-1 (I + L)^-1,
/// where L is the strictly lower triangle of W between the free contacts of a block. A block is a
/// part of the contacts, of fixed size, so that the result does not depend on the number of
/// threads.
template <int D>
class Preconditioner {
 public:
  /// Tells Mprgp that sweeps() may be true.
  static constexpr bool kMaySweep = true;

  Preconditioner(const MassDualProblem<D>& problem, FreeSetFactor<D>& factor)
      : problem_(problem), factor_(factor), half_swept_(problem.count()) {}

  /// True if there is no factor.
  bool sweeps() const { return !factor_.exists(); }

  /// For the contacts that are free now. Returns false, without a factor, if none pays or exists.
  bool factorise() {
    std::vector<char> free(problem_.count());
    for (std::size_t c = 0; c < problem_.count(); ++c) free[c] = problem_.is_free(c) ? 1 : 0;
    return factor_.factorise(problem_, free);
  }

  /// half_swept_ = (I + L)^-1 gradient, which each apply() needs.
  void sweep_forward(std::span<const double> gradient) {
    problem_.pool().for_blocks(problem_.count(), [&](std::size_t begin, std::size_t end) {
      auto y = problem_.block_bodies(begin);
      for (std::size_t c = begin; c < end; ++c)
        sweep_forward(c, gradient[c], problem_.is_free(c), y.data());
    });
  }

  /// The same for contact `c`. `y` [L] has what contacts of its block before it cause, and gets its
  /// own.
  void sweep_forward(std::size_t c, double gradient, bool is_free, double* y) {
    const double t = is_free ? gradient - problem_.to_contact_in_block(c, y) : 0.0;
    half_swept_[c] = t;
    problem_.add_in_block(c, t, y);
  }

  /// Sets `swept` to the preconditioned gradient and `y` to B swept, with the matrix B from z to
  /// the displacements of bodies. Returns the inner product of `swept` and the gradient.
  double apply(std::span<const double> gradient, std::vector<double>& swept,
               std::vector<double>& y) const {
    const double product =
        sweeps() ? sweep_back(gradient, swept, y) : factor_.precondition(problem_, gradient, swept);
    if (!sweeps() || problem_.count() > ThreadPool::kBlock) problem_.to_bodies(swept, y);
    return product;
  }

 private:
  /// swept = (I + L^T)^-1 half_swept_; with a single block also `y` = B swept. Returns as apply().
  double sweep_back(std::span<const double> gradient, std::vector<double>& swept,
                    std::vector<double>& y) const {
    return problem_.pool().template sum_of_blocks<double>(
        problem_.count(), [&](std::size_t begin, std::size_t end) {
          double product = 0;
          auto sums = problem_.block_bodies(begin);
          for (std::size_t c = end; c-- > begin;) {
            const double s = problem_.is_free(c)
                                 ? half_swept_[c] - problem_.to_contact_in_block(c, sums.data())
                                 : 0.0;
            swept[c] = s;
            product += s * gradient[c];
            problem_.add_in_block(c, s, sums.data());
          }
          if (problem_.count() <= ThreadPool::kBlock) std::swap(y, sums);
          return product;
        });
  }

  const MassDualProblem<D>& problem_;
  FreeSetFactor<D>& factor_;
  std::vector<double> half_swept_;
};

}  // namespace

template <int D>
SolverResult solve_dual_problem(MassDualProblem<D>& problem, int max_iterations,
                                FreeSetFactor<D>& factor) {
  Mprgp mprgp(problem, Preconditioner<D>(problem, factor));
  SolverResult solved;
  // After so many iterations with the same free contacts, a new factor is made. A rough solution
  // changes them often, so that a factor would soon be too old. For an accurate one, 10 in place of
  // 30 saves 7 % of the time on bench/box2d.cpp.
  constexpr int kPatienceWithFactor = 10;
  const int patience_without = problem.is_rough ? 40 : 10;
  // Where contacts form chains or columns, with almost no cycles, Newton's method comes first,
  // because conjugate gradients take about as many iterations as a chain has contacts. In packings
  // it may fail, so that it is tried only after many iterations.
  constexpr int kLongPatience = 300, kNewtonIterations = 10;
  // Sweeps solve chains of up to kLongChain bodies in less time than a factor takes.
  constexpr std::size_t kLongChain = 6;
  const bool has_chains = problem.largest_island > kLongChain &&
                          problem.count() < problem.bodies() + problem.bodies() / 8;
  // If the residual of the guess is at most this fraction of the allowed one, Newton's method is
  // not needed. The fraction is small, because in a long chain even small residuals mean large
  // errors of the impulses.
  constexpr double kNearlySolved = 1e-4;
  const auto newton = [&] {
    FreeSetFactor<D> of_newton(0);
    return active_set_newton(problem, of_newton, kNewtonIterations);
  };
  if (has_chains && mprgp.residual() > kNearlySolved) {
    solved = newton();
    if (solved.residual <= 1) return solved;
    mprgp.refresh();
  }
  int next_newton = kLongPatience;
  bool fresh = true, factorisable = true;
  for (;;) {
    solved.residual = mprgp.residual();
    if (!(solved.residual > 1) || solved.iterations >= max_iterations) {
      if (fresh) return solved;
      mprgp.refresh();  // the updated gradient has accumulated rounding errors
      fresh = true;
    } else if (solved.iterations >= next_newton) {
      solved.iterations += newton().iterations;
      mprgp.drop_regularisation();
      next_newton = std::max(kLongPatience, 2 * solved.iterations);
      fresh = true;
    } else {
      const int patience = factor.exists() ? kPatienceWithFactor : patience_without;
      if (factorisable && mprgp.steps_between_same() >= patience) factorisable = mprgp.factorise();
      solved.iterations += mprgp.step();
      fresh = false;
    }
  }
}

template SolverResult solve_dual_problem<2>(MassDualProblem<2>&, int, FreeSetFactor<2>&);
template SolverResult solve_dual_problem<3>(MassDualProblem<3>&, int, FreeSetFactor<3>&);

}  // namespace viscontact::contact_solver
