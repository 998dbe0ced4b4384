// When to use conjugate gradients, a sparse factor or Newton's method for (5.4), docs/physics.md.
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/contact_solver/methods/active_set_newton.hpp"
#include "viscontact/contact_solver/methods/mprgp.hpp"
#include "viscontact/contact_solver/problem/mass_dual_problem.hpp"

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

struct DualTuning {
  // Iterations with the same free contacts after which a new factor is made, if there is one
  // already, for a rough solution, and for an accurate one. A rough solution changes the free
  // contacts often, so that a factor would soon be too old. 10 in place of 30 saves 7 % of the time
  // of bench/box2d.cpp.
  static constexpr int kPatienceWithFactor = 10, kPatienceOfRough = 40, kPatience = 10;
  // Newton's method is tried again after so many iterations in all, because in packings it may
  // fail, and takes at most so many of its own.
  static constexpr int kLongPatience = 300, kMostNewton = 10;
  // Bodies of a chain that sweeps solve in less time than a factor takes.
  static constexpr std::size_t kLongChain = 6;
  // Contacts form chains or columns, with almost no cycles, if they are not more than the bodies
  // by this part of them.
  static constexpr std::size_t kPartOfBodies = 8;
  // Residual of a guess over the allowed one with which Newton's method is not needed. It is small
  // because in a long chain even small residuals mean large errors of the impulses.
  static constexpr double kNearlySolved = 1e-4;
};

/// The state of a solution of a dual problem.
template <int D>
class DualLadder {
 public:
  DualLadder(MassDualProblem<D>& problem, int max_iterations, FreeSetFactor<D>& factor)
      : problem_(problem),
        most_(max_iterations),
        factor_(factor),
        mprgp_(problem, Preconditioner<D>(problem, factor)) {
    const bool has_chains =
        problem.largest_island > DualTuning::kLongChain &&
        problem.count() < problem.bodies() + problem.bodies() / DualTuning::kPartOfBodies;
    is_newton_first_ = has_chains && mprgp_.residual() > DualTuning::kNearlySolved;
  }

  SolverResult solve() {
    run_stages(kTable, *this);
    return result_;
  }

  bool is_done() {
    if (is_solved_by_newton_) return true;
    if (is_newton_first_) return false;
    if (!is_fresh_ && is_ended()) {
      mprgp_.refresh();  // the updated gradient has accumulated rounding errors
      is_fresh_ = true;
    }
    result_.residual = mprgp_.residual();
    return is_ended();
  }

 private:
  bool is_ended() const { return !(mprgp_.residual() > 1) || result_.iterations >= most_; }

  bool needs_newton() const { return is_newton_first_ || result_.iterations >= next_newton_; }
  bool needs_factor() const {
    const int patience = factor_.exists()    ? DualTuning::kPatienceWithFactor
                         : problem_.is_rough ? DualTuning::kPatienceOfRough
                                             : DualTuning::kPatience;
    return is_factorisable_ && !has_new_factor_ && mprgp_.steps_between_same() >= patience;
  }
  bool always() const { return true; }

  void take_newton(Stage stage) {
    FreeSetFactor<D> of_newton(0);
    const auto solved = active_set_newton(problem_, of_newton, DualTuning::kMostNewton);
    count(stage, solved.iterations);
    if (is_newton_first_) {
      is_newton_first_ = false;
      result_.residual = solved.residual;
      is_solved_by_newton_ = solved.residual <= 1;
      if (!is_solved_by_newton_) mprgp_.refresh();
      return;
    }
    mprgp_.drop_regularisation();
    next_newton_ = std::max(DualTuning::kLongPatience, 2 * result_.iterations);
    is_fresh_ = true;
  }
  void make_factor(Stage stage) {
    is_factorisable_ = mprgp_.factorise();
    has_new_factor_ = true;
    if (is_factorisable_) ++result_.stages[stage];
  }
  void take_gradient_step(Stage stage) {
    count(stage, mprgp_.step());
    is_fresh_ = has_new_factor_ = false;
  }
  void count(Stage stage, int iterations) {
    result_.iterations += iterations;
    result_.stages[stage] += iterations;
  }

  using Self = DualLadder<D>;
  // Each stage takes one step, and the table is read again.
  static constexpr std::array<StageRow<Self>, 3> kTable{{
      // First in chains and columns, with almost no cycles, because conjugate gradients take about
      // as many iterations as a chain has contacts: bench/columns.cpp needs 19 to 31 iterations for
      // 100 to 10 000 contacts. In packings only after many iterations.
      {Stage::kNewton, &Self::needs_newton, nullptr, &Self::take_newton, nullptr, nullptr},
      // After iterations with the same free contacts, unless a factor is too large.
      {Stage::kFactors, &Self::needs_factor, nullptr, &Self::make_factor, nullptr, nullptr},
      // With sweeps as the preconditioner until there is a factor.
      {Stage::kGradients, &Self::always, nullptr, &Self::take_gradient_step, nullptr, nullptr},
  }};

  MassDualProblem<D>& problem_;
  int most_;
  FreeSetFactor<D>& factor_;
  Mprgp<MassDualProblem<D>, Preconditioner<D>> mprgp_;
  SolverResult result_;
  int next_newton_ = DualTuning::kLongPatience;
  bool is_newton_first_ = false, is_solved_by_newton_ = false;
  bool is_fresh_ = true;  // no step since the gradient was computed anew
  bool is_factorisable_ = true, has_new_factor_ = false;
};

}  // namespace

template <int D>
SolverResult solve_dual_problem(MassDualProblem<D>& problem, int max_iterations,
                                FreeSetFactor<D>& factor) {
  return DualLadder<D>(problem, max_iterations, factor).solve();
}

template SolverResult solve_dual_problem<2>(MassDualProblem<2>&, int, FreeSetFactor<2>&);
template SolverResult solve_dual_problem<3>(MassDualProblem<3>&, int, FreeSetFactor<3>&);

}  // namespace viscontact::contact_solver
