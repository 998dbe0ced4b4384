// One step of the proximal method for the impulses of the contacts with friction, and of the links,
// of a time step. Newton's method computes it. The problem is a ConstraintProblem
// (constraint_problem.hpp): a unit is a particle or a rigid body, a block is a contact or a link, a
// row is a gap, a slip or the left side of a link's equation. Lengths [L], masses [M] and times [T]
// are in any consistent units. Nothing is checked or thrown. A step is unsolved if failed() is
// true, and it may be unsolved if solve() returns its argument `max_iterations` or more.
// constraint_solver.cpp uses it. Another order of sums would change results by rounding errors.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "viscontact/particles/constraints/block_factor.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// From the impulses P^k of all rows, a step of the proximal method (Rockafellar 1976) finds the
/// motions y of the units and the impulses P^{k+1} of docs/physics.md (5.8):
///
///     M/h (y - y*) = J^T P^{k+1},   P^{k+1} = proj(P^k - rho (b + J y)),
///     rho_r = 1/(epsilon W_rr),
///
/// h is the length of the step [T], M/h are the masses and moments of inertia over h, y* the
/// motions without contacts and links [L, rad], b + J y the values of the rows [L, rad] with their
/// coefficients J. W_rr is the mobility of row r [T/M], epsilon a number > 0. proj projects on the
/// allowed impulses: first the normal impulse p_n on p_n >= lowest (ConstraintBlock::lowest), then
/// the tangential impulse p_t on |p_t| <= mu_s p_s, with the coefficient of friction mu_s and the
/// part p_s of p_n that the solids carry, or a given load in its place (5.17). Coulomb's law holds
/// if P^{k+1} = P^k. For the convex relaxation (5.9) proj projects (p_n, p_t) on the cone
/// |p_t| <= mu_s p_n. In convex problems y minimises a convex function, which decides the lengths
/// of Newton's steps. A smaller epsilon brings P^{k+1} nearer to the solution, but makes the
/// equation harder to solve.
///
/// The matrix of Newton's method (Alart & Curnier 1991, "A mixed formulation for frictional contact
/// problems prone to Newton like solution methods") is a UnitMatrix (block_factor.hpp). Its factors
/// are used again until a contact changes its branch, that is, opens, closes, begins to stick or
/// begins to slip. In convex problems of spheres they are also renewed after slow progress.
///
/// For discs the equation is linear as long as no contact changes its branch. If no step in the
/// direction of Newton's method reduces the error of the equation, solve() follows the path of
/// motions on which this error is a multiple of the error at the start of the path. It goes from
/// one change of a branch to the next, also where the multiple grows, which Coulomb's law permits
/// (Katzenelson 1965, "An algorithm for solving nonlinear resistor networks"; Chien & Kuh 1976,
/// "Solving piecewise-linear equations for resistive networks").
template <int D>
class ProximalStep {
 public:
  /// All arguments must outlive this object. `w` [T/M] has one number > 0 for each row, W_rr:
  /// row_mobilities(), or larger ones. `matrix` was made for this problem, with is_symmetric =
  /// ConstraintProblem::is_convex. If another object changes `matrix`, set_epsilon() must be called
  /// before the next solve(), because solve() would use the old factors again.
  ProximalStep(const ConstraintProblem<D>& problem, const std::vector<double>& w,
               UnitMatrix<D>& matrix);

  /// Sets the epsilon of gaps and links, and that of slips [1], both > 0. It must be called before
  /// the first solve().
  void set_epsilon(double of_gaps, double of_slips);
  void set_epsilon(double epsilon) { set_epsilon(epsilon, epsilon); }  ///< sets that of all rows

  /// Computes the step from the impulses P^k = `center` [M L/T], one for each row, with the motions
  /// `start` [L, rad], one for each unit, as the first guess of y. Returns the number of
  /// factorisations plus that of solutions with factors. If this is `max_iterations` or more, the
  /// step may be unsolved.
  int solve(const std::vector<double>& center, const std::vector<Motion<D>>& start,
            int max_iterations);

  /// True if the last solve() gave up, because a matrix was singular or no step reduced the error.
  bool failed() const { return failed_; }
  /// True if the last solve() followed a path. It does so if no step of Newton's method reduces the
  /// error.
  bool followed_path() const { return paths_ > 0; }
  /// The impulses P^{k+1} [M L/T] that the last solve() found, one for each row; also if it failed.
  const std::vector<double>& impulses() const { return projected_; }

 private:
  // Largest number of changes of branches on a path. Each one needs a solution with factors, and
  // makes the next ones more expensive. The value is a free choice.
  static constexpr int kMostCrossings = 30;
  // The branch of the projection in which a block is. It says whether a contact is closed, and
  // whether it has no friction, sticks, or slips with friction > 0 (kSlips) or < 0 (kSlipsBack) in
  // the first tangential row. A link is always closed and sticks.
  enum class Friction : unsigned char { kNone, kSticks, kSlips, kSlipsBack };
  struct Branch {
    bool is_closed = false;
    Friction friction = Friction::kNone;
    bool operator==(const Branch&) const = default;
  };

  void unprojected(std::size_t b, double t, double* q) const;
  Branch project(std::size_t b, const double* q, double* p) const;
  Branch project_on_cone(std::size_t b, const double* q, double* p) const;
  double error_at(double t, bool is_kept);
  bool factorise();
  void add_block(std::size_t b);
  struct Crossing;
  // Where a block leaves its branch, as a multiple of direction_, and its next branch.
  struct Exit {
    double length = std::numeric_limits<double>::infinity();
    Branch branch;
  };
  std::array<double, 4> derivatives(std::size_t b, Branch branch) const;
  Crossing crossing_to(std::size_t b, Branch branch) const;
  double product(const Crossing& crossing, std::span<const Motion<D>> motions) const;
  Exit exit_of(std::size_t b, double sign) const;
  // Follows the path from y_ through at most kMostCrossings changes of branches, and adds their
  // number to `iterations`. Moves y_ to the point with the least error on it. Returns the share of
  // the error at the start that is removed there, 0 to 1.
  double follow_path(int& iterations);
  void move(double length, std::span<const Motion<D>> direction);
  void find_direction();
  double length_to_minimum();
  double rounding_error() const;
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
  int paths_ = 0;  // number of paths that the last solve() has followed
};

}  // namespace viscontact::particles
