// Simulates rigid particles in a fluid with viscous contact, docs/physics.md (6.1) to (6.5)
// (Lefebvre 2007, "Fluid-particle simulations with FreeFem++"; Lefebvre 2009, "Numerical simulation
// of gluey particles"). Lengths, masses and times are in any consistent units. fluid_motion.hpp and
// particles/run/ use it. A change must keep that a run which was interrupted and continued gives
// the same bits as a run without a break.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/particles/impacts/rebound.hpp"
#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

class HeldMotion;
class HeldSolver;
class StepEquation;
struct ContactConditions;
struct FluidBlow;
struct StepContacts;

/// Estimates of the errors of the forces of one step, each >= 0 [M L/T^2, M L^2/T^2]; both are
/// empty if they were not made.
struct ForceErrors {
  std::vector<double> of_fluid;  ///< of FluidSimulation::fluid_forces()
  std::vector<double> of_links;  ///< of State::link_forces
};

/// Rigid particles in a fluid. Each step asks the fluid solver for the velocities that the
/// particles take at their places x^n under forces, torques and contact impulses, and moves them:
///
/// - coupling = constrained: the impulses are forces in the problem of the fluid;
/// - coupling = splitting: the velocities of the fluid are projected in the norm of the masses.
///
/// Away from contact a step is of second order. S^n g are the velocities that the fluid gives the
/// particles at x^n under the forces g. M are the masses, and theta, from 1/2 to 1, says how
/// implicit the step is (both in step_equation.hpp); g^n contains M/(theta h) u^n, with the
/// velocity u^n at the time t^n. F^{n-1} are the forces on the fluid in the step before, and h^n =
/// h. A step is
///
///     U = S^n g^n,   U^+ = U + (h^n/(2 h^{n-1})) (S^n g* - U^{n-1}),   x^{n+1} = x^n + h U^+,
///     g* = F^{n-1} + M/(theta h) U^{n-1},
///
/// in which the second term of U^+ estimates by how much the velocities change in half a step
/// because the particles move. Without inertia and with a constant force g* = g^n, so that this is
/// the formula of Adams and Bashforth; it remains of second order where a force jumps. Links act
/// where the particles are in the middle of the step if a particle has mass, and U^{n-1} is
/// replaced by the nearest velocities that the links allow (6.7). A particle that was in contact in
/// the step before moves with U, which is of first order; all particles do in a step in which a
/// given motion jumps.
///
/// In a fluid with inertia (docs/physics.md (6.9)) the solver has the masses, and U^n is the
/// velocity at the time t^n of x^n. Away from contact the particles move with
///
///     U^+ = U^n + (h^n/(2 h^{n-1})) (U^n - U^{n-1}).
///
/// The first step computes U^1 at x^0, and moves the particles by (U^0 + U^1)/2. The second step
/// computes U^1 again, at x^1, and with it the impulses of the contacts. Therefore films do not
/// remember the impulses of the first step: each film must absorb them once only.
class FluidSimulation {
 public:
  /// `setting.fluid` must have a value. `state` is what read_restart returned, or a state of which
  /// only the particles are set.
  FluidSimulation(Setting setting, State state, std::unique_ptr<FluidSolver> solver);

  /// Computes one step of length h, shorter if `end` [T] is nearer; see Simulation::step. In the
  /// first step of a simulation and in the step that reaches `end`, it estimates the error of the
  /// velocities and forces. Throws Error(kNotConverged) if no solution of the contacts is found
  /// that keeps overlaps below the mean radius, or if a particle moves too far for the precision of
  /// a double; and the errors of FluidSolver. The state is then that before the step.
  StepReport step(double end);

  /// Forces of the caller on the particles [M L/T^2]; see Simulation::added_forces. Those of driven
  /// particles have no effect.
  std::span<double> added_forces() { return added_forces_for(state_.particles, setting_); }
  /// Torques of the caller [M L^2/T^2]; see Simulation::added_torques.
  std::span<double> added_torques() { return added_torques_for(state_.particles, setting_); }

