// Sweeps of nonlinear Gauss-Seidel with momentum, for contacts of round particles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "viscontact/common/lanes.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"

namespace viscontact::contact_solver {

/// How a run of accelerated sweeps goes.
struct SweepPlan {
  /// The impulses that a contact gets in a sweep.
  enum class Map : unsigned char {
    kLaw,       ///< those that satisfy its conditions
    kProximal,  ///< those of a step (5.8) from a center, which follows the impulses
  };
  int most = 0;              ///< sweeps
  int longest = 0;           ///< most sweeps over which one extrapolation goes on, >= 2
  bool is_adaptive = false;  ///< `longest` grows while changes fall by it, and falls otherwise
  Map map = Map::kLaw;
  double epsilon = 0;        ///< with kProximal
  double longest_step = 1;   ///< of an extrapolation, times the last change, 0 to 1
  bool is_shuffled = false;  ///< contacts are taken in another order, always the same
};

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

  /// Improves problem.impulses until the residual of each block is allowed, or the sweeps of `plan`
  /// are done. Returns the number of sweeps; 0 if all residuals are allowed at the start.
  int sweep(const SweepPlan& plan);

 private:
  // Discs have impulses in the plane and turn about z.
  using Vector = Lanes;
  struct alignas(kLaneAlignment) Unit {
    Vector moved{};   // [L]
    Vector turned{};  // [rad]
    double mobility = 0, turn_mobility = 0;
  };
  struct alignas(kLaneAlignment) Impulse {
    Vector tangential{};  // [M L/T]
    double normal = 0;    // [M L/T]
  };
  struct alignas(kLaneAlignment) RoundContact {
    Vector normal{};  // the first unit moves along it if it is pushed
    Vector offset{};  // gap along the normal, and slip across, if no unit moves [L]
    Impulse x, y;     // after the last sweep, and where the next one begins
    double w_normal = 0, w_tangential = 0;
    double inverse_w_normal = 0, inverse_w_tangential = 0;
    double arm = 0, other_arm = 0;         // from the centres to the contact [L]
    double gap_share = 0, slip_share = 0;  // changes by unit impulses, over those allowed [T/M/L]
    double lowest = 0, friction = 0, capacity = 0, given_load = 0;  // as in ConstraintBlock
    std::size_t block = 0;                                          // its place in the problem
    std::int32_t unit = 0, other = 0;
    FrictionBound bound = FrictionBound::kCone;
    bool has_friction = false;
    bool waits = false;  // it is optional and has no impulse yet
  };
  using Map = SweepPlan::Map;
  struct Sweep {
    double change = 0;  // the largest change of a component over the allowed one
    double away = 0;    // > 0 if the extrapolation before points away from the change
    double sum = 0;     // of the squares of all changes over those allowed, if it is adaptive
    double left = 0;    // with kProximal as `change`: what the center keeps the impulses from
  };

  AcceleratedSweeps(ConstraintProblem<D>& problem, const std::vector<double>& w)
      : problem_(&problem), w_(&w) {}
  // Returns false if block `b` is not such a contact.
  bool add(std::size_t b);
  void begin();
  // Returns the gap [L] at the present motions, and sets the slip [L].
  double find_values(const RoundContact& contact, Vector& slip) const;
  // Replaces the impulse of contact `c` by the one that `map` gives it.
  template <Map map>
  void solve(std::size_t c, const SweepPlan& plan, Impulse& impulse) const;
  void push(const RoundContact& contact, const Impulse& change);
  // `beta` [1] is the length of the extrapolation that follows.
  template <Map map, bool is_adaptive>
  Sweep sweep_once(const SweepPlan& plan, double beta);
  double residual() const;
  // Contacts whose gaps have closed wait no longer. Returns true if there are such contacts.
  bool end_waiting();
  void extrapolate_units(double beta);
  void finish();
  void shuffle();
  // Sets waiting_.
  void list_waiting();
  // sweep() after begin()
  template <Map map, bool is_adaptive>
  int run(const SweepPlan& plan);

  ConstraintProblem<D>* problem_;
  const std::vector<double>* w_;
  std::vector<RoundContact> contacts_;  // of all blocks, in the order of the sweeps
  std::vector<Impulse> centers_;        // with kProximal
  std::vector<std::size_t> waiting_;    // places in contacts_
  std::vector<Unit> units_;             // and then one for all sides without a unit
  std::vector<Unit> before_;            // after the sweep before
};

}  // namespace viscontact::contact_solver
