// The motion of membranes in a Stokes flow, docs/physics.md (8.4) to (8.6). Users' programs compile
// without Eigen, so that no public header may include this one.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "viscontact/membranes/membrane_curve.hpp"
#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/links/membrane.hpp"

namespace viscontact::particles {

/// How the fluid moves the beads at given places: with the velocities `flow` + `mobility` * forces.
struct FluidAnswer {
  Eigen::VectorXd flow;      ///< velocities without forces on the beads, 2 beads() [L/T]
  Eigen::MatrixXd mobility;  ///< velocities per force [T/M], symmetric, 2 beads() rows
};

/// The forces of the membranes on the fluid at the beads, and the velocities of the beads.
struct MembraneMotion {
  Eigen::VectorXd forces;      ///< sum of the forces of bending, of tension and of loads [M L/T^2]
  Eigen::VectorXd velocities;  ///< [L/T]
  /// Tensions T of step() [M L/T^2], one number for each bead, between this bead and the next one.
  /// Only step() sets this array and the two that follow.
  Eigen::VectorXd tension;
  /// Pressures q of step(), one number for each membrane [M/T^2].
  Eigen::VectorXd pressure;
  Eigen::VectorXd flow_forces;  ///< `forces` minus those of the pressure, 2 beads() [M L/T^2]
};

/// How the result of Membranes::step() changes under small loads, with 2 beads() rows and a column
/// for each load, that is, for each column of `moves` of response().
struct LoadResponse {
  Eigen::MatrixXd positions;  ///< changes of the positions z of step() [L]
  Eigen::MatrixXd forces;     ///< changes of P f of step(), without the loads [M L/T^2]
};

/// All membranes of a case in a fluid, in any consistent units; M stands for a mass per length of
/// the third dimension. An array of all beads has x of the beads of the first membrane, of the
/// second one and so on, and then all y in the same order: 2 beads() numbers.
class Membranes {
 public:
  /// `membranes` must outlive this object.
  explicit Membranes(std::span<const Membrane> membranes);

  Eigen::Index beads() const { return first_.back(); }  ///< of all membranes

  /// Positions of all beads [L]. `positions` has two numbers for each particle. In a periodic
  /// domain each bead is taken at its image nearest to the bead before it, and the first bead of
  /// each membrane at its image nearest to its place in `near` [L], if this is given.
  Eigen::VectorXd places(std::span<const double> positions, const PeriodicCell& cell,
                         const Eigen::VectorXd* near = nullptr) const;

  /// An array of all beads, from the first two of the `components` numbers (of any unit) of each
  /// particle.
  Eigen::VectorXd from_particles(std::span<const double> numbers, std::size_t components) const;
  /// Writes the array `all` into the first two of the `components` numbers of each bead.
  void to_particles(const Eigen::VectorXd& all, std::size_t components,
                    std::vector<double>& numbers) const;

  /// The numbers of membrane `m`, from 0, in an array of all beads: x of its beads and then y.
  Eigen::VectorXd of(std::size_t m, const Eigen::VectorXd& all) const;
  /// The inverse of of().
  void put(std::size_t m, const Eigen::VectorXd& own, Eigen::VectorXd& all) const;

  /// Forces and velocities of the beads at `positions` [L], with tensions such that these
  /// velocities change no length. Sets the first two arrays of MembraneMotion.
  MembraneMotion motion_at(const Eigen::VectorXd& positions, const FluidAnswer& answer) const;

  /// Solves a step of the length `time`, implicit in bending and lengths. It finds positions z [L]
  /// and tensions T with
  ///
  ///     (z - from)/time = flow + mobility (loads + P f),
  ///     f = -grad E(z) - G(z)^T T,   lengths(z) kept,
  ///
  /// where E is the bending energy [M L^2/T^2], lengths(z) are the speeds of the curve halfway
  /// between beads (MembraneCurve::speeds), and G is the derivative of lengths(z). The pressure q
  /// inside a membrane exerts the forces q a, where a is the derivative of the area inside. These
  /// forces make no flow, because the fluid is incompressible, and are therefore subtracted: P f =
  /// f - q a, with q such that the inner product of a and P f is 0 for each membrane. At the end z
  /// is changed by the smallest displacements with which lengths and areas are exact.
  ///
  /// The caller's time scheme sets `from` [L] and `time` [T]. `loads` are further forces on the
  /// beads [M L/T^2]. `positions` is a first guess of z before, and z afterwards [L]. Throws
  /// Error(kNotConverged) if Newton's method fails, also with a series of shorter steps, or if no
  /// places near z have exact lengths and areas; `positions` are then undefined.
  MembraneMotion step(const Eigen::VectorXd& from, double time, const FluidAnswer& answer,
                      const Eigen::VectorXd& loads, Eigen::VectorXd& positions) const;

  /// How the result of step() changes to first order under small further loads. The other arguments
  /// are those of step(), what it returned, and the positions after it. A column of `moves` [L] has
  /// the displacements that a load would cause without the membranes, whose bending forces and
  /// tensions oppose them.
  LoadResponse response(double time, const FluidAnswer& answer, const Eigen::VectorXd& loads,
                        const MembraneMotion& motion, const Eigen::VectorXd& positions,
                        const Eigen::MatrixXd& moves) const;

 private:
  // Newton's method. `positions`, and the tensions and pressures of `motion`, are first guesses
  // before, and the solution afterwards. Returns false if the method has not converged.
  bool solve_step(const Eigen::VectorXd& from, double time, const FluidAnswer& answer,
                  Eigen::VectorXd& positions, MembraneMotion& motion) const;
  // The derivative of the equations of step(). The unknowns are scaled to lengths: the positions
  // [L]; the tensions over `unit`, a force per length [M/T^2]; and the pressures times the norm of
  // their column of area_columns(), over `unit`. MembraneMotion::flow_forces must not contain the
  // loads.
  Eigen::MatrixXd step_matrix(double time, const FluidAnswer& answer,
                              const Eigen::VectorXd& positions, const MembraneMotion& motion,
                              double unit) const;
  // Derivatives of the areas by the positions [L], a column for each membrane.
  Eigen::MatrixXd area_columns(const Eigen::VectorXd& positions) const;
  // Derivatives of the speeds of all curves by the positions [1].
  Eigen::MatrixXd speed_rows(const Eigen::VectorXd& positions) const;
  Eigen::VectorXd bending_forces(const Eigen::VectorXd& positions) const;
  // Second derivatives of bending energy plus tensions times speeds plus pressures times areas
  // [M/T^2].
  Eigen::MatrixXd stiffness(const Eigen::VectorXd& positions, const MembraneMotion& motion) const;

  std::span<const Membrane> membranes_;
  std::vector<MembraneCurve> curves_;
  // Place of the first bead of each membrane among all beads; the last entry is their number.
  std::vector<Eigen::Index> first_;
};

}  // namespace viscontact::particles
