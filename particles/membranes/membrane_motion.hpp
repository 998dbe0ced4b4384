// The motion of membranes in a Stokes flow, docs/physics.md (8.4) to (8.6). A membrane is a closed
// curve through particles, its beads. The fluid is given by the velocities of the beads that follow
// from forces on them (FluidAnswer). Lengths, masses and times are in the units of the case; masses
// and forces are per unit length of the third dimension. An array of all beads has x of the beads
// of the first membrane, of the second one and so on, and then all y in the same order.
// membrane_simulation.cpp uses it. Only sources of this folder and tests may include this header,
// because users of the library need no Eigen. A change must keep lengths and areas exact after each
// step, and the second order in time.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/membranes/membrane.hpp"
#include "viscontact/particles/membranes/membrane_curve.hpp"

namespace viscontact::particles {

/// The answer of the fluid at one placement: the velocities `flow` + `mobility` * forces.
struct FluidAnswer {
  Eigen::VectorXd flow;      ///< without forces on the beads [L/T]
  Eigen::MatrixXd mobility;  ///< [T/M], symmetric
};

/// Forces of the membranes on the fluid at the beads, and the velocities that they give the beads.
struct MembraneMotion {
  Eigen::VectorXd forces;      ///< sum of bending, tension and loads [M L/T^2]
  Eigen::VectorXd velocities;  ///< [L/T]
  /// T of step() [M L/T^2], one number for each bead: it keeps the length between this bead and the
  /// next one. Only step() sets this array and the two that follow.
  Eigen::VectorXd tension;
  Eigen::VectorXd pressure;     ///< q of step(), one number for each membrane [M/T^2]
  Eigen::VectorXd flow_forces;  ///< P f + loads of step(): `forces` without the pressure [M L/T^2]
};

/// How the result of a step changes under small loads: a column for each load.
struct LoadResponse {
  Eigen::MatrixXd positions;  ///< changes of the positions z of step() [L]
  Eigen::MatrixXd forces;  ///< changes of P f of step(), which do not contain the loads [M L/T^2]
};

/// All membranes of a case.
class Membranes {
 public:
  /// The membranes must outlive this object.
  explicit Membranes(std::span<const Membrane> membranes);

  Eigen::Index beads() const { return first_.back(); }  ///< number of beads of all membranes

  /// Positions of all beads, from those of all particles, two numbers for each. In a periodic
  /// domain beads may be in different periods; each one is taken at the image nearest to the bead
  /// before it and, with `near`, the first bead of each membrane at that nearest to its place in
  /// `near`.
  Eigen::VectorXd places(std::span<const double> positions, const PeriodicCell& cell,
                         const Eigen::VectorXd* near = nullptr) const;

  /// The first two numbers of each bead. `numbers` has `components` >= 2 numbers for each particle.
  Eigen::VectorXd from_particles(std::span<const double> numbers, std::size_t components) const;
  /// Writes `all`, two numbers for each bead, into `numbers`, the inverse of from_particles().
  void to_particles(const Eigen::VectorXd& all, std::size_t components,
                    std::vector<double>& numbers) const;

  /// The positions of one membrane, x of all of its beads and then y, from those of all.
  Eigen::VectorXd of(std::size_t m, const Eigen::VectorXd& all) const;
  /// Puts the numbers of one membrane into those of all.
  void put(std::size_t m, const Eigen::VectorXd& own, Eigen::VectorXd& all) const;

  /// The motion at one moment: bending forces are those at `positions`, and the tensions are such
  /// that no length changes at these velocities.
  MembraneMotion motion_at(const Eigen::VectorXd& positions, const FluidAnswer& answer) const;

  /// Solves a step that is implicit in bending and lengths: positions z, forces f and the
  /// velocities
  ///
  ///     (z - from)/time = flow + mobility (loads + P f),
  ///     f = -grad E(z) - G(z)^T T,   lengths(z) kept,
  ///
  /// where E is the bending energy and T the tensions. lengths(z) are |dx/ds| halfway between beads
  /// (MembraneCurve::speeds), and G is their derivative. The pressure q inside a membrane exerts
  /// the force q a, where a is the derivative of the area inside. It makes no flow, because the
  /// fluid is incompressible, and is therefore left out: P f = f - q a, with q such that a.(P f) =
  /// 0 for each membrane. After Newton's method the function changes z by the smallest
  /// displacements with which lengths and areas are exact. `positions` is a first guess, and z
  /// afterwards. Throws Error(kNotConverged) if Newton's method fails.
  MembraneMotion step(const Eigen::VectorXd& from, double time, const FluidAnswer& answer,
                      const Eigen::VectorXd& loads, Eigen::VectorXd& positions) const;

  /// The linear response of step() to small loads, one column for each load. A column of `moves`
  /// [L] has the displacements that the load alone would cause; the response also has the bending
  /// forces and tensions that oppose them. `motion` is what step() returned with these positions.
  LoadResponse response(double time, const FluidAnswer& answer, const MembraneMotion& motion,
                        const Eigen::VectorXd& positions, const Eigen::MatrixXd& moves) const;

 private:
  bool solve_step(const Eigen::VectorXd& from, double time, const FluidAnswer& answer,
                  Eigen::VectorXd& positions, MembraneMotion& motion) const;
  Eigen::MatrixXd step_matrix(double time, const FluidAnswer& answer,
                              const Eigen::VectorXd& positions, const MembraneMotion& motion,
                              double unit) const;
  Eigen::MatrixXd area_columns(const Eigen::VectorXd& positions) const;
  Eigen::MatrixXd speed_rows(const Eigen::VectorXd& positions) const;
  Eigen::VectorXd bending_forces(const Eigen::VectorXd& positions) const;
  Eigen::MatrixXd stiffness(const Eigen::VectorXd& positions, const MembraneMotion& motion) const;

  std::span<const Membrane> membranes_;
  std::vector<MembraneCurve> curves_;
  std::vector<Eigen::Index> first_;  // first bead of each membrane; the last entry counts all
};

}  // namespace viscontact::particles
