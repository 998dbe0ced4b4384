// Simulates rigid particles in a fluid with viscous contact, docs/physics.md (6.1) to (6.5)
// (Lefebvre 2007, "Fluid-particle simulations with FreeFem++"; Lefebvre 2009, "Numerical simulation
// of gluey particles"). Lengths [L], masses [M] and times [T] are in any consistent units; in the
// plane masses, forces and powers are per unit length. particles/run/ and the other sources of this
// folder use it. A step that cannot be computed throws Error(kNotConverged), a fluid solver that
// fails Error(kExternalProgram), a stop that is requested Error(kInterrupted). Values of the
// setting are not checked. A change must keep that a run which was interrupted and continued gives
// the same bits as a run without a break.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/contact/contact.hpp"
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

/// Estimates of the errors of the forces of one step, each >= 0 [M L/T^2, M L^2/T^2]; both members
/// are empty if there are no estimates.
struct ForceErrors {
  std::vector<double> of_fluid;  ///< errors of FluidSimulation::fluid_forces(), as many numbers
  std::vector<double> of_links;  ///< errors of State::link_forces, as many; empty without links
};

/// Rigid particles in a fluid. Each step asks the fluid solver for the velocities that the
/// particles take at their places under forces, torques and contact forces, and moves them. With
/// Coupling::kConstrained contact forces act on the fluid; with Coupling::kSplitting the velocities
/// that the fluid gives are projected onto those that keep gaps open, in the norm of the masses.
///
/// Away from contact a step is of second order. Step n, of length h^n = h, begins at the time t^n
/// with the places x^n and the velocities u^n. S^n g are the velocities that the fluid gives the
/// particles at x^n under the forces g. F^{n-1} are the forces of the particles on the fluid in the
/// step before, M the masses and moments of inertia. theta, from 1/2 to 1, says how implicit the
/// step is (step_equation.hpp). With the sum g^n of the forces of the step and M/(theta h) u^n, a
/// step is
///
///     U^n = S^n g^n,   U^+ = U^n + (h^n/(2 h^{n-1})) (S^n g* - U^{n-1}),   x^{n+1} = x^n + h U^+,
///     g* = F^{n-1} + M/(theta h) U^{n-1}.
///
/// The second term of U^+ estimates by how much the velocities change in half a step because the
/// particles move. Without inertia and with a constant force g* = g^n, so that this is the formula
/// of Adams and Bashforth; it remains of second order if a force jumps. If a particle of a link has
/// mass, the link acts where its particles are in the middle of the step. The nearest velocities
/// that the links allow take the place of U^{n-1} (6.7). A particle that was in contact in the step
/// before moves with U^n, which is of first order. All particles move with U^n in a step in which a
/// given motion jumps.
///
/// In a fluid with inertia (docs/physics.md (6.9)) the problem of the fluid solver contains the
/// masses, and U^n are the velocities at the time t^n. Away from contact the particles move with
///
///     U^+ = U^n + (h^n/(2 h^{n-1})) (U^n - U^{n-1}).
///
/// The first step computes U^1 at x^0, and moves the particles by h (U^0 + U^1)/2. The second step
/// computes U^1 and all forces again, at x^1. The state and the report of the first step have no
/// forces, impulses and dissipation, and films absorb none of its impulses, because sums over the
/// steps would otherwise contain them twice.
class FluidSimulation {
 public:
  /// `setting.fluid` must have a value, and `solver` must not be null; both are not checked.
  /// `state` is the state of a restart file, or a state of which only the particles are set. Throws
  /// Error(kBadInput) if the fluid has inertia and the state has done steps but has no flow. Throws
  /// the errors of FluidSolver::load_flow().
  FluidSimulation(Setting setting, State state, std::unique_ptr<FluidSolver> solver);

  /// Computes one step of length Setting::time_step, or less if `end` [T] is nearer. If the state
  /// has reached `end`, computes no step and returns a report without contacts. In a fluid without
  /// inertia the first step of a simulation and the step that reaches `end` estimate the errors of
  /// velocities and forces. Throws the errors of FluidSolver, also Error(kInterrupted) if a stop is
  /// requested. Throws Error(kNotConverged)
  /// - if an overlap of more than the mean radius is left;
  /// - if the length or place of a link is off by more than the mean radius, or links contradict
  ///   each other;
  /// - if an ellipse comes as near to a wall, plane or particle as the threshold gap, or two plates
  ///   touch at a place that was no contact at the beginning of the step;
  /// - if a particle moves too far for the precision of a double.
  /// After an error the state is that before the step. A smaller residual that is not allowed
  /// throws nothing, but StepReport::converged is then false.
  StepReport step(double end);

