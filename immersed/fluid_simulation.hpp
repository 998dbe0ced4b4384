// Rigid particles in a fluid with viscous contact, docs/physics.md (6.1) to (6.5) (Lefebvre 2007,
// "Fluid-particle simulations with FreeFem++"; 2009, "Numerical simulation of gluey particles").
#pragma once

#include <cassert>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/immersed/flow_simulation.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/rebound.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

class ConstrainedMotion;
class ConstrainedSolver;
class StepEquation;
struct ContactConditions;
struct FluidImpact;
struct StepContacts;

/// Rigid particles in a fluid. Each step asks the fluid solver for the velocities that the
/// particles take at their places under forces, torques and contact forces, and moves them. With
/// Coupling::kConstrained contact forces act on the fluid; with Coupling::kSplitting the velocities
/// that the fluid gives are projected onto those that keep gaps open, in the norm of the masses. A
/// step depends on the setting and the state only, so that a continued run gives the same bits.
///
/// Step n, of length h^n = h, begins at the time t^n with the places x^n and the velocities u^n.
/// S^n g are the velocities that the fluid gives the particles at x^n under the forces g. F^{n-1}
/// are the forces of the particles on the fluid in the step before, M the masses and moments of
/// inertia, and theta says how implicit the step is (StepEquation). With the sum g^n of the forces
/// of the step and M/(theta h) u^n, a step (6.5) is
///
///     U^n = S^n g^n,   U^+ = U^n + (h^n/(2 h^{n-1})) (S^n g* - U^{n-1}),   x^{n+1} = x^n + h U^+,
///     g* = F^{n-1} + M/(theta h) U^{n-1},
///
/// which is of second order away from contact. A particle that was in contact in the step before
/// moves with U^n, and so do all particles in a step in which a given motion jumps.
///
/// In a fluid with inertia (6.9) the problem of the fluid solver contains the masses, U^n are the
/// velocities at the time t^n, and U^+ = U^n + (h^n/(2 h^{n-1})) (U^n - U^{n-1}). The first step
/// computes U^1 at x^0, and moves the particles by h (U^0 + U^1)/2. The second step computes U^1
/// and all forces again, at x^1. The state and the report of the first step have no forces,
/// impulses and dissipation, and films absorb none of its impulses, because sums over the steps
/// would otherwise contain them twice.
class FluidSimulation : public FlowSimulation {
 public:
  /// `setting` has a fluid. `state` is that of a restart file, or a state of which only the
  /// particles are set. Throws Error(kBadInput) if the fluid has inertia and the state has done
  /// steps but has no flow. Throws the errors of FluidSolver::load_flow().
  FluidSimulation(Setting setting, State state, std::unique_ptr<FluidSolver> solver);

  /// Computes one step of length Setting::time_step, or less if `end` [T] is nearer. If the state
  /// has reached `end`, computes no step and returns a report without contacts. In a fluid without
  /// inertia the first step of a simulation and the step that reaches `end` estimate errors. Throws
  /// the errors of FluidSolver, and Error(kNotConverged)
  /// - if an overlap of more than the mean radius is left;
  /// - if the length or place of a link is off by more than the mean radius, or links contradict
  ///   each other;
  /// - if two particles with sides touch at a place that was no contact at the beginning of the
  ///   step;
  /// - if a particle moves too far for the precision of a double.
  /// After an error the state is that before the step. With a smaller residual that is not allowed
  /// StepReport::converged is false.
  StepReport step(double end) override;

  /// On driven particles, whose motion is given, the forces and torques have no effect.
  std::span<double> added_forces() override { return added_forces_for(state_.particles, setting_); }
  std::span<double> added_torques() override {
    return added_torques_for(state_.particles, setting_);
  }

  const State& state() const override { return state_; }
  /// The state with the flow of a fluid with inertia.
  State state_to_save() override;
  const Setting& setting() const { return setting_; }  ///< with the added forces

  FlowField flow() override {
    assert(!quantities_.fluid_forces.empty() || state_.particles.count() == 0);
    return solver_->flow();
  }

  /// The flow is that of the next step, whose problem is solved without moving anything. Throws
  /// also Error(kNotConverged) if links or particles with sides make step() throw it.
  FlowField flow_at_present() override;

  std::vector<double> fluid_forces() const override { return quantities_.fluid_forces; }
  ForceErrors force_errors() const override { return force_errors_; }
  std::span<const Rebound> rebounds() const override { return rebounds_; }

  /// With velocities that are extrapolated from two meshes, if the last step estimated errors.
  Particles reported_particles() const override;

  std::size_t unknowns() const override { return solver_->unknowns(); }
  double solver_peak_memory_mebibytes() const override { return solver_->peak_memory_mebibytes(); }

