// One step of the proximal method for a ConstraintProblem, docs/physics.md (5.8), by Newton's
// method.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "viscontact/contact_solver/methods/block_factor.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"

namespace viscontact::contact_solver {

/// From the impulses P^k of all rows, a step of the proximal method (Rockafellar 1976) finds the
/// motions y of the units and the impulses P^{k+1} of docs/physics.md (5.8):
///
///     M/h (y - y*) = J^T P^{k+1},   P^{k+1} = proj(P^k - rho (b + J y)),
///     rho_r = 1/(epsilon W_rr),
///
/// Here h [T] is the length of the step, M/h are masses and moments of inertia over h, y* the
/// motions without contacts and links [L, rad], b + J y the values of the rows, W_rr is the
/// mobility of row r [T/M] and epsilon a number > 0. proj projects first the normal impulse p_n on
/// p_n >= lowest (ConstraintBlock::lowest), then the tangential impulse p_t on |p_t| <= mu_s p_s,
/// with the coefficient of friction mu_s and the part p_s of p_n that the solids carry, or a given
/// load in its place (5.17). Coulomb's law holds if P^{k+1} = P^k. For the convex relaxation (5.9)
/// proj projects (p_n, p_t) on the cone |p_t| <= mu_s p_n. In convex problems y minimises a convex
/// function, which decides the lengths of Newton's steps. A smaller epsilon brings P^{k+1} nearer
/// to the solution, but makes the equation harder to solve.
///
/// The matrix of Newton's method (Alart & Curnier 1991, "A mixed formulation for frictional contact
/// problems prone to Newton like solution methods") is a UnitMatrix. Its factors are used again
/// until a contact changes its branch, that is, opens, closes, begins to stick or to slip. In
/// convex problems of spheres they are also renewed after slow progress.
///
/// For discs the equation is linear as long as no contact changes its branch. If no step of
/// Newton's method reduces the error, solve() follows the path of motions on which the error is a
/// multiple of that at the start, from one change of a branch to the next, also where the multiple
/// grows, which Coulomb's law permits (Katzenelson 1965, "An algorithm for solving nonlinear
/// resistor networks"; Chien & Kuh 1976, "Solving piecewise-linear equations for resistive
/// networks").
template <int D>
class ProximalStep {
 public:
  /// All arguments must outlive this object. `w` has row_mobilities() or more, > 0 [T/M]. `matrix`
  /// was made for this problem, with is_symmetric = ConstraintProblem::is_convex. If another object
  /// changes it, set_epsilon() must be called before the next solve(), which would use old factors
  /// again.
  ProximalStep(const ConstraintProblem<D>& problem, const std::vector<double>& w,
               UnitMatrix<D>& matrix);

  /// Sets the epsilon of gaps and links, and that of slips [1], both > 0, before the first solve().
  void set_epsilon(double of_gaps, double of_slips);
  void set_epsilon(double epsilon) { set_epsilon(epsilon, epsilon); }

  /// Computes the step from P^k = `center` [M L/T] with the motions `start` [L, rad] as the first
  /// guess of y. Returns the number of factorisations plus that of solutions with factors. If this
  /// is `max_iterations` or more, the step may be unsolved.
  int solve(const std::vector<double>& center, const std::vector<Motion<D>>& start,
            int max_iterations);

  /// True if the last solve() gave up, because a matrix was singular or no step reduced the error.
  bool failed() const { return failed_; }
  /// True if the last solve() followed a path.
  bool followed_path() const { return paths_ > 0; }
  /// The iterations of the last solve() that were changes of branches on paths.
  int path_iterations() const { return path_iterations_; }
  /// P^{k+1} [M L/T] of the last solve(), also if it failed.
  const std::vector<double>& impulses() const { return projected_; }

 private:
  // Largest number of changes of branches on a path. Each one needs a solution with factors, and
  // makes the next ones more expensive.
  static constexpr int kMostCrossings = 30;
  // The branch of the projection in which a block is. A contact with friction slips with a positive
  // (kSlips) or negative (kSlipsBack) friction in the first tangential row. A link is closed and
  // sticks.
  enum class Friction : unsigned char { kNone, kSticks, kSlips, kSlipsBack };
  struct Branch {
    bool is_closed = false;
    Friction friction = Friction::kNone;
    bool operator==(const Branch&) const = default;
  };

  // Sets `q`, for the rows of block `b`, to P^k - rho (b + J y) at y = y_ + t direction_ [M L/T].
  void unprojected(std::size_t b, double t, double* q) const;
  // Sets `p` to the projection of `q` on the allowed impulses, P^{k+1} of block `b`, and returns
  // its branch.
  Branch project(std::size_t b, const double* q, double* p) const;
  Branch project_on_cone(std::size_t b, const double* q, double* p) const;
  // Sets error_ after a step of length `t` [1] along direction_, and returns its norm by the
  // inverse of M/h. With `is_kept`, also sets projected_ and branches_.
  double error_at(double t, bool is_kept);
  // Returns false if the matrix of the present branches is singular.
  bool factorise();
  // Adds J^T (-dP^{k+1}/dy), the derivative of the impulses of block `b`, to the matrix.
  void add_block(std::size_t b);
  struct Crossing;
  // Where a block leaves its branch, as a multiple of direction_, and its next branch.
  struct Exit {
    double length = std::numeric_limits<double>::infinity();
    Branch branch;
  };
  // Derivatives of the impulses (p_n, p_t) of contact `b` by the unprojected ones [1], row by row.
  std::array<double, 4> derivatives(std::size_t b, Branch branch) const;
  // `branch` must not be the present branch of block `b`.
  Crossing crossing_to(std::size_t b, Branch branch) const;
  // The row of a crossing, row J, times motions [M L/T].
  double product(const Crossing& crossing, std::span<const Motion<D>> motions) const;
  // Where block `b` leaves its branch in the direction `sign` (1 or -1) times direction_.
  Exit exit_of(std::size_t b, double sign) const;
  // Follows the path from y_, and adds the number of changes of branches to `iterations`. Moves y_
  // to the point with the least error. Returns the share of the error at the start that is removed
  // there, 0 to 1.
  double follow_path(int& iterations);
  // `changes_` must belong to `direction`.
  void move(double length, std::span<const Motion<D>> direction);
  // Sets direction_ to the step of Newton's method for error_, and changes_ to J times it.
  void find_direction();
  // The length [1], in (0, 1], of a step in a convex problem: near the minimum of the convex
  // function whose gradient is -error_.
  double length_to_minimum();
  // The size of the rounding errors in the result of error_at().
  double rounding_error() const;
  // The length [1] after which the error is below `before`, or 0 if none was found.
  double length_of_step(double before);

  const ConstraintProblem<D>& problem_;
  const std::vector<double>& w_;
  std::vector<double> rho_, center_;         // rho_r [M/T]; P^k
  std::vector<double> values_, changes_;     // b + J y_, and J direction_
  std::vector<double> projected_;            // P^{k+1}
  std::vector<Branch> branches_, factored_;  // branches of all blocks: now, and in the factors
  // y_: motions y; direction_: the step of Newton's method; error_: J^T P^{k+1} - M/h (y - y*).
  std::vector<Motion<D>> y_, direction_, error_;
  UnitMatrix<D>& matrix_;
  bool has_factor_ = false, failed_ = false;
  int paths_ = 0, path_iterations_ = 0;  // of the last solve()
};

}  // namespace viscontact::contact_solver
