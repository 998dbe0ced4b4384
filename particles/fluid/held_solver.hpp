// A fluid whose particles are held by rigid bodies, hinges, springs and arms, docs/physics.md
// (6.7). Lengths, masses and times are in the units of the case. fluid_simulation.cpp uses it. A
// change must keep that redundant rows are no error, and those that contradict each other are.
#pragma once

#include <Eigen/QR>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::particles {

/// A linear condition on the velocities v of all particles: the sum of coefficient times component,
/// plus `image_rate`, is `rate`. For a spring, the force follows from this sum instead.
struct HeldRow {
  /// Components of the motions (motion_components() of each particle) and their coefficients.
  std::vector<std::pair<std::size_t, double>> entries;
  double rate = 0;  ///< [L/T], [1/T]; not of a spring
  /// Part of the sum because images of the particles move relative to them in a sheared cell [L/T].
  double image_rate = 0;
  // Of a spring, whose force is -stiffness (extension + theta h sum); stiffness 0: not a spring.
  double stiffness = 0;  ///< [M/T^2], [M L^2/T^2]
  double extension = 0;  ///< at the beginning of the step [L], [rad]
  /// Whether a particle of the row accelerates (StepEquation::link_times).
  bool accelerates = false;
  std::string name{};  ///< in messages
};

/// A fluid solver that holds the particles: it adds forces in the rows, so that the conditions are
/// kept, and passes the questions on to the solver that it owns.
///
/// With the mobility S of the fluid, the forces l of the rows A v = rate solve A S A^T l = rate -
/// A S f. Each placement asks the fluid one question for each row. Each question to this solver
/// then asks the fluid once, or twice if walls and driven particles move (`driving`). Springs have
/// theta = (1 + z)/(2 + z) with z = h stiffness (A S A^T)_rr, as masses have in StepEquation;
/// between particles that accelerate z^2 takes the place of z = (omega h)^2 theta, with the
/// frequency omega, because an oscillation that the step resolves must not be damped.
///
/// In a fluid with inertia the velocities are those at the beginning of the step, where the
/// extensions are known, and theta = 2 z^2/(2 + z^2): a spring that the step resolves has the force
/// at that time up to the second order of the step, and a stiff one is damped. The limit 2 is above
/// 1 because the step extrapolates velocities by half of their change: with V = -x/theta, x^{n+1} =
/// x^n + 3/2 V^n - 1/2 V^{n-1} would not decay with theta = 1. S is not symmetric there, because
/// moving fluid carries the effect of a force along.
///
/// A S A^T of rows that depend on each other is singular, up to the errors of the answers. Its rank
/// is found without the springs, whose compliance 1/(theta h stiffness) may be far larger or
/// smaller than all other entries: the rows without stiffness are eliminated first, which leaves a
/// mobility for the springs.
class HeldSolver : public FluidSolver {
 public:
  /// `relative_error` > 0 is that of the answers of `solver`; `has_inertia` says whether its fluid
  /// has inertia.
  HeldSolver(std::unique_ptr<FluidSolver> solver, double relative_error, bool has_inertia);

  /// Sets the rows that hold from the next placement on, in steps of length h > 0 [T].
  void hold(std::vector<HeldRow> rows, double h);

  /// Besides the errors of the fluid solver, throws Error(kNotConverged), which names the rows, if
  /// they contradict each other.
  void place(const FluidParticles& bodies) override;
  std::vector<double> velocities(std::span<const double> forces, bool driving) override;
  FlowQuantities quantities() override { return solver_->quantities(); }
  double vary_penalty() override;
  SecondMesh vary_mesh() override;
  FlowField flow() override { return solver_->flow(); }
  void keep_flow(bool at_rest, std::span<const double> motions) override {
    solver_->keep_flow(at_rest, motions);
  }
  std::string saved_flow() override { return solver_->saved_flow(); }
  void load_flow(const std::string& flow) override { solver_->load_flow(flow); }
  std::size_t unknowns() const override { return solver_->unknowns(); }
  double peak_memory_mebibytes() const override { return solver_->peak_memory_mebibytes(); }

  /// velocities(forces, false) without springs, whose forces are then among `forces`.
  std::vector<double> velocities_without_springs(std::span<const double> forces);

  /// Adds forces in the rows that change the sum of each row without stiffness by `changes`, one
  /// number for each row [L/T, 1/T]. `with_springs`, the sum plus compliance times force of each
  /// spring changes by its number, too; otherwise springs keep their forces. Returns the forces [M
  /// L/T^2, M L^2/T^2]. No question is asked.
  std::vector<double> change(std::span<double> velocities, std::span<const double> changes,
                             bool with_springs) const;

  /// The forces of the rows without stiffness that change their sums as `changes` of the velocities
  /// do [L/T, 1/T].
  std::vector<double> row_forces_for(std::span<const double> changes) const;

  /// The theta of each row, 1/2 to 1, in a fluid with inertia up to 2; of rows without stiffness
  /// the least one.
  std::vector<double> thetas() const;

  /// True if row `r` is a spring whose oscillation is too fast for the step, or whose relaxation is
  /// shorter than it.
  bool is_stiff(std::size_t r) const { return theta(static_cast<Eigen::Index>(r)) > 2.0 / 3; }

  /// The forces of the rows in the last velocities(forces, true) [M L/T^2, M L^2/T^2].
  const std::vector<double>& row_forces() const { return row_forces_; }

  /// The forces on all particles of the springs and of the rows with a particle that accelerates,
  /// in the last velocities(forces, true). The extrapolation of FluidSimulation takes them for
  /// forces from outside, because they are those of the whole step.
  std::vector<double> forces_of_step() const;

  /// Adds forces in the rows until the rows without stiffness hold. No question is asked.
  void hold_velocities(std::span<double> velocities) const;

 private:
  Eigen::VectorXd sums(std::span<const double> velocities) const;
  Eigen::VectorXd missing(std::span<const double> velocities) const;
  void factorise();
  Eigen::MatrixXd solve_fixed(const Eigen::MatrixXd& right) const;
  void correct(const Eigen::VectorXd& right, std::span<const double> forces,
               Eigen::VectorXd& of_rows);
  Eigen::VectorXd solve(const Eigen::VectorXd& right, bool with_springs) const;
  void add_responses(std::span<double> velocities, const Eigen::VectorXd& forces) const;
  void add_row_forces(std::span<double> forces, const Eigen::VectorXd& of_rows) const;
  void check(const Eigen::VectorXd& right, const Eigen::VectorXd& forces) const;
  double theta(Eigen::Index r) const;

  std::unique_ptr<FluidSolver> solver_;
  double relative_error_;
  bool has_inertia_;
  double h_ = 0;
  std::vector<HeldRow> rows_;
  std::vector<std::vector<double>> responses_;  // S A^T of each row
  Eigen::MatrixXd matrix_;                      // A S A^T
  // The parts of the matrix in scaled rows: of the rows without stiffness (fixed), of springs for
  // forces of the fixed rows, and of the springs if the fixed rows hold.
  std::vector<Eigen::Index> fixed_, springs_;
  Eigen::VectorXd scale_;
  Eigen::MatrixXd fixed_matrix_, coupling_, spring_responses_, spring_matrix_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factor_;
  std::vector<double> row_forces_;
  bool is_varied_ = false;  // the fluid is another one than that of matrix_ and responses_
};

}  // namespace viscontact::particles
