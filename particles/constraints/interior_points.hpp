// Convex problems with friction, (5.9) and (5.17) of docs/physics.md, by interior points
// (constraint_problem.hpp). Units are those of the case. constraint_solver.cpp uses it; nothing is
// thrown. A change must keep the order of sums.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "viscontact/particles/constraints/block_factor.hpp"
#include "viscontact/particles/constraints/cone.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// Finds motions y and impulses that minimise |y - y*|^2/2 in the norm of M/h subject to
///
///     u = (gap, mu_s slip) in the cone of a dry contact that rubs (5.9), with the dual point
///     r = (p_n, p_t/mu_s) in the same cone and u.r = 0,
///     gap >= 0 of the other contacts, with the dual p_n - lowest >= 0,
///     u = (z, slip) in the cone where the friction has a given bound (5.17), with the dual point
///     r = (bound, p_t) and u.r = 0: the number z >= |slip| is an unknown with the price `bound`,
///     bilateral rows as equations,
///
/// by the predictor-corrector method of Mehrotra (1992), scaled after Nesterov & Todd (1997,
/// "Self-scaled barriers and interior-point methods for convex programming"). Each iteration
/// factorises a UnitMatrix. The number of iterations hardly depends on the problem, whether or not
/// its rows are redundant: a small multiple of the change of r in an iteration is added to u, as in
/// the proximal method. This change vanishes at the solution, and keeps the matrix regular.
template <int D>
class InteriorPoints {
 public:
  /// All arguments must outlive this object; `w` are the row_mobilities() of the problem, `matrix` is
  /// its symmetric matrix, which others may use between two solve().
  InteriorPoints(const ConstraintProblem<D>& problem, const std::vector<double>& w,
                 UnitMatrix<D>& matrix);

  /// Solves the problem until the violations of its conditions are at most `accuracy`, in (0, 1),
  /// times those without impulses. Returns the number of factorisations. Stops early where rounding
  /// errors make a matrix singular, or after `max_iterations`.
  int solve(double accuracy, int max_iterations);

  /// Impulses of the rows that the last solve() found [M L/T].
  const std::vector<double>& impulses() const { return impulses_; }

 private:
  static constexpr std::size_t kMotion = static_cast<std::size_t>(D + kTurns<D>);
  using Cone = std::conditional_t<D == 2, LinearCones, SecondOrderCone>;
  // The numbers of parts are scaled so that impulses and displacements have one unit, in which the
  // mobility of the first row is 1.
  //
  // A gap without a cone, or a row of an equation.
  struct Single {
    std::size_t block = 0, row = 0;
    bool is_equation = false;
    double scale = 1;
    double base = 0;        // impulse at which r is 0 [M L/T]
    double compliance = 0;  // of an equation
    double u = 0, r = 0;    // the present point; an equation has no u
    double change_of_u = 0, change_of_r = 0;
    double error = 0;   // value of the row minus u; of an equation its value
    double goal = 0;    // (u/r) dr + du
    double weight = 0;  // d(r)/d(goal - error)
  };
  // The rows of a contact in a cone of (5.9), or its tangential rows with a given bound.
  struct Cones {
    bool is_bound_given = false;
    std::size_t block = 0, row = 0, rows = 1;  // row: the first one
    std::size_t first = 0;                     // component of u and r that is of the first row
    ConePoint scale{};                         // of the components
    InnerPoint u, r;                           // the present point
    ConePoint change_of_u{}, change_of_r{};
    double scaled_bound = 0;  // first component of r of a given bound
    ConePoint error{};        // value of the rows minus u
    ConePoint goal{};         // numbers of W^2 dr + du
    typename Cone::Scaling scaling;
  };
  // Components of u and r.
  static std::size_t dimension(const Cones& part) { return part.first + part.rows; }
  void set_parts();
  void start(double size);
  ConePoint impulse_of(const Cones& part, const ConePoint& r) const;
  ConePoint values(const Cones& part, bool with_offset, const std::vector<Motion<D>>& y) const;
  void add_impulse(const Cones& part, const ConePoint& r, std::vector<Motion<D>>& to) const;
  double value(const Single& part, const std::vector<Motion<D>>& y) const;
  static void set_scaling(Single& part);
  static void set_scaling(Cones& part);
  static ConePoint change_of_r(const Cones& part, const ConePoint& numbers);
  static std::array<ConePoint, 3> in_other_coordinates(const std::array<ConePoint, 3>& matrix);
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
  std::vector<Motion<D>> y_, direction_, error_;  // error_: impulses that are missing
  std::vector<Motion<D>> right_;                  // of a system of equations, then its solution
  std::vector<double> impulses_;
  double gap_ = 0;  // mean u.r of the cones
  double degree_ =
      0;  // divisor of this mean: 1 for each gap, e.e for each cone (e: unit of its product)
};

}  // namespace viscontact::particles
