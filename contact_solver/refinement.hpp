// Iterative refinement of the impulses of a ConstraintProblem, and the error that is left in them.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <tuple>
#include <vector>

#include "viscontact/contact_solver/constraint_solver.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"

namespace viscontact::contact_solver {

/// Refines the impulses of a solved problem, and estimates their errors. A residual v of a row over
/// its mobility is the error of its impulse only if its neighbours bear nothing. In general the
/// errors dp obey W dp = v in the rows of closed contacts and links: the load of a light particle
/// that carries a heavy one is wrong by the mass of the heavy one times v/h. Newton's steps are
/// taken on the conditions of all blocks, with residuals in extended precision, because the motion
/// of a light particle is a small difference of large impulses. The last step is the error that is
/// left. If impulses are redundant, W is singular, and nothing is refined.
template <int D>
class Refinement {
 public:
  /// Refines `solution` and problem.impulses if the problem has at most kFew rows, is a tree of at
  /// most kMany, or has different masses and is a tree or has at most kMost. Nothing changes if the
  /// impulses are not unique, or a residual would rise above what is allowed. `problem` must
  /// outlive the object.
  Refinement(ConstraintProblem<D>& problem, ConstraintSolution<D>& solution);
  ~Refinement();

  /// True if the problem was refined, and has had no new rows since.
  bool is_done() const { return is_done_ && impulses_.size() == problem_.rows.size(); }
  /// Largest error of the impulses of block `b` [M L/T], with the rounding errors of offsets and
  /// free motions. Needs is_done(), as changes_by() does.
  double error(std::size_t b) const;
  /// The largest changes of impulses of all blocks [M L/T] if gaps and rows of links change by
  /// `shifts` [L].
  std::vector<double> changes_by(const std::vector<double>& shifts) const;
  /// Most rows of a problem that is always refined.
  static constexpr std::size_t kFew = 32;
  /// Most rows of a problem of similar masses that is refined: a factorisation of a larger one
  /// would take a large part of its step.
  static constexpr std::size_t kMany = 256;
  /// Most rows of a problem with loops and different masses. Sweeps and conjugate gradients need so
  /// many iterations for it that the factorisation takes less.
  static constexpr std::size_t kMost = 4000;
  /// Masses are different if the largest that a row feels is this factor above the smallest.
  static constexpr double kDifferent = 100;

 private:
  using Real = long double;
  using RealMotion = std::array<Real, std::tuple_size_v<Motion<D>>>;
  struct Product;
  struct Law;
  class Factor;

  bool is_worth_it() const;
  void find_products();
  // Computes motions and values from impulses_.
  void evaluate();
  void move(const std::vector<Real>& impulses);
  void find_values();
  // Moves the units by the rest of the error, which is too small to be added to the impulses.
  void move_by_rest();
  // True if the factor of the last laws is that of the present ones.
  bool find_laws();
  // Returns false if the matrix of the laws is singular.
  bool factorise();
  // The changes of the impulses of all rows that change the left sides of the laws by `right`.
  std::vector<double> solved(std::vector<double> right) const;
  // Takes Newton's steps until only rounding errors are left. Returns true if this succeeds.
  bool iterate();
  // Returns false, and changes nothing, if a residual would become larger than before and than
  // allowed.
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

}  // namespace viscontact::contact_solver
