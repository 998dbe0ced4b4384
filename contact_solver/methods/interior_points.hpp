// The method of interior points for convex problems of contacts with friction and of links,
// docs/physics.md (5.9) and (5.17).
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "viscontact/contact_solver/methods/block_factor.hpp"
#include "viscontact/contact_solver/problem/cone.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"

namespace viscontact::contact_solver {

/// Finds the motions y of the units that minimise |y - y*|^2/2 in the norm of the masses over the
/// length of the step, where y* are the motions without impulses, subject to the following
/// conditions; and the impulses that cause these motions. p_n is the normal and p_t the tangential
/// impulse of a contact, `slip` its tangential displacement, mu_s its coefficient of friction, and
/// the cone that of cone.hpp.
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
/// factorises a UnitMatrix. A small multiple of the change of r is added to the change of u, so
/// that the matrix stays regular if rows are redundant. Most problems take 10 to 25 iterations.
template <int D>
class InteriorPoints {
 public:
  /// All arguments must outlive this object. `w` has row_mobilities() or more, > 0 [T/M]. `matrix`
  /// is symmetric; solve() overwrites it. No contact with friction may have
  /// FrictionBound::kCoulomb.
  InteriorPoints(const ConstraintProblem<D>& problem, const std::vector<double>& w,
                 UnitMatrix<D>& matrix);

  /// Solves until the scaled violations are at most `accuracy` [1], in (0, 1), times the largest
  /// scaled value of a row with the lowest impulses. Stops earlier if rounding errors or a NaN
  /// prevent progress, or after `max_iterations`. The returned number of iterations does not tell
  /// whether the accuracy is reached.
  int solve(double accuracy, int max_iterations);

  /// The impulses [M L/T] with the smallest violations that the last solve() found.
  const std::vector<double>& impulses() const { return impulses_; }

 private:
  static constexpr std::size_t kMotion = static_cast<std::size_t>(D + kTurns<D>);
  using Cone = std::conditional_t<D == 2, LinearCones, SecondOrderCone>;
  // The value of a row is multiplied by `scale`, and its impulse is divided by it. With scale =
  // 1/w^(1/2) both have the unit L (M/T)^(1/2), also that of numbers without a unit below. A Single
  // is a gap that is not in a cone, or a row of a link.
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
  // The rows of a contact with kCone, or its tangential rows with a given bound, in coordinates of
  // `Cone`.
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
  // Sets all u and r to `size` times the unit of their cone. If a bound fixes component 0 of r, r
  // is multiplied by a factor with which it has its value, and u is divided by it.
  void start(double size);
  // The impulses of the components of a part with the dual point `r` [M L/T].
  ConePoint impulse_of(const Cones& part, const ConePoint& r) const;
  ConePoint values(const Cones& part, bool with_offset, const std::vector<Motion<D>>& y) const;
  void add_impulse(const Cones& part, const ConePoint& r, std::vector<Motion<D>>& to) const;
  // The value is scaled and has no offset.
  double value(const Single& part, const std::vector<Motion<D>>& y) const;
  static void begin_predictor(Single& part);
  static void begin_predictor(Cones& part);
  // The change dr of r for which (W^2 + kRegularisation I) dr has the given `numbers`. If a bound
  // is given, component 0 of dr is 0 instead, and that of the product can have any value.
  static ConePoint change_of_r(const Cones& part, const ConePoint& numbers);
  // The largest magnitude of the scaled values, with offsets, for y_; NaN if one is NaN.
  double largest_value() const;
  // The largest error of a value, a root of u.r, or the impulses on a unit; NaN if one is NaN.
  double measure();
  // Returns false if the matrix at the present point is singular. Sets the goals of the predictor.
  bool factorise();
  // Sets the changes with which, to first order, errors vanish and goals are reached. A second
  // solution with factors removes rounding errors of motions, which large entries multiply.
  void find_direction(int solutions);
  // The largest multiple of the changes, at most 1/kInside, that leaves all points in their cones.
  double length_to_boundary() const;
  // `length` [1] is that of the predictor's step, `gap_before` is gap_ before it.
  void set_corrector(double gap_before, double length);
  void move(double length);
  void take_impulses();

  const ConstraintProblem<D>& problem_;
  const std::vector<double>& w_;
  UnitMatrix<D>& matrix_;
  std::vector<Single> singles_;
  std::vector<Cones> cones_;
  // Motions [L, rad]; their change; impulses of rows minus those that cause y_ [M L/T].
  std::vector<Motion<D>> y_, direction_, error_;
  std::vector<Motion<D>> right_;  // right side of a system of equations, then its solution
  std::vector<double> impulses_;
  double gap_ = 0;     // sum of all u.r over degree_: the duality gap [M L^2/T]
  double degree_ = 0;  // sum of 1 for each gap, and of e.e for each cone, e the unit of its product
};

}  // namespace viscontact::contact_solver
