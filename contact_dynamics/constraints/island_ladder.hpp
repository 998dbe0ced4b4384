// The strategies with which an island of a ConstraintSystem is solved.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "viscontact/contact_dynamics/constraints/constraint_system.hpp"
#include "viscontact/contact_solver/stages/stages.hpp"

namespace viscontact::particles {

/// The equations of bodies and links are linear in the motions. The problem is therefore solved
/// again, with offsets corrected by the difference between lengths of links and gaps of bodies
/// after finite turns and their linear values, until this difference is below half of what is
/// allowed. The table in the source says what happens where this fails.
template <int D>
class IslandLadder {
 public:
  using Island = typename ConstraintSystem<D>::Island;

  /// All arguments must outlive the object. `roughly_allowed` is only for a rough solution.
  IslandLadder(ConstraintSystem<D>& constraints, ContactSystem<D>& system, Island& island,
               bool is_rough, double roughly_allowed, int max_iterations);

  /// Moves the particles, and sets impulses, residuals and errors. Returns as
  /// ConstraintSystem::solve().
  SolverResult solve();
  bool is_done() const { return is_done_; }

 private:
  using Row = contact_solver::StageRow<IslandLadder>;
  using Stage = contact_solver::Stage;
  static const std::array<Row, 8> kTable;

  bool needs_solution() const { return phase_ == Phase::kNotSolved; }
  void find_solution(Stage stage);

  // Friction locks a body between two contacts, and the body turns about the line through them.
  bool is_locked() const;
  void retry_with_first_loads(Stage stage);

  bool needs_distances() const { return is_unsolved_after_corrections() && can_use_distances(); }
  void use_distances_with_more_iterations(Stage stage);

  bool may_retry() const { return is_unsolved_after_corrections() && may_give_up(); }

  bool is_unsolved() const;
  bool may_give_up_here() const { return is_unsolved() && may_give_up(); }
  void give_up_here(Stage stage);

  bool needs_measurement() const { return phase_ == Phase::kSolved; }
  void measure(Stage stage);

  bool may_use_distances() const { return phase_ == Phase::kDiverged && can_use_distances(); }
  void use_distances(Stage stage);

  bool may_retry_without_friction() const { return phase_ == Phase::kDiverged && may_give_up(); }
  void retry_without_friction(Stage stage) { retry_with_given_loads({}, stage); }

  bool is_unsolved_after_corrections() const { return corrections_ > 0 && is_unsolved(); }
  bool is_exhausted() const;
  // True if the island has not given up yet, and a load of its own could be given.
  bool could_give_up() const;
  // True if the step can be divided, and the island has no rows but those of contacts: one with
  // links that no step solves would be tried in all parts.
  bool can_be_divided() const;
  bool may_give_up() const { return !can_be_divided() && could_give_up(); }
  // Solves with the loads of the present impulses or, if they fail or `have_diverged`, of a
  // solution without friction. If this fails, too, returns false and changes nothing but the
  // iterations.
  bool give_up(bool have_diverged, Stage stage);
  // Begins anew with friction that the loads of `impulses` bound, or, if it is empty, those of a
  // solution without friction. If this fails, restores the problem.
  void retry_with_given_loads(const std::vector<double>& impulses, Stage stage);
  // True if ContactSystem::use_distances() would change a gap of the island.
  bool can_use_distances() const;
  // True if a correction is larger than rounding errors and errors of solutions.
  bool has_large_shifts() const;
  double change_of_impulses() const;
  void restart();
  void refine();
  void prepare_correction(bool is_fast);
  void take_over();

  ConstraintSystem<D>& constraints_;
  ContactSystem<D>& system_;
  Island& island_;
  ConstraintProblem<D>& problem_;
  bool is_rough_;
  double roughly_allowed_;
  int max_iterations_;

  enum class Phase : unsigned char { kNotSolved, kSolved, kDiverged } phase_ = Phase::kNotSolved;
  bool is_done_ = false;
  ConstraintSolution<D> solution_;
  std::optional<Refinement<D>> refinement_;
  SolverResult result_;
  int corrections_ = 0;  // since the last beginning
  // The last correction and the last one that was half of that before, over what is allowed.
  double last_change_ = std::numeric_limits<double>::infinity();
  double gained_change_ = std::numeric_limits<double>::infinity();
  int growing_ = 0, gained_at_ = 0;  // corrections that grew in succession; that of gained_change_
  // Of the problem without corrections: the larger energy of its motions without and with impulses,
  // the sum of its loads, and its impulses. Impulses of Coulomb's law can have any size where
  // friction locks a body, and are not kept.
  double first_energy_ = 0, first_loads_ = 0;
  std::vector<double> first_impulses_;
};

}  // namespace viscontact::particles
