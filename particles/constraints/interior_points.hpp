// Solves convex problems for the impulses of contacts with friction, and of links, in a time step,
// docs/physics.md (5.9) and (5.17), by a method of interior points. The problem is a
// ConstraintProblem (constraint_problem.hpp): a unit is a particle or a rigid body, a row is a gap,
// a slip or the left side of a link's equation. Lengths [L], masses [M] and times [T] are in any
// consistent units; h is the length of the step, M/h are the masses and moments of inertia over h.
// Nothing is checked or thrown: the caller must measure the residuals. constraint_solver.cpp uses
// it. Another order of sums would change results by rounding errors.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "viscontact/particles/constraints/block_factor.hpp"
#include "viscontact/particles/constraints/cone.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// Finds the motions y of the units that minimise |y - y*|^2/2 in the norm of M/h, where y* are
/// the motions without impulses, subject to the following conditions; and the impulses p that cause
/// these motions. p_n is the normal and p_t the tangential impulse of a contact, `slip` its
/// tangential displacement, mu_s its coefficient of friction. The cone is the set of the points
/// (x_0, x_1, x_2) with x_0 >= |(x_1, x_2)| (cone.hpp), and u.r is the inner product of u and r.
///
///     A dry contact with friction, FrictionBound::kCone (5.9): u = (gap, mu_s slip) is in the
///     cone. Its dual point r = (p_n, p_t/mu_s) is in the cone, and u.r = 0.
///     Any other contact: gap >= 0, p_n >= its lowest value, and equality in one of the two. If the
///     magnitude of its friction has a given bound (5.17), also u = (z, slip) is in the cone, with
///     an unknown z >= |slip| that adds bound times z to the minimised function. Its dual point
///     r = (bound, p_t) is in the cone, and u.r = 0.
///     A row of a link: its equation, which is value + compliance p = 0.
///
/// The method is the predictor-corrector method of Mehrotra (1992), scaled after Nesterov & Todd
/// (1997, "Self-scaled barriers and interior-point methods for convex programming"). Each iteration
/// factorises a UnitMatrix. A small multiple of the change of r in an iteration is added to the
/// change of u, so that the matrix stays regular if rows are redundant. Most problems take 10 to 25
/// iterations.
template <int D>
class InteriorPoints {
 public:
  /// All arguments must outlive this object. `w` [T/M] has one number > 0 for each row:
  /// row_mobilities(), or larger ones. `matrix` was made for this problem with is_symmetric = true,
  /// and solve() overwrites it. No contact with friction may have FrictionBound::kCoulomb, because
  /// solve() would leave out its friction.
  InteriorPoints(const ConstraintProblem<D>& problem, const std::vector<double>& w,
                 UnitMatrix<D>& matrix);

  /// Solves the problem until its scaled violations are at most `accuracy` [1], in (0, 1), times
  /// the largest scaled value of a row if all contacts have their lowest impulses. Stops earlier if
  /// rounding errors prevent progress, if the matrix cannot be factorised, if a number is NaN, or
  /// after `max_iterations` >= 0 iterations. Returns the number of iterations, from which the
  /// caller cannot tell whether the accuracy is reached.
  int solve(double accuracy, int max_iterations);

  /// The impulses [M L/T] with the smallest violations that the last solve() found, one for each
  /// row.
  const std::vector<double>& impulses() const { return impulses_; }

 private:
  static constexpr std::size_t kMotion = static_cast<std::size_t>(D + kTurns<D>);
  using Cone = std::conditional_t<D == 2, LinearCones, SecondOrderCone>;
  // The conditions of the problem are parts of two kinds, Single and Cones. The value of a row is
  // multiplied by `scale`, and its impulse is divided by it. With scale = 1/w^(1/2) both have the
  // unit L (M/T)^(1/2), which is also the unit of all numbers below for which no unit is given.
  //
  // A gap that is not in a cone, or a row of a link.
  struct Single {
    std::size_t block = 0, row = 0;
    bool is_equation = false;  // true: a row of a link
    double scale = 1;          // [(M/T)^(1/2)]
    double base = 0;           // impulse at which r is 0 [M L/T]
    double compliance = 0;     // compliance of a link divided by w [1]
    double u = 0, r = 0;       // gap and its impulse minus `base`, > 0; an equation has no u
    double change_of_u = 0, change_of_r = 0;
    double error = 0;   // value of the row minus u; of an equation value + compliance r
    double goal = 0;    // the value that (u/r) change_of_r + change_of_u must have
    double weight = 0;  // derivative of change_of_r by goal - error [1]
  };
  // The rows of a contact with kCone, or the tangential rows of a contact with a given bound.
  // Points are in the coordinates of `Cone`, and W^2 is the square of `scaling` (cone.hpp).
  struct Cones {
    bool is_bound_given = false;
    std::size_t block = 0, row = 0, rows = 1;  // the block, its first row here, and their number
    std::size_t first = 0;  // component of u and r that belongs to the first row: 0, or 1 with z
    ConePoint scale{};      // of each component [(M/T)^(1/2)]
    InnerPoint u, r;        // the present point u and its dual point r, both inside the cone
    ConePoint change_of_u{}, change_of_r{};
    double scaled_bound = 0;  // if the bound is given: component 0 of r, which never changes
    ConePoint error{};        // values of the rows minus u
    ConePoint goal{};         // numbers (cone.hpp) that W^2 change_of_r + change_of_u must have
    typename Cone::Scaling scaling;
  };
  void set_parts();
  void start(double size);
  ConePoint impulse_of(const Cones& part, const ConePoint& r) const;
  ConePoint values(const Cones& part, bool with_offset, const std::vector<Motion<D>>& y) const;
  void add_impulse(const Cones& part, const ConePoint& r, std::vector<Motion<D>>& to) const;
  double value(const Single& part, const std::vector<Motion<D>>& y) const;
  static void begin_predictor(Single& part);
  static void begin_predictor(Cones& part);
  static ConePoint change_of_r(const Cones& part, const ConePoint& numbers);
  double largest_value() const;
  double measure();
  bool factorise();
  void find_direction(int solutions);
  double length_to_boundary() const;
  void set_corrector(double gap_before, double length);
  void move(double length);
  void take_impulses();

  const ConstraintProblem<D>& problem_;
  const std::vector<double>& w_;
  UnitMatrix<D>& matrix_;
  std::vector<Single> singles_;
  std::vector<Cones> cones_;
  // y_: motions [L, rad]; direction_: their change in an iteration; error_: the impulses of the
  // rows on the units minus M/h (y_ - y*) [M L/T].
  std::vector<Motion<D>> y_, direction_, error_;
  std::vector<Motion<D>> right_;  // right side of a system of equations, then its solution
  std::vector<double> impulses_;
  double gap_ = 0;     // sum of all u.r over degree_: the duality gap [M L^2/T]
  double degree_ = 0;  // sum of 1 for each gap, and of e.e for each cone, e the unit of its product
};

}  // namespace viscontact::particles
