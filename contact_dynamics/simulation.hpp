// Many rigid particles with viscous contact, without a fluid, docs/physics.md (5.2), (5.3).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viscontact/arrangement/pouring.hpp"
#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/contact_dynamics/pair_impulses.hpp"
#include "viscontact/contact_solver/stages/stages.hpp"
#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/rebound.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/particles/steps/particle_simulation.hpp"
#include "viscontact/particles/steps/step_report.hpp"
#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {

struct ProjectionResult;
template <int D>
class Impacts;

/// The lecture's problem for many particles (Maury 2006, "A time-stepping scheme for inelastic
/// collisions"; Lefebvre 2009, "Numerical simulation of gluey particles"), in any consistent units:
///
///     D_ij >= 0,   gamma_ij <= 0,   D_ij gamma_ij = 0,
///     M d^2x/dt^2 = M f + sum lambda_ij G_ij^T,   dgamma_ij/dt = -lambda_ij,
///
/// where velocities v are projected, in the norm of M, on G_ij v = 0 where gamma_ij < 0, and on
/// G_ij v >= 0 where gamma_ij = 0 and D_ij = 0. x are the centres, D_ij is the gap of the pair i,
/// j, G_ij v the rate of this gap, gamma_ij minus the impulse that the film between both surfaces
/// has absorbed, and lambda_ij the force of the contact, > 0 where it pushes; M is the diagonal
/// matrix of the masses and M f the vector of the forces. A pair with gamma_ij < 0 is called glued.
/// Its film pulls with an impulse of at most -gamma_ij, so that the pair separates within the step
/// in which gamma_ij reaches 0. gamma_ij falls no lower than gamma_min (film_law.hpp); there the
/// solids carry the rest of the load. No bit of the results depends on the number of threads, or on
/// whether the run was continued from a restart file.
class Simulation : public ParticleSimulation {
 public:
  /// `setting` has no fluid (for a fluid there is FluidSimulation). `state` is what read_restart()
  /// returned, or a state of which only the particles are set; their dimension is 2 or 3. Throws
  /// Error(kBadInput) if membranes of a state that has done steps do not fit the setting
  /// (check_shapes() in membrane.hpp).
  Simulation(Setting setting, State state, int threads);
  ~Simulation() override;
  Simulation(Simulation&&) noexcept;

  /// Computes one step, and then adds the particles of Setting::sources that are due at its end.
  /// The arrays of the particles keep their places in memory.
  ///
  /// The step has the length h = Setting::time_step, except near times at which a force or the
  /// velocity of a plane jumps (step_times.hpp). It ends at `end` [T] if a whole step would end
  /// later by more than a millionth of h. If less than a millionth of h is left until `end`, no
  /// step is made (the report has the present time and no contacts), because rounding errors of the
  /// times would cause tiny steps.
  ///
  /// A step in which two touching particles pass each other by more than half the sum of their
  /// radii (kLargestTurn in contact.hpp), or links turn so far that their equations are not solved,
  /// is computed in two halves, and these again. The report then has the contacts of the last part.
  /// With SolverSettings::suits_sweeps() this also happens, up to six times, to a step whose sweeps
  /// do not solve Coulomb's law, because those of shorter steps often do.
  ///
  /// Throws Error(kNotConverged) if a position or displacement exceeds largest_resolved_distance(),
  /// if a displacement is longer than a periodic domain allows (rebuild_neighbour_list()), if the
  /// projection has not converged and leaves an overlap of more than the mean radius, or if links
  /// and contacts contradict each other. After an error the state is that before the step. A step
  /// that has not converged for another reason is accepted, and StepReport::converged is false.
  StepReport step(double end) override;

  /// How often a step may be halved. In the smallest part, 1/256 of the step, equal particles may
  /// pass each other by one radius, and in the step by 256 radii. A larger value resolves faster
  /// particles, but multiplies the number of parts.
  static constexpr int kMostHalvings = 8;

  /// The forces act in each of the next steps with the values that they have when the step begins;
  /// with Scheme::kLeapfrog from the middle of the last step to the middle of the next one, so that
  /// the scheme keeps its second order also for forces that depend on positions.
  std::span<double> added_forces() override { return added_forces_for(state_.particles, setting_); }
  std::span<double> added_torques() override {
    return added_torques_for(state_.particles, setting_);
  }

  const State& state() const override { return state_; }
  const Setting& setting() const { return setting_; }  ///< with the added forces and torques

  std::span<const Rebound> rebounds() const override { return rebounds_; }

  /// With Scheme::kLeapfrog, the velocity that forces, gravity and torques have given since the
  /// time of the state's velocities is added, for particles and bodies without links and without an
  /// impulse of a contact in the last step.
  Particles reported_particles() const override;

