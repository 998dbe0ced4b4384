// The equation of motion of a step in a fluid: forces, inertia and given motions, docs/physics.md
// (6.1) and (6.5). Lengths, masses and times are in any consistent units; in the plane masses and
// forces are per unit length. fluid_simulation.cpp and fluid_links.cpp use it; nothing is checked,
// and only given_in_step() throws. A change must keep the second order in time away from contact.
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

/// The equation of one step of length h from the time t^n to t^{n+1}. u^n are the velocities of all
/// particles at t^n and M their masses m and moments of inertia. With the mean force f over the
/// step and the resistance R of the fluid, the velocities U in the step solve
///
///     M (u^{n+1} - u^n)/h = f - R U + contact forces,   U = theta u^{n+1} + (1 - theta) u^n,
///
/// that is (R + M/(theta h)) U = f + M/(theta h) u^n + contact forces. A particle without mass has
/// theta = 1 and u^{n+1} = U. The others have theta = (1 + z)/(2 + z) with z = h c/m and the drag c
/// per velocity. If z is small, theta is 1/2 + O(h), with which the step is of second order; if it
/// is large, theta is close to 1, so that velocities do not oscillate. c is the Stokes drag or, if
/// it is larger, the drag in the step before, because near a wall it is many times the Stokes drag.
/// In the first step theta = 1, which does not change the order. A particle in contact has theta =
/// 1 (implicit Euler), because its velocity may jump.
///
/// In a fluid with inertia the fluid solver has the masses in its problem (FlowStep): here all
/// inertia is 0 and theta is 1. U = u^n is then the velocity at the time t^n of the places x^n, and
/// forces contain the buoyancy in place of the hydrostatic pressure. Forces and given motions are
/// means from the middle of the step before to the middle of this one: the forces of all steps
/// together then have the whole impulse, wherever a force jumps.
class StepEquation {
 public:
  /// The step of length h > 0 [T] ends at the time `next` [T]; `setting` has a fluid, and `state`
  /// is that before the step. Both references must outlive the object. Particles that had a contact
  /// in the step before are in contact.
  StepEquation(const Setting& setting, const State& state, double h, double next);

  // Arrays have motion_components() numbers for each particle, if nothing else is said.

  /// The particles for FluidSolver::place(), with M/(theta h); its spans refer to this object and
  /// to the state.
  FluidParticles bodies() const;

  /// f + M/(theta h) u^n [M L/T^2, M L^2/T^2]. If a rigid body accelerates and its velocity does
  /// not jump, the forces on its members act where these are in the middle of the step.
  std::vector<double> right_side() const;

  /// f [M L/T^2, M L^2/T^2].
  const std::vector<double>& forces() const { return forces_; }
  /// M/(theta h) >= 0 [M/T, M L^2/T]; 0 without inertia, and in a fluid with inertia.
  const std::vector<double>& inertia() const { return inertia_; }

  /// u^{n+1} [L/T, 1/T] of particles that move with `motions` in the step. For components without
  /// inertia and for driven particles it is `flow`, their velocity at the beginning of the step.
  std::vector<double> velocities_at_end(std::span<const double> motions,
                                        std::span<const double> flow) const;

  /// The velocities [L/T, 1/T] by which forces are multiplied for their power in the step. The part
  /// of a force that balances the `drag`, the force of the particles on the fluid, has the power of
  /// U = `flow`; the part that accelerates has that of (u^n + u^{n+1})/2, with `at_end` = u^{n+1}.
  /// With U alone the power would contain the energy that a step with theta > 1/2 loses if a
  /// velocity jumps.
  std::vector<double> velocities_of_work(std::span<const double> flow,
                                         std::span<const double> at_end,
                                         std::span<const double> drag) const;

  /// For each particle the time [T] from the beginning of the step at which its links act, if it
  /// accelerates, that is if it has a mass, its own or a share of that of its body, and no given
  /// motion; else -1. The time is h/2 - (2 theta - 1) (1 - theta) h, but 0 in the first step and if
  /// the velocity of the particle may jump. Empty if no particle accelerates, and in a fluid with
  /// inertia.
  const std::vector<double>& link_times() const { return link_times_; }

  /// In a fluid with inertia: the differences by which the fluid solver approximates rates, with
  /// the masses, which belong to this object. The order is 2 if two flows were kept and no velocity
  /// may jump. Zeros without inertia.
  FlowStep flow_step() const;

  /// The mass or moment of inertia over the length of the step, >= 0 [M/T, M L^2/T], with which
  /// Coupling::kSplitting projects velocities; in a fluid without inertia inertia().
  std::vector<double> inertia_of_projection() const;

  /// By how much a mean force in the step changes the velocity at its end [T/M, T/(M L^2)]: h/m.
  /// For particles without mass it is the inverse of the Stokes drag, for driven ones 0.
  std::vector<double> mobility_of_step() const;

  /// In a fluid with inertia, without contact: particles move with U plus this share [1] of the
  /// change of U since the step before. It is -1/2 in the first step, and 0 if the step before was
  /// shorter than half of this one, because its change says little.
  double share_of_change() const;

  /// The mean over the step of the given motion of a driven particle: x, y [L/T] and angular
  /// velocity [1/T]; on an axis only the first number, along z. Throws std::out_of_range for
  /// another particle.
  std::array<double, 3> given_in_step(std::int32_t driven) const;

  /// u^n of all components [L/T, 1/T]; of driven particles their given motions.
  std::vector<double> velocities() const;

  /// True if the velocity of particle `k` is prescribed.
  bool is_driven(std::int32_t k) const { return driven_.contains(k); }
  /// True if the velocity of particle `k` may jump, so that it has theta = 1. The reason is a
  /// contact in the step before or in put_in_contact(), an arm whose rate of length jumps, or a
  /// link to a particle whose given velocity jumps. It may also be the reason of another particle
  /// that moves with this one because of rigid bodies, arms and stiff springs.
  bool is_in_contact(std::int32_t k) const { return in_contact_[index_of(k)] != 0; }

  /// Puts the particles of contacts with an impulse in contact, except driven ones. Returns true if
  /// this changed an inertia, or the order of the step of a fluid with inertia: the step must be
  /// solved again.
  bool put_in_contact(std::span<const Contact<2>> contacts);

  /// True if a particle is in contact.
  bool is_any_in_contact() const;

  /// True if all given motions are the same as in the step before, and no rate of an arm's length
  /// has jumped.
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
  /// |F|/|U| [M/T] of the force F on the fluid and the velocity U in the step before, or of torque
  /// and angular velocity [M L^2/T]; 0 if there was no motion, infinite if there was no step.
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
  std::vector<double> forces_;  // f
  std::vector<double> thetas_, inertia_;
  std::map<std::int32_t, std::array<double, 3>> driven_;
  std::vector<char> in_contact_;
  std::vector<double> link_times_;
  // Particles that move with each other because of bodies, arms and stiff springs: sets of two or
  // more. Driven particles are in none, because nothing that others do changes their velocities.
  std::vector<std::vector<std::int32_t>> companions_;
};

}  // namespace viscontact::particles