  /// Forces of the caller on the particles [M L/T^2], which the caller may change between steps.
  /// Their order and number are those of Particles::velocities. Forces on driven particles, whose
  /// motion is given, have no effect.
  std::span<double> added_forces() { return added_forces_for(state_.particles, setting_); }
  /// Torques of the caller on the particles [M L^2/T^2], one for each particle, which the caller
  /// may change between steps; empty if particles do not turn. Torques on driven particles have no
  /// effect.
  std::span<double> added_torques() { return added_torques_for(state_.particles, setting_); }

  const State& state() const { return state_; }  ///< the state after the last step
  /// The state with the flow of a fluid with inertia, for a restart file. Throws the errors of
  /// FluidSolver.
  State state_to_save();
  const Setting& setting() const { return setting_; }  ///< the case, with the added forces

  /// The flow of the last step, around the places of the particles at the beginning of this step.
  /// There must have been a step (not checked). Throws the errors of FluidSolver.
  FlowField flow() { return solver_->flow(); }

  /// The flow around the particles at their present places. It is that of the next step of length
  /// Setting::time_step, whose problem is solved without moving anything. Throws the errors of
  /// FluidSolver, and Error(kNotConverged) if links or plates make step() throw it.
  FlowField flow_at_present();

  /// Forces and torques of the fluid on the particles in the last step [M L/T^2, M L^2/T^2],
  /// motion_components() numbers each; empty before the first step.
  const std::vector<double>& fluid_forces() const { return quantities_.fluid_forces; }

  /// The contacts in which solids rebounded in the last step; empty without restitution.
  const std::vector<Rebound>& rebounds() const { return rebounds_; }

  /// The errors of the forces of the last step; empty if the last step did not estimate them.
  const ForceErrors& force_errors() const { return force_errors_; }

  /// The particles with their velocities after the last step. If the last step estimated errors,
  /// the velocities are extrapolated from two meshes; the next step does not use such velocities.
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
  /// Sets the members of FluidStepReport that only a fluid with inertia has, but the kinetic energy.
  void report_inertia(Motion& motion) const;
  ContactConditions contact_conditions(std::span<const double> free, double h) const;
  double kick_length(double h) const;
  bool is_computed_twice() const;
  StepResiduals residuals_of(StepContacts& contact, std::span<const double> velocities,
                             const ContactConditions& conditions) const;
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
  /// The contacts that had an impulse in the step before, at their present places, with the impulse
  /// of the same force in a step of length h [T]. Contacts of plates are left out.
  std::vector<Contact<2>> contacts_before(double h) const;
  /// Adds the geometric rows that the step needs for the forces of its links and contacts, and finds
  /// their stiffnesses under `loaded`, the given forces and those of contacts. Returns true if the
  /// step must be solved again with them. `settled` are the forces `loaded` of the last call.
  bool follow_turns(const StepEquation& equation, HeldMotion& held, std::vector<double> loaded,
                    std::span<const Contact<2>> contacts, std::span<const double> row_forces,
                    std::vector<double>& settled);
  /// The largest z, physics.md (6.15), of films that pull along their direction at the beginning of
  /// the step: those of the ends of plates, and with Coupling::kSplitting those of discs. z >= 0 [1]
  /// is an upper bound of the length of the step times the rate at which what the film pulls turns.
  /// A film along the side of a plate turns with the plate and has none.
  double turn_of_films(std::span<const Contact<2>> contacts, const StepEquation& equation) const;
  void hold_with_contacts(const StepEquation& equation, const HeldMotion& held, double h,
                          double next, Motion& motion, std::vector<double>& row_forces);
  std::vector<double> hold_at_end(const StepEquation& equation, const HeldMotion& held,
                                  std::span<const double> moved, std::vector<double>& at_end) const;
  void move_bodies(const Motion& motion, double h, double next);

  Setting setting_;
  State state_;
  std::unique_ptr<FluidSolver> solver_;
  HeldSolver* held_ = nullptr;  // points to *solver_ in the plane, and with links
  bool has_links_ = false;      // the case has bodies or links
  MotionLayout layout_;
  double mean_radius_;  // [L]
  ThreadPool pool_;
  std::vector<Plane> obstacles_;
  FlowQuantities quantities_;
  ForceErrors force_errors_;
  std::vector<Rebound> rebounds_;
  bool has_flow_ = false;            // the solver has kept a flow, in a fluid with inertia
  double first_kinetic_energy_ = 0;  // of the fluid in the flow at the start [M L^2/T^2]
  std::vector<double> reported_;     // Motion::reported of the last step
};

}  // namespace viscontact::particles