 private:
  struct Motion;
  /// At the start of a run with inertia of the fluid, lets the solver keep the first flow, and
  /// gives free particles its velocities.
  void begin_flow(double h);
  /// Computes a step of length h [T] that ends at the time `next` [T], without changing the state.
  Motion solve(double h, double next, bool is_estimated);
  /// U^+ of all particles without contact, from their velocities `flow` (U).
  std::vector<double> free_velocities(const StepEquation& equation, std::span<const double> flow,
                                      double h, const ConstrainedMotion* constrained);
  /// Sets `contacts` to the solution without restitution, and returns the impact if solids rebound.
  std::optional<FluidImpact> solve_contacts_of(const StepEquation& equation,
                                               std::span<const double> free, double h, double next,
                                               StepContacts& contacts);
  /// Replaces Motion::quantities by those extrapolated from two meshes under the same `forces`,
  /// which include those of contacts, and sets errors and, except with Coupling::kSplitting,
  /// Motion::reported.
  void estimate(const StepEquation& equation, std::span<const double> forces,
                const ConstrainedMotion* constrained, Motion& motion);
  /// Sets Motion::kept and Motion::at_end in a fluid with inertia.
  void keep_and_extrapolate(const StepEquation& equation, Motion& motion) const;
  /// Sets the members of FluidStepReport that only a fluid with inertia has, but the kinetic
  /// energy.
  void report_inertia(Motion& motion) const;
  ContactConditions contact_conditions(std::span<const double> free, double h) const;
  /// The time [T] for which the forces of a step of length h act on its velocities.
  double impulse_time_of(double h) const;
  /// In the first step of a fluid with inertia.
  bool is_computed_twice() const;
  /// For the `velocities` with which the particles move.
  StepResiduals residuals_of(StepContacts& contact, std::span<const double> velocities,
                             const ContactConditions& conditions) const;
  /// Throws Error(kNotConverged) if the step must be refused. Sets Motion::impulse_errors, and the
  /// residuals in the report.
  void examine(Motion& motion, double h, StepReport& report) const;
  /// Stores friction and loads of solids, `share` [1] times the impulses of `step`, in the
  /// memories.
  void remember_friction(const StepContacts& step, double share);
  void accept(Motion motion, double h, double next, StepReport& report);
  /// Changes `velocities`, with which the particles move if they have no contact, until hinges and
  /// arms hold at the end of the step, and the springs of particles that accelerate have the forces
  /// that belong to their lengths; `holds` if this is so within the tolerance. Returns the forces
  /// of the rows minus those with which the fluid solver found `flow`. Throws Error(kNotConverged)
  /// if a length or place would be off by more than a mean radius.
  std::vector<double> hold_after_step(const StepEquation& equation,
                                      const ConstrainedMotion& constrained,
                                      std::span<const double> flow, std::vector<double>& velocities,
                                      double h, bool& holds) const;
  /// The error of lengths that the tolerance allows [L].
  double tolerated_length() const { return setting_.solver.tolerance * mean_radius_; }
  /// The same for hinges and arms alone. Adds the forces that this needs to `row_forces` and
  /// returns the largest error of a length or place [L] that is left.
  double hold_turned(const ConstrainedMotion& constrained, double h,
                     std::vector<double>& velocities, std::vector<double>& row_forces) const;
  /// The contacts of the step before, of round particles only, at their present places and with the
  /// impulses of the same forces in a step of length h.
  std::vector<Contact<2>> contacts_before(double h) const;
  /// Adds the geometric rows for the forces of links and contacts, and finds their stiffnesses
  /// under `loaded`, the given forces and those of contacts. Returns true if the step must be
  /// solved again.
  bool follow_turns(const StepEquation& equation, ConstrainedMotion& constrained,
                    std::vector<double> loaded, std::span<const Contact<2>> contacts,
                    std::span<const double> row_forces, std::vector<double>& settled);
  /// The largest z, physics.md (6.15), of films that pull along their direction at the beginning of
  /// the step: those of particles that are not round, and with Coupling::kSplitting those of discs.
  /// z >= 0 [1] bounds the length of the step times the rate at which what the film pulls turns. A
  /// film along a side turns with the side and has none.
  double turn_of_films(const StepContacts& step, const StepEquation& equation) const;
  /// Makes bodies rigid, and hinges and arms hold, at the end of a step with contacts: contacts
  /// change the angles by which bodies and links turn, and with these the forces of the rows, with
  /// which the contacts are solved again. Ends as soon as there is an impact.
  void hold_with_contacts(const StepEquation& equation, const ConstrainedMotion& constrained,
                          double h, double next, Motion& motion, std::vector<double>& row_forces);
  /// Changes the velocities `at_end` of particles that accelerate until hinges and arms hold for
  /// them after a step in which particles moved with `moved`. Returns the forces of the rows.
  std::vector<double> hold_at_end(const StepEquation& equation,
                                  const ConstrainedMotion& constrained,
                                  std::span<const double> moved, std::vector<double>& at_end) const;
  void move_bodies(const Motion& motion, double h, double next);

  Setting setting_;
  State state_;
  std::unique_ptr<FluidSolver> solver_;
  ConstrainedSolver* constrained_solver_ =
      nullptr;              // points to *solver_ in the plane, and with links
  bool has_links_ = false;  // the case has bodies or links
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
