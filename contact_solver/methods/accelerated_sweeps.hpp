// Sweeps of nonlinear Gauss-Seidel with momentum, for contacts of round particles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "viscontact/contact_solver/problem/constraint_problem.hpp"

namespace viscontact::contact_solver {

/// Sweeps give one contact after the other the impulses that satisfy its own conditions exactly.
/// Between sweeps the impulses are extrapolated (Nesterov 1983, "A method for solving the convex
/// programming problem with convergence rate O(1/k^2)"), until the extrapolation points away from
/// the next change (O'Donoghue and Candes 2015, "Adaptive restart for accelerated gradient
/// schemes"). Convex problems of packings take a tenth of the sweeps of ContactSweeps. Impulses
/// near the solution are a good start; nothing else is kept.
template <int D>
class AcceleratedSweeps {
 public:
  /// Nothing unless each block is a contact of round surfaces: its normal impulse turns no unit,
  /// its arms are along the normal, and the moments of inertia of its units are the same about all
  /// axes. `problem` and `w`, its row_mobilities(), must outlive the result.
  static std::optional<AcceleratedSweeps> of(ConstraintProblem<D>& problem,
                                             const std::vector<double>& w);

  /// Improves problem.impulses until the residual of each block is allowed, or `most` sweeps are
  /// done. The extrapolation begins anew after at most `longest` sweeps. Returns the number of
  /// sweeps; 0 if all residuals are allowed at the start.
  int sweep(int most, int longest);

 private:
  using Vec = std::array<double, D>;
  using Turn = std::array<double, kTurns<D>>;
  struct Unit {
    Vec moved{};  // [L]
    double mobility = 0;
    Turn turned{};  // [rad]
    double turn_mobility = 0;
  };
  // Normal and tangential impulse on the first unit [M L/T].
  struct Impulse {
    double normal = 0;
    Vec tangential{};
  };
  struct RoundContact {
    Vec normal;      // away from the second unit; the first unit moves along it if it is pushed
    double gap = 0;  // without motions of units [L]
    Vec slip{};      // the same of the tangential rows [L]
    Impulse y, x;    // where the next sweep begins, and after the last sweep
    double w_normal, w_tangential, inverse_w_normal, inverse_w_tangential;
    double arm, other_arm;  // from the centres to the contact [L]
    // Squares of changes of gap and slip, over those allowed, by unit impulses [(T/(M L))^2].
    double square_of_gap, square_of_slip;
    double lowest, friction, capacity, given_load;
    std::int32_t unit, other;
    FrictionBound bound;
    bool has_friction;
    bool waits;  // it is optional and has no impulse yet
  };

  AcceleratedSweeps(ConstraintProblem<D>& problem, const std::vector<double>& w)
      : problem_(&problem), w_(&w) {}
  // Returns false if the block is not such a contact.
  bool add(const ConstraintBlock& block);
  void begin();
  // The gap and slip of a contact at the present motions [L].
  Impulse values_of(const RoundContact& contact) const;
  // The impulses that satisfy the conditions of the contact, whose impulse is `p`, alone.
  Impulse solution_of(const RoundContact& contact, const Impulse& p, const Impulse& values) const;
  // The square of the larger of the changes of gap and slip by this change of the impulse, over
  // those allowed [1].
  static double square_of(const RoundContact& contact, const Impulse& change);
  void push(const RoundContact& contact, const Impulse& change);
  double residual() const;
  // Contacts whose gaps have closed wait no longer. Returns true if there are such contacts.
  bool end_waiting();
  void finish();

  ConstraintProblem<D>* problem_;
  const std::vector<double>* w_;
  std::vector<RoundContact> contacts_;
  std::vector<std::size_t> waiting_;  // places in contacts_
  std::vector<Unit> units_;   // and then one for all sides without a unit
  std::vector<Unit> before_;  // after the sweep before
};

}  // namespace viscontact::contact_solver
