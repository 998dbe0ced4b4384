// The equation of motion of a step in a fluid: forces, inertia and given motions, docs/physics.md
// (6.1) and (6.5). Lengths, masses and times are in the units of the case. fluid_simulation.cpp
// uses it; nothing is thrown. A change must keep second order in time away from contact.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// The largest ratio of the lengths of a step and of the step before it with which differences of
/// second order are taken. They are stable up to 1 + sqrt(2) (Grigorieff 1983).
inline constexpr double kLargestRatioOfSteps = 2;

/// The equation of one step of length h from t^n. With the mean force f over the step and the
/// resistance R of the fluid, the velocities U with which the particles move in the step solve
///
///     M (u^{n+1} - u^n)/h = f - R U + contact forces,   U = theta u^{n+1} + (1 - theta) u^n,
///
/// that is (R + M/(theta h)) U = f + M/(theta h) u^n + contact forces. A particle without mass has
/// theta = 1 and u^{n+1} = U. The other particles have theta = (1 + z)/(2 + z) with z = h c/m: 1/2
/// + O(h), which makes the step one of second order, and close to 1 where the drag is stiff, so
/// that velocities do not oscillate. c is the Stokes drag or, if it is larger, the drag in the step
/// before, because near a wall it is many times the Stokes drag. In the first step, theta = 1,
/// which does not change the order. A particle in contact has theta = 1, because its velocity
/// jumps: it is U at the end of the step (implicit Euler).
///
/// In a fluid with inertia the fluid solver has the masses in its problem (FlowStep): here all
/// inertia is 0 and theta is 1. U = u^n is then the velocity at the time t^n of the places x^n, and
/// forces contain the buoyancy in place of the hydrostatic pressure. Forces and given motions are
/// means from the middle of the step before to the middle of this one: the forces of all steps
/// together then have the whole impulse, wherever a force jumps.
class StepEquation {
 public:
  /// The step of length h > 0 ends at time `next`; `state` is that before the step. Both references
  /// must outlive the object. Particles that had a contact in the step before are in contact.
  StepEquation(const Setting& setting, const State& state, double h, double next);

  /// The particles in the fluid with M/(theta h).
  FluidParticles bodies() const;

  /// f + M/(theta h) u^n of each component [M L/T^2]. Forces on the members of a body that
  /// accelerates act where the members are in the middle of the step, if its velocity does not
  /// jump.
  std::vector<double> right_side() const;

  /// f of each component [M L/T^2].
  const std::vector<double>& forces() const { return forces_; }
  /// M/(theta h) of each component [M/T]; 0 without inertia.
  const std::vector<double>& inertia() const { return inertia_; }

  /// u^{n+1} [L/T, 1/T] of particles that move with `motions` in the step. It is `flow`, the
  /// velocity at x^n, of components without inertia.
  std::vector<double> velocities_at_end(std::span<const double> motions,
                                        std::span<const double> flow) const;

  /// The velocities at which the forces on the particles do their work in the step, for the
  /// velocities `flow` = U and `at_end` = u^{n+1} and the forces `drag` of the particles on the
  /// fluid: U for the part of the forces that the fluid resists, (u^n + u^{n+1})/2 for the part
  /// that accelerates. Work at U alone would contain the energy that a step with theta > 1/2 loses
  /// where the velocity jumps.
  std::vector<double> velocities_of_work(std::span<const double> flow,
                                         std::span<const double> at_end,
                                         std::span<const double> drag) const;

  /// Of each particle that accelerates, which has a mass, its own or a share of that of its body,
  /// and no given motion: the time in the step at which its links act [T]. It is h/2 - (2 theta -
  /// 1) (1 - theta) h, but 0 in the first step and where the velocity of the particle may jump. Of
  /// the other particles -1. Empty if no particle accelerates.
  const std::vector<double>& link_times() const { return link_times_; }

  /// In a fluid with inertia: how rates are approximated, with the masses of all components. The
  /// order is 2 where two flows were kept and no velocity may jump. The masses must outlive it.
  FlowStep flow_step() const;

  /// The mass [M, M L^2] over the length of the step of each component, in whose norm the splitting
  /// projects velocities; in a fluid without inertia inertia().
  std::vector<double> inertia_of_projection() const;

  /// By how much a mean force in the step changes the velocity at its end, for each component [T/M,
  /// T/(M L^2)]: h/m. Of particles without mass, the inverse of their drag in (6.5); 0 of driven
  /// particles.
  std::vector<double> mobility_of_step() const;

  /// In a fluid with inertia, without contact: U^+ = U + this share of the change of U since the
  /// step before. It is 0 after a step that was much shorter, whose change says little.
  double share_of_change() const;

  /// The mean of the given motion of a driven particle in the step, with which it moves.
  std::array<double, 3> given_in_step(std::int32_t driven) const;

  /// u^n of all components [L/T, 1/T]; of driven particles their given motions.
  std::vector<double> velocities() const;

  /// True if the velocity of particle `k` is prescribed.
  bool is_driven(std::int32_t k) const { return driven_.contains(k); }
  /// True if particle `k` has theta = 1 because its velocity may jump: it, or a particle that moves
  /// with it because of rigid bodies, arms and stiff springs, has a contact in the step before or
  /// in put_in_contact(), or the length of an arm of theirs has a kink, or one of their links leads
  /// to a particle whose given velocity jumps.
  bool is_in_contact(std::int32_t k) const { return in_contact_[index_of(k)] != 0; }

  /// Sets theta = 1 for the particles of contacts with an impulse. Returns true if that changed the
  /// inertia of any, or the order of the step of a fluid with inertia.
  bool put_in_contact(std::span<const Contact<2>> contacts);

  /// True if a particle is in contact.
  bool is_any_in_contact() const;

  /// True if all given motions are the same as in the step before.
  bool drives_as_before() const;

 private:
  /// Times [T] over which forces, and given motions, are means.
  struct Window {
    double from_of_forces, from, to;
  };
  static Window window(const Setting& setting, const State& state, double h, double next);
  void add_inertia();
  void find_companions();
  void spread_contact();
  bool has_jump(std::int32_t driven) const;
  double stokes_drag(std::size_t k, std::size_t component) const;
  double theta(std::size_t k, std::size_t component, double mass) const;
  double theta_of_body(const RigidBody& body) const;
  /// |F|/|U| of the force F on the fluid and the velocity U in the step before, or of torque and
  /// angular velocity; 0 if there was no motion, infinite if there was no step.
  double earlier_drag(std::size_t k, std::size_t component) const;
  double velocity(std::size_t k, std::size_t component) const;
  std::array<double, 3> given_motion(const GivenMotion& motion, double from, double to) const;

  const Setting& setting_;
  const State& state_;
  double h_;
  MotionLayout layout_;
  std::vector<double> masses_;  // mass or moment of inertia of each component
  double next_;
  Window window_;
  std::vector<double> forces_;  // f [M L/T^2]
  std::vector<double> thetas_, inertia_;
  std::map<std::int32_t, std::array<double, 3>> driven_;
  std::vector<char> in_contact_;
  std::vector<double> link_times_;
  // Particles that move with each other because of bodies, arms and stiff springs: sets of two or
  // more. Driven particles are in none, because nothing that others do changes their velocities.
  std::vector<std::vector<std::int32_t>> companions_;
};

}  // namespace viscontact::particles
