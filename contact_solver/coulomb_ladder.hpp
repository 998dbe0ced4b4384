// The strategies for a ConstraintProblem with Coulomb's law.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "viscontact/contact_solver/iterate.hpp"

namespace viscontact::contact_solver {

template <int D>
class CoulombLadder {
 public:
  /// `problem` must outlive the object.
  CoulombLadder(ConstraintProblem<D>& problem, int max_iterations, ConstraintStart start)
      : at_(problem, max_iterations, start), start_(start) {}

  ConstraintSolution<D> solve() {
    run_stages(kTable, *this);
    return at_.finish();
  }
  bool is_done() const;

 private:
  static const std::array<StageRow<CoulombLadder>, 5> kTable;

  bool is_too_large_for_factors() const;
  bool may_accelerate() const;
  void accelerate(Stage stage);

  bool may_sweep() const;
  void sweep(Stage stage);
  bool do_sweeps_gain_little() const;

  bool is_unsolved() const { return at_.residual > 1; }
  void begin_proximal_steps();
  void take_proximal_step(Stage stage);
  bool are_proximal_steps_over() const { return !is_unsolved() || is_path_due(); }

  bool is_path_due() const;
  void follow_path(Stage stage);

  bool is_at_end_of_path() const { return is_at_end_of_path_ && is_unsolved(); }
  void take_step_from_path(Stage stage);
  bool are_steps_from_path_over() const;
  void leave_end_of_path();

  // Between jammed particles that stick, impulses that balance each other must grow until a contact
  // slips or opens. Small epsilons reach this state fast, but steps fail more often. Therefore
  // epsilon falls after a success and grows after a failure, and sweeps follow on failures with the
  // largest one.
  void improve(Stage stage);
  // The impulses at the end of path `number`, or nothing if it ends far from a solution.
  std::optional<std::vector<double>> end_of_path(int number, Stage stage);
  void begin_at(const std::vector<double>& impulses, double epsilon);
  // A bound of the impulses that a solution can need [M L/T]: the sum of those that stop the free
  // motion of each unit, of those that remove its violations of contacts with friction and rigid
  // links, and of the lowest impulses of such contacts.
  double sum_of_impulses_at_work() const;

  Iterate<D> at_;
  ConstraintStart start_;
  std::size_t runs_ = 0;  // of accelerated sweeps
  double before_sweeps_ = std::numeric_limits<double>::infinity();
  int steps_ = 0, next_try_ = 0;  // proximal steps so far; that after which gaps are closed
  int paths_ = 0;
  int due_at_ = std::numeric_limits<int>::max();  // iterations after which steps end
  // At the end of a path: what was before it, iterations there, and the residual at the last gain.
  bool is_at_end_of_path_ = false;
  std::vector<double> before_path_;
  double epsilon_before_path_ = 0, halved_ = 0;
  int path_ended_at_ = 0;
};

}  // namespace viscontact::contact_solver