  const State& state() const { return state_; }  ///< after the last step
  /// The state with the flow of a fluid with inertia, to be written.
  State state_to_save();
  const Setting& setting() const { return setting_; }  ///< with the added forces and torques

  /// The flow of the last step: where the particles were at the beginning of the step.
  FlowField flow() { return solver_->flow(); }

  /// The flow around the particles where they are now. It solves the problem of the next step,
  /// whose length is that of the setting, and changes nothing else. Throws the errors of
  /// FluidSolver.
  FlowField flow_at_present();

  /// Forces and torques of the fluid on the particles in the last step, motion_components() each;
  /// empty before the first step.
  const std::vector<double>& fluid_forces() const { return quantities_.fluid_forces; }

  /// The contacts in which solids rebounded in the last step.
  const std::vector<Rebound>& rebounds() const { return rebounds_; }

  /// The errors of the forces of the last step, if the errors of velocities were estimated there.
  const ForceErrors& force_errors() const { return force_errors_; }

  /// The particles with the velocities of the last step. If the error was estimated there, they are
  /// those extrapolated from two meshes, which do not enter the next step.
  Particles reported_particles() const;

  /// Number of unknowns of the last mesh; 0 if the solver does not say.
  std::size_t unknowns() const { return solver_->unknowns(); }
  /// The largest resident memory of the solver so far [MiB]; 0 if it runs in this process.
  double solver_peak_memory_mebibytes() const { return solver_->peak_memory_mebibytes(); }

 private:
  struct Motion;
  void begin_flow(double h);
  Motion solve(double h, double next, bool is_estimated);
  std::vector<double> free_velocities(const StepEquation& equation, std::span<const double> flow,
                                      double h, const HeldMotion* held);
  std::optional<FluidBlow> solve_contacts_of(const StepEquation& equation,
                                             std::span<const double> free, double h, double next,
                                             StepContacts& contacts);
  void check_ellipses() const;
  void estimate(const StepEquation& equation, std::span<const double> forces,
                const HeldMotion* held, Motion& motion);
  void keep_and_extrapolate(const StepEquation& equation, Motion& motion) const;
  void report_inertia(Motion& motion) const;
  ContactConditions contact_conditions(std::span<const double> free, double h) const;
  double kick_length(double h) const;
  bool is_computed_twice() const;
  void examine(Motion& motion, double h, StepReport& report) const;
  void remember_friction(const StepContacts& step, double share);
  void accept(Motion motion, double h, double next, StepReport& report);
  std::vector<double> hold_after_step(const StepEquation& equation, const HeldMotion& held,
                                      std::span<const double> flow, std::vector<double>& velocities,
                                      double h, bool& holds) const;
  /// The error of lengths that solver.tolerance allows [L].
  double tolerated_length() const { return setting_.solver.tolerance * mean_radius_; }
  double hold_turned(const HeldMotion& held, double h, std::vector<double>& velocities,
                     std::vector<double>& row_forces) const;
  void hold_with_contacts(const StepEquation& equation, const HeldMotion& held, double h,
                          double next, Motion& motion, std::vector<double>& row_forces);
  std::vector<double> hold_at_end(const StepEquation& equation, const HeldMotion& held,
                                  std::span<const double> moved, std::vector<double>& at_end) const;
  void move_bodies(const Motion& motion, double h, double next);

  Setting setting_;
  State state_;
  std::unique_ptr<FluidSolver> solver_;
  HeldSolver* held_ = nullptr;  // solver_, if the case has bodies or links
  MotionLayout layout_;
  double mean_radius_;
  ThreadPool pool_;
  std::vector<Plane> obstacles_;
  FlowQuantities quantities_;
  ForceErrors force_errors_;
  std::vector<Rebound> rebounds_;
  bool has_flow_ = false;         // the solver has kept a flow, in a fluid with inertia
  std::vector<double> reported_;  // extrapolated velocities of the last step; empty: there are none
};

}  // namespace viscontact::particles