 private:
  // In all private members `h` is the length of a step or of a part of it, and `next` the time at
  // its end [T]. impulse_time_of() is the time for which forces act on the velocities in it [T].
  double impulse_time_of(double h) const {
    return setting_.scheme == Scheme::kLeapfrog ? state_.velocity_lag + h / 2 : h;
  }
  // Mean of a force or torque over the times in which it changes the velocities of this step.
  Vector mean_of(const PiecewiseConstant& function, double h, double next) const;
  // Computes a part of a step, or both halves of this part; `halvings` is 0 for a whole step.
  template <int D>
  void advance(double h, double next, int halvings, StepReport& report);
  // Computes a step. If a part throws, the state becomes that before the step.
  template <int D>
  void advance_whole(double h, double next, StepReport& report);
  // Changes the state to that at the end of a part, and adds the part to the report.
  template <int D>
  void accept(const ProjectionResult& projected, double h, double next, StepReport& report);
  void take_impulses(const ProjectionResult& projected);
  // Updates gamma and the memory of each pair. Returns the number of glued pairs.
  std::size_t remember(const ProjectionResult& projected, double h);
  // Adds to arm_works_ the works of the arms in a part whose displacements are known.
  void add_works_of_arms(double h);
  void add_given_loads(const ProjectionResult& projected, double h);
  void place_planes() { obstacles_ = obstacles_of(setting_, state_.planes); }
  std::size_t walls_of_domain() const { return obstacles_.size() - setting_.planes.size(); }
  bool has_given_motions() const;
  // True for an obstacle that no force moves, and for a particle whose motion is given.
  bool is_given(std::int32_t body) const;
  // Throws Error(kNotConverged) if two bodies whose motions are given overlap after the part of a
  // step that ends at `next`, and the part has made the overlap deeper.
  void refuse_meeting(double next) const;
  // The obstacles that move in the part of a step that ends at `next` and push on a particle, and
  // the ids of such particles whose motion is given. `impulse` sums the normal impulses [M L/T].
  struct Pressing {
    std::string names;  // such as "planes -5, -6 and particle 7"; empty if there are none
    double impulse = 0;
  };
  Pressing pressing(const ProjectionResult& projected, double next) const;
  // Throws Error(kNotConverged) if a part that has not converged leaves an overlap of more than the
  // mean radius, or if links contradict each other.
  void examine(const ProjectionResult& projected, double next) const;
  // Sets the displacements h u* [L], where u* are the velocities without contacts and links.
  template <int D>
  void move_freely(double h, double next);
  void turn_freely(double h, double next);
  // Sets displacements, turns and mobilities of given motions and of planes under a load.
  void move_as_given(double h, double next);
  // Sets body_steps_ and the displacements, turns and mobilities of the members of bodies.
  void move_bodies_freely(double h, double next);
  bool is_first_part() const { return state_.steps == 0 && state_.time == first_time_; }
  bool has_constraints() const {
    return setting_.laws.friction || !setting_.links.empty() || !state_.particles.bodies.empty() ||
           has_other_shapes_;
  }
  // Forces and torques on each rigid body; `mean` returns the mean of a force.
  std::vector<BodyLoad> loads_of_bodies(
      const std::function<Vector(const PiecewiseConstant&)>& mean) const;
  // The result is 1 for each particle whose motion only forces, gravity and torques changed in the
  // last step: neither it nor its body has a link, had a contact with an impulse, or moves as
  // given.
  std::vector<char> free_particles() const;
  // Solves the projection for the velocities v: the displacements h u* become h v. Rebuilds the
  // lists of pairs where needed.
  // If `can_be_divided`, see StepProjection::solve().
  template <int D>
  ProjectionResult project(double h, double next, bool can_be_divided);
  void move(double h);
  // The impacts of the part of a step that is being computed; null without restitution.
  template <int D>
  std::unique_ptr<Impacts<D>>& impacts() {
    if constexpr (D == 2)
      return impacts_in_plane_;
    else
      return impacts_in_space_;
  }
  // True if films of these pairs, with these impulses in a part [M L/T], have geometric stiffness,
  // (5.21).
  bool pull_across(std::span<Pair* const> pairs, std::span<const double> impulses) const;
  // True if films had it in the step before.
  bool pulled_across() const;
  // Finds the impacts of a part. The displacements must be those without contacts.
  template <int D>
  void find_impacts(double h, double next);
  // Undoes what the impacts changed in the state.
  void undo_impacts();

  void pour();

  Setting setting_;
  State state_;
  Pouring pouring_;
  double mean_radius_;
  bool has_other_shapes_;             // whether a particle is not round
  double first_time_;                 // time of the state that the constructor was given [T]
  contact_solver::StagesRun stages_;  // of the parts of the step that are done
  std::unique_ptr<ThreadPool> pool_;
  // Of particles, and then of planes under a load: h u* (without contacts), later h v (with
  // contacts) [L], and h/m [T/M], which is 0 if the motion is given.
  std::vector<double> displacements_, mobilities_;
  // If particles turn: the turns h w* [rad] without contacts, later h w with contacts, where w* and
  // w are angular velocities; and h/I [T/(M L^2)], where I is the moment of inertia.
  std::vector<double> turns_, turn_mobilities_;
  std::vector<BodyStep> body_steps_;  // displacements and turns of the rigid bodies in the part
  // Forces and torques of the links in the present part [M L/T^2, M L^2/T^2]; the sums of their
  // impulses over the parts that are done; and the sum of the times for which they acted [T].
  std::vector<double> link_forces_, link_impulses_;
  double link_time_ = 0;
  std::vector<double> works_across_;  // of the arms in the present part, ConstraintStep
  std::vector<double> arm_works_;     // work of each arm in the parts that are done [M L^2/T^2]
  // Walls of the domain, then planes, where they are at the present time (State::planes).
  std::vector<Plane> obstacles_;
  // For each obstacle its entry in displacements_ and mobilities_, after those of the particles, if
  // it is a plane under a load, otherwise -1; empty without such planes.
  std::vector<std::int32_t> loaded_;
  // Impulses and moments in the parts of the step that are done, in the order of
  // Setting::given_motions.
  std::vector<GivenParticleLoad> given_impulses_;
  StepGrid grid_;
  std::unique_ptr<Impacts<2>> impacts_in_plane_;
  std::unique_ptr<Impacts<3>> impacts_in_space_;
  std::vector<Rebound> rebounds_;
  // Of the impacts in the parts of the step that are done.
  std::vector<ImpactImpulse> impact_impulses_;
  // Sums over the parts that are done, if the step is divided.
  PairImpulses impulses_of_parts_;
  std::optional<State> before_division_;  // the state before a step that is divided
  PairImpulses saved_impulses_;           // before a step whose projection is repeated
};

}  // namespace viscontact::particles
