// A fluid solver whose particles are held by rigid bodies, hinges, springs and arms,
// docs/physics.md (6.7).
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"

namespace viscontact::particles {

/// A linear condition on the velocities of all particles. Its sum adds coefficient times velocity
/// over all `entries`, and `image_rate`. The condition is sum = `rate`. For a spring it is force =
/// -stiffness (extension + theta h sum), with the length h of the step and the number theta, which
/// ConstrainedSolver explains.
struct VelocityConstraint {
  /// Places of velocities in the array of all particles (MotionLayout), with their coefficients
  /// [1]. The coefficient of an angular velocity in a sum that is a velocity is in [L].
  std::vector<std::pair<std::size_t, double>> entries;
  double rate = 0;  ///< prescribed sum [L/T, 1/T]; not used for a spring
  /// Part of the sum [L/T] that the motion of periodic images relative to their particles causes in
  /// a sheared cell.
  double image_rate = 0;
  double stiffness = 0;  ///< of a spring [M/T^2, M L^2/T^2], > 0; 0: the row is no spring
  double extension = 0;  ///< of a spring at the beginning of the step [L, rad]; else not used
  /// True if a particle of the row accelerates, that is, has a mass and no given motion.
  bool accelerates = false;
  std::string name{};  ///< of the body or link, for messages of errors
  /// True if the row is the geometric stiffness of forces, docs/physics.md (6.15): it turns these
  /// forces with the motion. Such a row is a spring whose stiffness is that of `of_forces` plus the
  /// constant `stiffness`, which may then have any sign, or 0 if this is negative.
  bool is_geometric = false;
  /// Of a geometric row: numbers of other rows, and the stiffness per force of each of them [1/L,
  /// L].
  std::vector<std::pair<std::size_t, double>> of_forces{};

  bool is_spring() const { return is_geometric || stiffness > 0; }
};

/// A fluid solver that holds the particles: it adds forces along the rows with which the conditions
/// hold, and asks the fluid solver that it owns. Arrays of velocities and forces are those of
/// FluidSolver. Arrays for rows have one number for each row and are empty without rows. Rows that
/// follow from each other are no error; they get the smallest forces.
///
/// With the mobility S of the fluid (velocities per force), forces f of the caller and the matrix A
/// of the coefficients of the rows, the velocities are v = S (f + A^T l), and the forces l of the
/// rows solve A S A^T l = rate - A S f. place() asks the fluid solver for velocities once for each
/// row, velocities() once, or twice if `driving` is true.
///
/// Springs have theta = (1 + z)/(2 + z) with z = h stiffness (A S A^T)_rr of their row r; if an end
/// accelerates, z^2 takes the place of z. In a fluid with inertia the velocities are those at the
/// beginning of the step, where the extensions are known, S is not symmetric, and theta = 2 z^2/(2
/// + z^2). Its limit 2 is above 1, because the step extrapolates velocities by half of their
/// change: the extension x of a stiff spring, with h V = -x/theta, obeys x^{n+1} = x^n + h (3/2 V^n
/// - 1/2 V^{n-1}), which would not decay with theta = 1.
///
/// Geometric rows (6.15) have the same theta, or (1 + z^4)/(2 + z^4) if an end accelerates. Their z
/// is the sum of h sqrt(k_r k_s) |A S A^T|_rs over all geometric rows s with the stiffnesses k,
/// where S is the mobility that the rows without stiffness leave. Where z is small, the step
/// resolves the motion, and the stiffness of the row counts as 0.
///
/// If rows depend on each other, A S A^T is singular up to the errors of the velocities, and the
/// compliance 1/(theta h stiffness) of a spring may be far larger or smaller than its entries.
/// Therefore the rank is found only for the rows without stiffness, which are then eliminated.
class ConstrainedSolver : public FluidSolver {
 public:
  /// `relative_error` [1] is that of the velocities of `solver`, whose fluid may have inertia.
  ConstrainedSolver(std::unique_ptr<FluidSolver> solver, double relative_error, bool has_inertia);

  /// Sets the rows that hold from the next place() on, in steps of length h > 0 [T]. place() must
  /// follow before any other function.
  void hold(std::vector<VelocityConstraint> rows, double h);

  void place(const FluidParticles& bodies) override;
  /// Takes the geometric rows `rows` after place(). The first ones, as many as there are geometric
  /// rows already, replace the constant stiffnesses of these; the others are added, and the fluid
  /// solver is asked once for each of them.
  void turn_with(std::span<const VelocityConstraint> rows);

  /// Finds the stiffnesses of the geometric rows from the forces of all rows under `forces` of the
  /// caller. Keeps the stiffnesses of before and returns false if none differs from its new value
  /// by more than `tolerance` [1] times the larger of both. Asks the fluid solver once.
  bool settle_stiffnesses(std::span<const double> forces, double tolerance);

  /// The forces of the rows under `forces` of the caller. Asks the fluid solver once.
  std::vector<double> row_forces_under(std::span<const double> forces);

  /// The velocities with which the rows hold. If `driving` is false, the prescribed sums, the
  /// motions of images and the extensions of springs are taken as 0. If it is true and rows
  /// contradict each other, throws Error(kNotConverged), which names these rows.
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

