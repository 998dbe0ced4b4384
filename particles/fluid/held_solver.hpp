// A fluid whose particles are held by rigid bodies, hinges, springs and arms, docs/physics.md
// (6.7). Each of these puts linear conditions on velocities, which are called rows. Lengths [L],
// masses [M] and times [T] are in any consistent units. An array of velocities [L/T, 1/T] or forces
// [M L/T^2, M L^2/T^2] of particles has motion_components() numbers for each particle. An array for
// rows has one number for each row of hold() and is empty without rows. Sizes and the order of
// calls are not checked. Rows that contradict each other throw Error(kNotConverged); all other
// errors are those of the fluid solver. fluid_simulation.cpp, fluid_links.cpp and held_rows.hpp use
// the class. A change must keep that rows that follow from each other are no error.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::particles {

/// A linear condition on the velocities of all particles. Its sum adds coefficient times velocity
/// over all `entries`, and `image_rate`. The condition is sum = `rate`. For a spring it is force =
/// -stiffness (extension + theta h sum), with the length h of the step and the number theta, which
/// HeldSolver explains.
struct HeldRow {
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
  std::string name{};  ///< name of the body or link in messages of errors
  /// True if the row is the geometric stiffness of forces, docs/physics.md (6.15): it turns these
  /// forces with the motion. Such a row is a spring whose stiffness is that of `of_forces` plus the
  /// constant `stiffness`, which may then have any sign, or 0 if this is negative.
  bool is_geometric = false;
  /// Of a geometric row: numbers of other rows, and the stiffness per force of each of them [1/L,
  /// L].
  std::vector<std::pair<std::size_t, double>> of_forces{};

  /// True if the row is a spring, of whatever kind.
  bool is_spring() const { return is_geometric || stiffness > 0; }
};

/// A fluid solver that holds the particles: it adds forces along the rows with which the conditions
/// hold, and asks the fluid solver that it owns.
///
/// With the mobility S of the fluid (velocities per force), forces f of the caller and the matrix A
/// of the coefficients of the rows, the velocities are v = S (f + A^T l), and the forces l of the
/// rows solve A S A^T l = rate - A S f. place() asks the fluid solver for velocities once for each
/// row. velocities() asks it once, or twice if `driving` is true.
///
/// Springs have theta = (1 + z)/(2 + z) with z = h stiffness (A S A^T)_rr of their row r. If an end
/// of the spring accelerates, z^2 takes the place of z. An oscillation of angular frequency omega
/// has z = (omega h)^2 theta, and theta is then nearly 1/2, without damping, if omega h is small.
///
/// In a fluid with inertia the velocities are those at the beginning of the step, where the
/// extensions are known, and theta = 2 z^2/(2 + z^2). A spring whose motion the step resolves then
/// has the force at that time up to the second order of the step, and a stiff spring is damped. The
/// limit 2 of theta is above 1, because the step extrapolates velocities by half of their change:
/// the extension x of a stiff spring, with h V = -x/theta, obeys x^{n+1} = x^n + h (3/2 V^n -
/// 1/2 V^{n-1}), which would not decay with theta = 1. S is not symmetric in such a fluid, because
/// moving fluid carries the effect of a force along.
///
/// A geometric row has the same theta, or, if an end accelerates, (1 + z^4)/(2 + z^4). Its z is the
/// sum of h sqrt(k_r k_s) |A S A^T|_rs over all geometric rows s with their stiffnesses k, where S is
/// the mobility that the rows without stiffness leave. Geometric rows of neighbouring links act on
/// one particle; with this z no motion across a chain overshoots. Without inertia and masses it then
/// decays monotonically for every h. Where z is small, the step resolves the motion and the row does
/// not act: its stiffness counts as 0.
///
/// If rows depend on each other, A S A^T is singular up to the errors of the velocities. The
/// compliance 1/(theta h stiffness) of a spring may be far larger or smaller than the entries of
/// A S A^T. Therefore the rank is found only for the rows without stiffness. These rows are then
/// eliminated, which leaves a mobility for the springs.
class HeldSolver : public FluidSolver {
 public:
  /// `solver` must not be null. `relative_error` [1], > 0, is the relative error of its velocities.
  /// `has_inertia` says whether its fluid has inertia.
  HeldSolver(std::unique_ptr<FluidSolver> solver, double relative_error, bool has_inertia);

  /// Sets the rows that hold from the next place() on, in steps of length h > 0 [T]. If `rows` is
  /// empty, the particles are not held. place() must follow before any other function.
  void hold(std::vector<HeldRow> rows, double h);

