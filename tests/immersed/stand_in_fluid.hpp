// A fluid solver for tests: a given resistance matrix in place of a flow. Lengths, masses and times
// are in any one consistent system of units.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/immersed/fluid_simulation.hpp"

namespace viscontact::particles {

/// The forces and torques of the particles on the fluid for their velocities: a symmetric, positive
/// definite matrix with motion_components() rows for each particle [M/T].
using Resistance = std::function<Eigen::MatrixXd(const Particles&)>;

/// Free particles take the velocities v with R (v - u) + inertia v = forces, where R is the
/// resistance matrix. The flow u without particles is 0, except in a sheared cell, where it is the
/// mean flow at their places, docs/physics.md (6.3). The object counts its questions.
///
/// With the masses of a FlowStep it is a fluid with inertia whose flow has no momentum of its own:
/// its kept flow is the velocities of the particles.
class StandInFluid : public FluidSolver {
 public:
  explicit StandInFluid(Resistance resistance) : resistance_(std::move(resistance)) {}

  void place(const FluidParticles& bodies) override;
  std::vector<double> velocities(std::span<const double> forces, bool driving) override;
  FlowQuantities quantities() override;
  double vary_penalty() override { return 0; }
  SecondMesh vary_mesh() override;
  FlowField flow() override { return {}; }
  void keep_flow(bool at_rest, std::span<const double> motions) override;
  std::string saved_flow() override;
  void load_flow(const std::string& flow) override;
  std::size_t unknowns() const override { return 0; }

  int placements = 0,  ///< number of calls of place()
      solutions = 0;   ///< number of calls of velocities()
  /// The question with this number, from 0, throws; < 0: none does.
  int fails_at = -1;
  /// Drag on the second mesh divided by that on the first one, > 0.
  double drag_of_second_mesh = 1;
  SecondMesh second_mesh;

 private:
  void count();
  void factorise();
  Resistance resistance_;
  std::size_t components_ = 3;
  std::vector<char> is_driven_;
  Eigen::VectorXd flow_, given_, last_;
  Eigen::VectorXd momentum_;                // of the kept flows, over the length of the step
  std::vector<double> kept_, kept_before_;  // velocities; empty: none
  Eigen::MatrixXd drag_, matrix_, inverse_;
};

/// The mean flow of a sheared cell at x [L/T], which is 0 in the middle of the cell.
Vector mean_velocity(const PeriodicCell& cell, const Vector& x);

/// The same drag [M/T] for each component of each particle.
Resistance constant_drag(double drag);

/// A simulation in a stand-in fluid with viscosity 1.
struct InFluid {
  Setting setting;
  State state;
  StandInFluid* fluid = nullptr;  ///< of the last simulation made
  FluidSimulation simulation(Resistance resistance);
};

/// No particles, in a closed cylinder (dimension 1) or a box of this width (dimension 2), with the
/// time step h [T] and the threshold gap [L].
InFluid in_fluid(int dimension, double width, double h, double threshold_gap);

/// Adds a homogeneous disc of radius 0.1 that does not turn.
void add_disc(InFluid& system, const Vector& at, double mass, const Vector& velocity);

/// Adds a particle with a force that acts on it at all times [M L/T^2].
void add_pushed(InFluid& system, const Vector& position, double radius, double mass,
                const Vector& force);

/// Steps until the time is `end`. Returns the largest residuals and the sum of the iterations.
StepReport run(FluidSimulation& simulation, double end);

}  // namespace viscontact::particles