  /// The same as velocities(forces, false), but without forces of springs: the rows without
  /// stiffness have the sum 0.
  std::vector<double> velocities_without_springs(std::span<const double> forces);

  /// Changes `velocities` by forces along the rows, which it returns. They change the sum of each
  /// row without stiffness by its number in `changes` [L/T, 1/T]. If `with_springs` is true, they
  /// also change, for each spring, the sum plus compliance times force by its number; otherwise
  /// springs keep their forces. The fluid solver is not asked.
  std::vector<double> change(std::span<double> velocities, std::span<const double> changes,
                             bool with_springs) const;

  /// The forces of the rows without stiffness that change their sums by as much as a change of all
  /// velocities by `changes` does.
  std::vector<double> row_forces_for(std::span<const double> changes) const;

  /// The theta of each row [1]. That of a spring is from 1/2 to 1, in a fluid with inertia from
  /// 1e-9 to 2; that of another row is the smaller one of these bounds.
  std::vector<double> thetas() const { return thetas_; }
  /// >= 0 [M/T^2, M L^2/T^2]; 0 if the row is no spring.
  const std::vector<double>& stiffnesses() const { return stiffnesses_; }
  /// True if row `r` is a spring whose motion the step does not resolve: theta > 2/3, or z > 1.
  bool is_stiff(std::size_t r) const {
    assert(r < thetas_.size());
    return thetas_[r] > 2.0 / 3;
  }

  /// In the last velocities(forces, true) [M L/T^2, M L^2/T^2]; empty if it was not called after
  /// the last place().
  const std::vector<double>& row_forces() const { return row_forces_; }

  /// The forces and torques on all particles of springs, of rows with a particle that accelerates,
  /// and of rows of whose forces a geometric row has a stiffness, in the last
  /// velocities(forces, true).
  std::vector<double> forces_of_step() const;

  /// Changes `velocities` by forces along the rows until the rows without stiffness hold.
  void hold_velocities(std::span<double> velocities) const;

 private:
  /// A v, without VelocityConstraint::image_rate.
  Eigen::VectorXd sums(std::span<const double> velocities) const;
  /// VelocityConstraint::rate, 0 for a spring, minus the sum with these velocities.
  Eigen::VectorXd missing(std::span<const double> velocities) const;
  void respond();
  void factorise();
  void set_stiffnesses(std::vector<double> stiffnesses);
  std::vector<double> stiffnesses_for(const Eigen::VectorXd& of_rows) const;
  /// The value that each row prescribes for its sum, or, if it is a spring, for its sum plus its
  /// compliance times its force.
  Eigen::VectorXd given() const;
  /// The scaled forces of fixed_ rows whose effect on their scaled sums is `right`.
  Eigen::MatrixXd solve_fixed(const Eigen::MatrixXd& right) const;
  /// Corrects `of_rows`, which were found with the mobility at place(), for the other mesh or
  /// penalty that the fluid solver has now. `right` is given().
  void correct(const Eigen::VectorXd& right, std::span<const double> forces,
               Eigen::VectorXd& of_rows);
  /// The forces of the rows for `right`, as in change().
  Eigen::VectorXd solve(const Eigen::VectorXd& right, bool with_springs) const;
  void add_responses(std::span<double> velocities, const Eigen::VectorXd& forces) const;
  void add_row_forces(std::span<double> forces, const Eigen::VectorXd& of_rows) const;
  /// Throws Error(kNotConverged) if the forces do not add `right` to the sums of fixed_ rows.
  void check(const Eigen::VectorXd& right, const Eigen::VectorXd& forces) const;
  double theta_for(double z, const VelocityConstraint& row) const;
  std::vector<double> rates_of_turning(const std::vector<double>& stiffnesses) const;

  std::unique_ptr<FluidSolver> solver_;
  double relative_error_;
  bool has_inertia_;
  double h_ = 0;
  std::size_t motions_ = 0;  // length of arrays of velocities
  std::vector<VelocityConstraint> rows_;
  std::vector<double> stiffnesses_, thetas_;
  std::vector<std::vector<double>> responses_;  // velocities by a unit force of each row: S A^T
  Eigen::MatrixXd matrix_;                      // A S A^T
  // Numbers of the rows without stiffness (fixed) and of the springs.
  std::vector<Eigen::Index> fixed_, springs_;
  Eigen::VectorXd scale_;  // factor of each row with which the diagonal of the matrix is 1
  // The next four are for rows that are multiplied by scale_. fixed_matrix_ is matrix_ of the fixed
  // rows. coupling_ has the sums of springs by unit forces of fixed rows, spring_responses_ the
  // forces of fixed rows that undo the effect of a spring on these rows, and spring_matrix_ is the
  // matrix of the springs with these forces.
  Eigen::MatrixXd fixed_matrix_, coupling_, spring_responses_, spring_matrix_;
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factor_;  // of fixed_matrix_
  std::vector<double> row_forces_;
  bool is_varied_ = false;  // the fluid solver has another mesh or penalty than at place()
};

}  // namespace viscontact::particles
