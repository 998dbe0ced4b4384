// The strategies for a convex ConstraintProblem.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "viscontact/contact_solver/iterate.hpp"
#include "viscontact/contact_solver/methods/interior_points.hpp"

namespace viscontact::contact_solver {

template <int D>
class ConvexLadder {
 public:
  /// `problem` must outlive the object.
  ConvexLadder(ConstraintProblem<D>& problem, int max_iterations, ConstraintStart start)
      : at_(problem, max_iterations, start),
        needs_loads_(at_.has_given_loads && !problem.keeps_loads && !problem.is_rough),
        is_near_(problem.is_near) {}

  ConstraintSolution<D> solve() {
    run_stages(kTable, *this);
    return at_.finish();
  }
  bool is_done() const { return !needs_loads_ && at_.is_at_end(); }

 private:
  static const std::array<StageRow<ConvexLadder>, 5> kTable;

  bool needs_loads() const { return needs_loads_; }
  void find_loads(Stage stage);

  bool may_accelerate() const { return !has_accelerated_ && at_.can_accelerate(); }
  void accelerate(Stage stage);

  bool is_near() const { return is_near_ && at_.residual > 1; }
  void begin_steps_near_guess();

  bool has_no_interior_solution() const { return !has_interior_solution_; }
  void find_interior_solution(Stage stage);

  bool shall_be_accurate() const { return !at_.problem.is_rough && at_.residual > 1; }
  void begin_steps();
  void take_step(Stage stage);
  bool are_steps_over() const { return !(at_.residual > 1) || at_.iterations() >= last_; }

  void take_interior_points(Stage stage);
  // Without rounding errors each step would lead nearer to the solution. The errors of the impulses
  // are those of the gaps over epsilon. Therefore epsilon rises to the largest one, then falls so
  // that impulses between jammed particles grow fast, and rises again.
  void improve(Stage stage);
  // Adds the change of the impulses since `center` times the largest number with which no contact
  // begins to slip or open. Jammed particles get the same change in each step until then.
  void extend_change(const std::vector<double>& center);

  Iterate<D> at_;
  std::optional<InteriorPoints<D>> interior_;
  bool needs_loads_, is_near_, has_accelerated_ = false, has_interior_solution_ = false;
  bool is_rising_ = false;  // epsilon
  int last_ = 0;            // iterations in all, up to the end of the present steps
};

}  // namespace viscontact::contact_solver
