// Iterative refinement of the impulses of a ConstraintProblem, and the error that is left in them.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <tuple>
#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/constraints/constraint_solver.hpp"

namespace viscontact::particles {

/// Refines the impulses of a solved problem, and estimates their errors. A residual v of a row over
/// the mobility of the row is the error of its impulse only if its neighbours bear nothing. In
/// general the errors dp of all impulses obey W dp = v in the rows of closed contacts and links:
/// the load of a light particle that carries a heavy one is wrong by the mass of the heavy one
/// times v/h. Refinement takes Newton's steps on the conditions of all blocks, which are linear as
/// long as each block stays in its branch (open, closed, sticking, sliding). Residuals are computed
/// in extended precision, because the motion of a light particle is a small difference of large
/// impulses. The last step is the error that is left.
///
/// If impulses are redundant, W is singular, and single impulses are not unique. Then nothing is
/// refined.
template <int D>
class Refinement {
 public:
  /// Refines `solution` and the impulses of `problem`, if this is worth its time: if the problem
  /// has at most kFew rows, or is a tree of at most kMany rows, or has units of different masses
  /// and is a tree or has at most kMost rows. Nothing changes if the impulses are not unique, or if
  /// the residual of a block would rise above what is allowed. `problem` must outlive the object.
  Refinement(ConstraintProblem<D>& problem, ConstraintSolution<D>& solution);
  ~Refinement();

  /// True if the problem was refined, and has had no new rows since.
  bool is_done() const { return is_done_ && impulses_.size() == problem_.rows.size(); }
  /// Estimate of the largest error of the impulses of block `b` [M L/T], > 0, with the effect of
  /// rounding errors of offsets and free motions. is_done() must be true.
  double error(std::size_t b) const;
  /// The largest changes of the impulses of all blocks [M L/T], >= 0, if the gap of each contact
  /// and all rows of each link change by `shifts` [L], one number for each of the first blocks.
  /// is_done() must be true.
  std::vector<double> changes_by(const std::vector<double>& shifts) const;
  /// Most rows of a problem that is always refined.
  static constexpr std::size_t kFew = 32;
  /// Most rows of a problem of similar masses that is refined. A factorisation of a larger one
  /// would take a large part of its step.
  static constexpr std::size_t kMany = 256;
  /// Most rows of a problem with loops and different masses that is refined. Sweeps and conjugate
  /// gradients need so many iterations for it that the factorisation takes less.
  static constexpr std::size_t kMost = 4000;
  /// Masses are called different if the largest mass that a row feels is this factor above the
  /// smallest one.
  static constexpr double kDifferent = 100;

 private:
  using Real = long double;
  using RealMotion = std::array<Real, std::tuple_size_v<Motion<D>>>;
  struct Product;
  struct Law;
  class Factor;

  bool is_worth_it() const;
  void find_products();
  void evaluate();
  void move(const std::vector<Real>& impulses);
  void find_values();
  void move_by_rest();
  bool find_laws();
  bool factorise();
  std::vector<double> solved(std::vector<double> right) const;
  bool iterate();
  bool take_over(ConstraintSolution<D>& solution);
  std::vector<double> largest_of_blocks(const std::vector<double>& of_rows) const;

  ConstraintProblem<D>& problem_;
  std::vector<double> w_, roots_;  // mobilities of the rows, and their square roots
  std::vector<Product> products_;  // entries of W, in parts
  std::vector<Real> impulses_, values_;
  std::vector<RealMotion> motions_;
  std::vector<Law> laws_;  // of all blocks
  std::unique_ptr<Factor> factor_;
  std::vector<double> last_, errors_;
  bool is_done_ = false;
};

}  // namespace viscontact::particles
