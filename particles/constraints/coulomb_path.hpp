// Solves problems of contacts with Coulomb's law and links by following a path of smoothed
// problems, docs/physics.md (5.20) (constraint_problem.hpp defines problem, rows and units).
// Lengths [L], masses [M] and times [T] are in any consistent units; h is the length of the step,
// M/h are the masses and moments of inertia over h. Nothing is thrown: the caller must measure the
// residuals. constraint_solver.cpp uses it. The path depends neither on the order of the contacts
// nor on a guess of the impulses, also where contacts are redundant; a change must keep that.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/particles/constraints/block_factor.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// Finds motions and impulses that obey Coulomb's law. The conditions of each contact are products
/// that must be 0: of its gap u and its normal impulse r beyond the lowest one; of the load of its
/// solids and the impulse that its film can still absorb; and of its friction p below the bound
/// mu_s times this load, and its slip v. On the path all products have the same positive value tau
/// instead (but for constant factors), and the errors of all linear equations are tau times those
/// of a start at which gaps and impulses are large. The solution is where tau becomes 0.
///
/// Coulomb's law is not the condition of a minimum, so that tau need not fall along the path: it
/// grows between two folds, where the determinant of the equations is negative. A step of the
/// method follows the path by a polynomial of second order, from one factorisation of a UnitMatrix,
/// up to where the products would leave an interval around those on the path. The next one begins
/// with a correction at right angles to the path, so that it also passes folds (Keller 1977,
/// "Numerical solution of bifurcation and nonlinear eigenvalue problems"). A step whose end cannot
/// be corrected is taken again with a smaller length.
template <int D>
class CoulombPath {
 public:
  /// All arguments must outlive this object. `w` are the positive row_mobilities() of the problem
  /// [T/M]. `matrix` is made for the problem without is_symmetric; follow() overwrites it. All
  /// contacts with friction must have FrictionBound::kCoulomb.
  CoulombPath(const ConstraintProblem<D>& problem, const std::vector<double>& w,
              UnitMatrix<D>& matrix);

  /// Number of different paths to a solution, which differ in how they smooth the bound of the
  /// friction. On nearly all problems the first one suffices.
  static constexpr int kPaths = 3;

  /// Follows path `number`, from 0 to kPaths - 1, until the root of tau, which is a violation, is
  /// at most `accuracy`, in (0, 1), times the largest scaled value of a row with the least
  /// impulses. Stops before if the path is lost, if rounding errors prevent progress, or after
  /// `max_iterations` factorisations. Returns their number.
  int follow(int number, double accuracy, int max_iterations);

  /// The root of the least tau of the last follow(), over its value at the start [1].
  double reached() const { return size_ == 0 ? 0 : std::sqrt(best_.tau) / size_; }
  /// The impulses at the point with the least tau of the last follow(), one for each row [M L/T].
  const std::vector<double>& impulses() const { return impulses_; }

 private:
  static constexpr std::size_t kMotion = static_cast<std::size_t>(D + kTurns<D>);
  static constexpr std::size_t kTangents = static_cast<std::size_t>(D - 1);
  using Tangent = std::array<double, kTangents>;
  // The value of a row is multiplied by a scale, its impulse divided by it. With the scale
  // 1/w^(1/2) of the first row of its block both are in the unit L (M/T)^(1/2), as all numbers
  // below without another unit.
  //
  // What is unknown of a contact or a row of a link, or its change.
  struct Point {
    double u = 0;      // gap
    double r = 0;      // its impulse minus the lowest one; impulse of the row of a link
    double bound = 0;  // of the friction: mu_s times the load of the solids
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
  // A step of the path: its end is at + correction + length tangent + length^2 second.
  struct Step {
    State at, correction, tangent, second;
    double length = 0;  // in which it was taken
  };
  // A contact, or a row of a link.
  struct Part {
    std::size_t block = 0, row = 0;
    bool is_equation = false;       // a row of a link
    bool rubs = false;              // with friction
    double scale = 1, of_slip = 1;  // of the row, and of the tangential rows [(M/T)^(1/2)]
    double base = 0;                // impulse at which r is 0 [M L/T]
    double compliance = 0;          // of an equation, over w [1]
    double bound_per_impulse = 0;   // change of bound - spare by that of r [1]
    double error = 0;               // value of the row minus u; of an equation its left side
    Tangent slip_error{};           // values of the tangential rows minus v
    double error_per_tau = 0;       // the same at the start, over tau [(T/M)^(1/2)/L]
    Tangent slip_error_per_tau{};
    // From factorise(): derivatives of the change of r by that of the value of the row, and of the
    // change of p by that of the slip and of the bound.
    double weight = 0;
    std::array<double, kTangents * kTangents> inverse{};  // of the matrix before the change of p
    Tangent by_bound{};
  };
  void set_parts();
  void start();
  double value(const Part& part, std::span<const Motion<D>> y) const;
  Tangent slip(const Part& part, std::span<const Motion<D>> y) const;
  void measure();
  bool factorise();
  void find_changes(double of_errors, double of_tau, const State* tangent, State& changes);
  double product(const State& a, const State& b) const;
  bool is_inside(const Step& step, double length) const;
  static void add(double factor, const State& changes, State& to);
  static State end_of(const Step& step, double length);
  bool find_direction(Step& step);
  void find_second(Step& step);
  void take_impulses();

  const ConstraintProblem<D>& problem_;
  const std::vector<double>& w_;
  UnitMatrix<D>& matrix_;
  std::vector<Part> parts_;
  State state_, best_;  // the present point, and that with the least tau
  // Impulses on the units minus M/h (y - y*) [M L/T], and those of the start over tau [1/L].
  std::vector<Motion<D>> error_, error_per_tau_;
  std::vector<double> impulses_;
  double size_ = 0;       // the largest scaled value of a row with the least impulses
  double degree_ = 0;     // number of products
  double smoothing_ = 1;  // bound times spare on the path over tau
};

}  // namespace viscontact::particles
