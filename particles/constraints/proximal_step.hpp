// One step of the proximal method for the constraints of a time step, by Newton's method
// (constraint_problem.hpp). Lengths, masses and times are in the units of the case.
// constraint_solver.cpp uses it; a step that fails is no error.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "viscontact/particles/constraints/block_factor.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// From impulses P^k, a step of the proximal method (Rockafellar 1976) finds the motions y and the
/// impulses P^{k+1} of docs/physics.md (5.8):
///
///     M/h (y - y*) = J^T P^{k+1},   P^{k+1} = proj(P^k - rho (b + J y)),
///     rho_r = 1/(epsilon W_rr),
///
/// where b + J y are the gaps and h times the slips, W_rr is the mobility of row r, and proj
/// projects on the allowed impulses: first the normal one on p_n >= lowest, then the tangential one
/// on |p_t| <= mu_s p_s with p_s from p_n, so that Coulomb's law holds at the fixed point. For the
/// convex relaxation (5.9) proj projects on the cone of both, and y is then the minimum of a convex
/// function, along which the length of a step is searched. The smaller epsilon is, the nearer
/// P^{k+1} is to the solution, and the harder the equation is to solve; redundant contacts do no
/// harm.
///
/// Newton's method has a block of its matrix for each unit and two for each pair of units in one
/// block of constraints (Alart & Curnier 1991, "A mixed formulation for frictional contact problems
/// prone to Newton like solution methods"). As long as no contact opens, closes, sticks or slips,
/// the factors of the iteration before serve again.
///
/// In the plane the equation is linear between changes of branches. Where no step along the
/// direction of Newton's method makes the error smaller, solve() follows the path on which the
/// error is a multiple of that at its start, from branch to branch, also where it turns back
/// (Katzenelson 1965, "An algorithm for solving nonlinear resistor networks"; Chien & Kuh 1976,
/// "Solving piecewise-linear equations for resistive networks"). Coulomb's law of jammed particles
/// has such turns.
template <int D>
class ProximalStep {
 public:
  /// All arguments must outlive this object; `w` are the row_mobilities() of the problem, W_rr.
  /// `matrix` is its matrix, which is symmetric only if the problem is convex, and which nobody else
  /// changes from now on, because its factors are used again.
  ProximalStep(const ConstraintProblem<D>& problem, const std::vector<double>& w,
               UnitMatrix<D>& matrix);

  /// Sets the numbers epsilon of the gaps and bilateral rows, and of the slips, > 0. One of these
  /// functions must be called before solve().
  void set_epsilon(double of_gaps, double of_slips);
  void set_epsilon(double epsilon) { set_epsilon(epsilon, epsilon); }  ///< the same for all rows

  /// Solves from the impulses P^k = `center` and the motions `start`. Returns the number of
  /// factorisations and solutions with factors. Sets failed() if it found no solution.
  int solve(const std::vector<double>& center, const std::vector<Motion<D>>& start,
            int max_iterations);

  /// True if the last solve() found no solution.
  bool failed() const { return failed_; }
  /// True if the last solve() followed a path, because Newton's method made no progress.
  bool followed_path() const { return paths_ > 0; }
  /// Impulses of the rows that the last solve() found [M L/T].
  const std::vector<double>& impulses() const { return projected_; }
  /// Motions of the units that the last solve() found [L], [rad].
  const std::vector<Motion<D>>& motions() const { return y_; }

 private:
  // Each crossing costs a solution with factors, and makes the next ones a little more expensive.
  static constexpr int kMostCrossings = 30;
  // Which branch of the projection each part of a block is in. The matrix depends on it.
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
  // Where a block leaves its branch, as a multiple of the direction, and its next branch.
  struct Exit {
    double length = std::numeric_limits<double>::infinity();
    Branch branch;
  };
  std::array<double, 4> derivatives(std::size_t b, Branch branch) const;
  Crossing crossing_to(std::size_t b, Branch branch) const;
  double product(const Crossing& crossing, std::span<const Motion<D>> motions) const;
  Exit exit_of(std::size_t b, double sign) const;
  // Follows the path, through at most kMostCrossings changes of branches, whose number it adds to
  // `iterations`. Returns the largest share of the error that was removed on it, and leaves y_
  // there.
  double follow_path(int& iterations);
  void move(double length, std::span<const Motion<D>> direction);
  void find_direction();
  double length_to_minimum();
  double rounding_error() const;
  double length_of_step(double before);

  const ConstraintProblem<D>& problem_;
  const std::vector<double>& w_;
  std::vector<double> rho_, center_;      // center_: P^k
  std::vector<double> values_, changes_;  // b + J y of the rows, and J of the direction
  std::vector<double> projected_;         // P^{k+1}
  std::vector<Branch> branches_, factored_;
  std::vector<Motion<D>> y_, direction_, error_;
  UnitMatrix<D>& matrix_;
  bool has_factor_ = false, failed_ = false;
  int paths_ = 0;  // in the last solve()
};

}  // namespace viscontact::particles
