// The present iterate of a solution of a ConstraintProblem, and the best one so far.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "viscontact/contact_solver/constraint_solver.hpp"
#include "viscontact/contact_solver/methods/accelerated_sweeps.hpp"
#include "viscontact/contact_solver/methods/block_factor.hpp"
#include "viscontact/contact_solver/methods/contact_sweeps.hpp"
#include "viscontact/contact_solver/methods/proximal_step.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"
#include "viscontact/contact_solver/stages/stages.hpp"

namespace viscontact::contact_solver {

struct IterateTuning {
  // Sweeps between two evaluations of the residuals. One takes a small part of the time of a
  // factorisation.
  static constexpr int kSweeps = 30;
  // The best residual must be halved in so many iterations, without those of paths. With 2000 in
  // place of 3000 and Coulomb's law, three more of the 200 steps of bench/box2d.cpp ended without a
  // solution when there were no paths. Convex problems whose loads are not given take 20 to 70
  // iterations, unless they have no solution.
  static constexpr double kGain = 0.5;
  static constexpr int kPatience = 3000, kPatienceOfCones = 300;
  // close_gaps(): most steps, and most iterations of one. The epsilon of slips is large, that of
  // gaps falls by the factor to the least one.
  static constexpr int kMostSteps = 12, kMostOfStep = 200;
  static constexpr double kEpsilonOfSlips = 1e-3, kLeastEpsilon = 1e-6, kFactor = 3;
};

/// The impulses of the problem, what follows from them, and the operations that several strategies
/// share. A number called epsilon is that of ProximalStep.
template <int D>
class Iterate {
 public:
  /// `of` must outlive the object. Its normal impulses are raised to their lowest values.
  Iterate(ConstraintProblem<D>& of, int max_iterations, ConstraintStart start);

  ConstraintProblem<D>& problem;
  const int most;                        ///< iterations in all
  std::vector<double> w;                 ///< row mobilities [T/M]; kLeastImpulses has equal gaps
  std::vector<double> values;            ///< of the rows at the present impulses [L]
  std::vector<Motion<D>> motions;        ///< of the units
  std::vector<BlockResidual> residuals;  ///< of the blocks
  double residual = 0;                   ///< the largest one over the allowed one [1]
  double epsilon = 0;                    ///< of the next step (5.8)
  bool has_given_loads = false, has_cones = false;
  /// Normal impulse beyond which iterates do not count [M L/T].
  double most_impulse = std::numeric_limits<double>::infinity();

  int iterations() const { return best_.result.iterations; }
  void count(Stage stage, int iterations);
  /// True if the problem is solved, no iteration is left, or the best residual was not halved for
  /// long.
  bool is_at_end() const { return residual <= 1 || iterations() >= most || is_stagnant(); }

  /// Computes what follows from problem.impulses. The first iterate is stored also if its residual
  /// is NaN, because finish() must return one.
  void update();
  /// The same with other impulses.
  void move_to(const std::vector<double>& impulses);
  void return_to_best();
  /// The best solution so far does not count, because it belongs to another problem.
  void forget_best();
  /// Sets problem.impulses to the best ones. Nothing else may be called afterwards.
  ConstraintSolution<D> finish();

  /// Records the number of iterations when the best residual has been halved again.
  void note_progress();
  /// The last `iterations` do not count in is_at_end().
  void excuse(int iterations) { gained_at_ += iterations; }

  /// True if the solution begins with accelerated sweeps.
  bool can_accelerate() const { return accelerated_.has_value(); }
  void accelerate(SweepPlan plan, Stage stage);
  /// IterateTuning::kSweeps of Gauss-Seidel.
  void sweep();
  /// Computes a step (5.8) from `center` in at most `most_of_step` iterations, and fewer if there
  /// would be more than `last` in all, but does not move there. Returns the number of iterations,
  /// or nothing if the step failed or needs more.
  std::optional<int> compute_step(const std::vector<double>& center, int most_of_step, int last,
                                  Stage stage);
  void set_epsilon(double of_step);
  /// The largest tangential residual over its allowed one [1].
  double largest_slip() const;
  /// Makes the residuals of gaps and links allowed, after a step from the impulses `center` has
  /// made those of the slips allowed. Between jammed particles that stick, slips are never 0, so
  /// that further steps would increase impulses without end. Therefore the steps start from the
  /// last impulses in the rows of gaps and links only. The tangential rows keep a center with which
  /// the present motions give the present friction, and a large epsilon. Returns true if the
  /// problem is solved before `last` iterations in all; otherwise restores the impulses.
  bool close_gaps(std::vector<double> center, int last);

  UnitMatrix<D>& matrix();
  ProximalStep<D>& proximal();

 private:
  bool is_stagnant() const;

  std::optional<ContactSweeps<D>> sweeps_;
  std::optional<AcceleratedSweeps<D>> accelerated_;
  std::optional<UnitMatrix<D>> matrix_;
  std::optional<ProximalStep<D>> proximal_;
  std::vector<double> best_impulses_;
  ConstraintSolution<D> best_;
  double gained_residual_ = std::numeric_limits<double>::infinity();  // see note_progress()
  int gained_at_ = 0;                                                 // see note_progress()
};

}  // namespace viscontact::contact_solver
