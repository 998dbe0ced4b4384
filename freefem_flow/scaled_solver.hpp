// A fluid solver that computes in units of its own, so that its rounding errors and thresholds do
// not depend on the units of the case.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::freefem_flow {

/// The units in which the solver computes: in them the smallest particle has a radius and the fluid
/// a viscosity between 0.7 and 1.5. Both are powers of 2, so that no digit changes. The unit of time
/// is that of the case.
struct SolverUnits {
  double length = 1;     ///< [L], > 0
  double viscosity = 1;  ///< [M/(L T)], > 0
};

/// `radii` of all particles [L]; without particles the size of the domain takes their place.
SolverUnits solver_units(const particles::Fluid& fluid, const particles::Domain& domain,
                         std::span<const double> radii);

/// The fluid with its numbers in the units of the solver.
particles::Fluid in_units(particles::Fluid fluid, const SolverUnits& units);
/// The domain with its lengths and velocities in the units of the solver.
particles::Domain in_units(particles::Domain domain, const SolverUnits& units);
/// The lengths [L] in the unit of the solver.
std::vector<double> in_units(std::span<const double> lengths, const SolverUnits& units);

/// Passes questions in the units of the case to a solver in units of its own.
class ScaledSolver : public particles::FluidSolver {
 public:
  /// `dimension`: 2 in the plane, 1 on the axis of a cylinder.
  ScaledSolver(const SolverUnits& units, int dimension,
               std::unique_ptr<particles::FluidSolver> solver);

  // Arguments and results are in the units of the case. The errors are those of FluidSolver.

  /// Takes new places of the particles.
  void place(const particles::FluidParticles& bodies) override;
  /// The velocities under `forces`; with `driving`, walls and driven particles move.
  std::vector<double> velocities(std::span<const double> forces, bool driving) override;
  /// Quantities of the last velocities(forces, true).
  particles::FlowQuantities quantities() override;
  /// Takes another penalty; see FluidSolver.
  double vary_penalty() override { return solver_->vary_penalty(); }
  /// Takes a second mesh; see FluidSolver.
  particles::SecondMesh vary_mesh() override { return solver_->vary_mesh(); }
  /// Velocity and pressure of the last velocities(forces, true).
  particles::FlowField flow() override;
  /// Number of unknowns of the last mesh; 0 if the solver does not say.
  std::size_t unknowns() const override { return solver_->unknowns(); }
  /// The largest resident memory of the solver so far [MiB]; 0 if it is no process of its own.
  double peak_memory_mebibytes() const override { return solver_->peak_memory_mebibytes(); }

 private:
  /// Forces and torques in the units of the solver.
  std::vector<double> scaled_forces(std::span<const double> forces) const;
  void unscale_velocities(std::vector<double>& velocities) const;

  SolverUnits units_;
  std::size_t components_;
  // The units of the components of a particle's motion, and of forces and torques on it.
  std::array<double, 3> velocity_units_{}, force_units_{};
  double power_unit_ = 1;  ///< unit of the dissipation
  std::unique_ptr<particles::FluidSolver> solver_;
};

}  // namespace viscontact::freefem_flow
