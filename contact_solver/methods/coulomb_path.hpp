// Impulses with Coulomb's law by a path of smoothed problems, docs/physics.md (5.20), whose end is
// the solution of a ConstraintProblem.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/contact_solver/methods/block_factor.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"

namespace viscontact::contact_solver {

/// The conditions of each contact are products that must be 0. The first is u r, with its gap u and
/// the part r of its normal impulse above the lowest allowed value. The second is the load of its
/// solids times the impulse that its film can still absorb. The third is the product (bound, p) o
/// (z, v) of two points of a cone (cone.hpp): p is the friction, its bound mu_s times this load
/// with the coefficient of friction mu_s, and z is a bound of the slip v. On the path each product
/// is a constant times the same positive number tau instead, and the error of each linear equation
/// is another constant times tau. These constants make the path start where all gaps and impulses
/// are large. At the solution tau is 0. The path depends neither on the order of the contacts nor
/// on the guess of the impulses.
///
/// Coulomb's law is not the condition of a minimum, so that tau grows between two folds of the
/// path, where the determinant of the equations is negative. A step follows the path by a
/// polynomial of second order. It takes one factorisation of a UnitMatrix, and ends before the
/// products leave an interval around their values on the path. The next step begins with a
/// correction at right angles to the path, so that steps also pass folds (Keller 1977, "Numerical
/// solution of bifurcation and nonlinear eigenvalue problems"). A step whose end cannot be
/// corrected is taken again with a smaller length.
template <int D>
class CoulombPath {
 public:
  /// All arguments must outlive this object. `w` has row_mobilities() or more, > 0 [T/M]. `matrix`
  /// is not symmetric; follow() overwrites it. All contacts with friction must have
  /// FrictionBound::kCoulomb. Films with an infinite capacity leave no friction.
  CoulombPath(const ConstraintProblem<D>& problem, const std::vector<double>& w,
              UnitMatrix<D>& matrix);

  /// Paths smooth the bound of the friction differently. Mostly the first one
  /// suffices.
  static constexpr int kPaths = 3;

  /// Follows a path until reached() is at most `accuracy` [1], in (0, 1). Stops earlier if the path
  /// is lost, if only rounding errors are left, or after `max_iterations` factorisations. Returns
  /// their number, 0 if there is no contact or no violation at the start.
  int follow(int number, double accuracy, int max_iterations);

  /// The root of the least tau over that at the start [1]: a measure of the violations that are
  /// left. It is 0 without any at the start, 1 without contacts, and NaN if a number is NaN.
  double reached() const { return size_ == 0 ? 0 : std::sqrt(best_.tau) / size_; }
  /// The impulses [M L/T] at the point with the least tau.
  const std::vector<double>& impulses() const { return impulses_; }

 private:
  static constexpr std::size_t kMotion = static_cast<std::size_t>(D + kTurns<D>);
  static constexpr std::size_t kTangents = static_cast<std::size_t>(D - 1);
  using Tangent = std::array<double, kTangents>;
  // Values of rows are multiplied by a scale, and impulses divided by it: 1/w^(1/2) with the
  // mobility w of the first row, or of the first tangential row. Both then have the unit L
  // (M/T)^(1/2), also that of numbers without a unit below. A Point has the unknowns of a contact
  // or a link's row.
  struct Point {
    double u = 0;      // gap
    double r = 0;      // normal impulse minus its lowest value; impulse of the row of a link
    double bound = 0;  // bound of the friction: mu_s times the load of the solids
    double spare = 0;  // mu_s times the impulse that the film can still absorb
    double z = 0;      // upper bound of the slip, with the product (bound, p) o (z, v) of cone.hpp
    Tangent p{};       // friction
    Tangent v{};       // slip
  };
  // All unknowns, or their changes: motions of the units [L, rad], points and tau [M L^2/T].
  struct State {
    std::vector<Motion<D>> y;
    std::vector<Point> points;
    double tau = 0;
  };
  // Its end is at + correction + length tangent + length^2 second.
  struct Step {
    State at, correction, tangent, second;
    double length = 0;  // length with which the step was taken [1]
  };
  struct Part {
    std::size_t block = 0, row = 0;
    bool is_equation = false;       // true: a row of a link
    bool rubs = false;              // true: a contact with friction
    double scale = 1, of_slip = 1;  // scale of the row, and of the tangential rows [(M/T)^(1/2)]
    double base = 0;                // impulse at which r is 0 [M L/T]
    double compliance = 0;          // compliance of a link divided by w [1]
    double bound_per_impulse = 0;   // change of (bound - spare) divided by the change of r [1]
    double error = 0;               // value of the row minus u; of a link value + compliance r
    Tangent slip_error{};           // values of the tangential rows minus v
    double error_per_tau = 0;       // error at the start divided by tau there [(T/M)^(1/2)/L]
    Tangent slip_error_per_tau{};   // slip_error at the start divided by tau there
    // The following members are set by factorise().
    double weight = 0;  // minus the derivative of the change of r by that of the row's value [1]
    // Inverse of the matrix that multiplies the change of p in the equation of the friction.
    std::array<double, kTangents * kTangents> inverse{};
    Tangent by_bound{};  // derivative of the change of p by that of the bound [1]
  };
  void set_parts();
  // At the start gaps, and impulses minus their lowest values, are equal to the largest scaled
  // violation, and there is no friction.
  void start();
  // Values are scaled, and without offsets.
  double value(const Part& part, std::span<const Motion<D>> y) const;
  Tangent slip(const Part& part, std::span<const Motion<D>> y) const;
  void measure();
  // Returns false if the matrix at state_ is singular.
  bool factorise();
  // Sets `changes` so that to first order errors of linear equations and products of (5.20)
  // decrease by `of_errors` [1] times themselves, and increase by `of_tau` [M L^2/T] times their
  // ratio to tau on the path. Products also decrease by those of the changes in `tangent`, if any.
  void find_changes(double of_errors, double of_tau, const State* tangent, State& changes);
  // The inner product [1] of changes relative to state_, without those of motions and links.
  double product(const State& a, const State& b) const;
  // True if points at this length [1] are in their cones, and products near their values on the
  // path.
  bool is_inside(const Step& step, double length) const;
  static void add(double factor, const State& changes, State& to);
  static State end_of(const Step& step, double length);
  // Sets the tangent, the derivative by ln(tau) or -ln(tau), and the correction at right angles to
  // it. Returns false if the matrix is singular, or the corrected point is not near the path.
  bool find_direction(Step& step);
  // Sets half of the second derivative of the path by the length, at right angles to the tangent.
  void find_second(Step& step);
  void take_impulses();

  const ConstraintProblem<D>& problem_;
  const std::vector<double>& w_;
  UnitMatrix<D>& matrix_;
  std::vector<Part> parts_;
  State state_, best_;  // the present point of the path, and its point with the least tau
  // Impulses on units minus those that cause y [M L/T]; and at the start, over tau there [1/L].
  std::vector<Motion<D>> error_, error_per_tau_;
  std::vector<double> impulses_;
  double size_ = 0;       // root of tau at the start: the largest scaled value with lowest impulses
  double degree_ = 0;     // sum of 1 for each contact without friction and 4 for each one with it
  double smoothing_ = 1;  // bound times spare on the path, divided by tau [1]
};

}  // namespace viscontact::contact_solver