  void place(const FluidParticles& bodies) override;
  /// Takes the geometric rows `rows` after place(). The first ones, as many as there are geometric
  /// rows already, replace the constant stiffnesses of these; the others are added, and the fluid
  /// solver is asked once for each of them.
  void turn_with(std::span<const HeldRow> rows);

  /// Finds the stiffnesses of the geometric rows from the forces that all rows have under `forces`
  /// of the caller. Keeps the stiffnesses of before and returns false if none of them differs from
  /// its new value by more than `tolerance` [1], >= 0, times the larger of both. Asks the fluid
  /// solver once.
  bool settle_stiffnesses(std::span<const double> forces, double tolerance);

  /// The forces of the rows under `forces` of the caller. Asks the fluid solver once.
  std::vector<double> row_forces_under(std::span<const double> forces);

  /// Returns the velocities with which the rows hold. If `driving` is false, the prescribed sums,
  /// the motions of images and the extensions of springs are taken as 0. If `driving` is true and
  /// rows contradict each other, throws Error(kNotConverged), which names these rows. Also throws
  /// the errors of the fluid solver.
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

  /// Returns the same as velocities(forces, false), but without forces of springs: the rows without
  /// stiffness have the sum 0. Throws the errors of the fluid solver.
  std::vector<double> velocities_without_springs(std::span<const double> forces);

  /// Changes `velocities` by forces along the rows. They change the sum of each row without
  /// stiffness by its number in `changes` [L/T, 1/T]. If `with_springs` is true, they also change,
  /// for each spring, the sum plus compliance times force by its number; otherwise springs keep
  /// their forces. Returns the added forces of all rows. The fluid solver is not asked.
  std::vector<double> change(std::span<double> velocities, std::span<const double> changes,
                             bool with_springs) const;

  /// Returns the forces of the rows without stiffness that change the sums of these rows by as much
  /// as a change of the velocities of all particles by `changes` does; 0 for springs.
  std::vector<double> row_forces_for(std::span<const double> changes) const;

  /// The theta of each row [1]. That of a spring is from 1/2 to 1, in a fluid with inertia from
  /// 1e-9 to 2; that of another row is the smaller one of these bounds.
  std::vector<double> thetas() const { return thetas_; }
  /// The stiffness of each row, >= 0 [M/T^2, M L^2/T^2]; 0 if the row is no spring.
  const std::vector<double>& stiffnesses() const { return stiffnesses_; }
  /// True if row `r` is a spring with theta > 2/3, which means that the step does not resolve its
  /// motion. This is so if z > 1 for the z of this class.
  bool is_stiff(std::size_t r) const { return thetas_[r] > 2.0 / 3; }

  /// The forces of the rows in the last velocities(forces, true) [M L/T^2, M L^2/T^2]; empty before
  /// the first such call.
  const std::vector<double>& row_forces() const { return row_forces_; }

  /// The forces and torques [M L/T^2, M L^2/T^2] that the springs, the rows with a particle that
  /// accelerates, and the rows of whose forces a geometric row has a stiffness, exerted on all
  /// particles in the last velocities(forces, true); empty without rows.
  std::vector<double> forces_of_step() const;

  /// Changes `velocities` by forces along the rows until the rows without stiffness hold. The fluid
  /// solver is not asked.
  void hold_velocities(std::span<double> velocities) const;

 private:
  Eigen::VectorXd sums(std::span<const double> velocities) const;
  Eigen::VectorXd missing(std::span<const double> velocities) const;
  void respond();
  void factorise();
  void set_stiffnesses(std::vector<double> stiffnesses);
  std::vector<double> stiffnesses_for(const Eigen::VectorXd& of_rows) const;
  Eigen::VectorXd given() const;
  Eigen::MatrixXd solve_fixed(const Eigen::MatrixXd& right) const;
  void correct(const Eigen::VectorXd& right, std::span<const double> forces,
               Eigen::VectorXd& of_rows);
  Eigen::VectorXd solve(const Eigen::VectorXd& right, bool with_springs) const;
  void add_responses(std::span<double> velocities, const Eigen::VectorXd& forces) const;
  void add_row_forces(std::span<double> forces, const Eigen::VectorXd& of_rows) const;
  void check(const Eigen::VectorXd& right, const Eigen::VectorXd& forces) const;
  double theta_for(double z, const HeldRow& row) const;
  std::vector<double> rates_of_turning(const std::vector<double>& stiffnesses) const;

  std::unique_ptr<FluidSolver> solver_;
  double relative_error_;
  bool has_inertia_;
  double h_ = 0;             // [T]
  std::size_t motions_ = 0;  // length of arrays of velocities
  std::vector<HeldRow> rows_;
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
