// The equation of motion of a step in a fluid: forces, inertia and given motions, docs/physics.md
// (6.1) and (6.5). Lengths [L], masses [M] and times [T] are in any consistent units; in the plane
// masses and forces are per unit length. Nothing is checked, and only given_in_step() throws.
// fluid_simulation.cpp and fluid_links.cpp use the class. A change must keep the second order in
// time away from contact.
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

/// The largest ratio [1] of the length of a step to that of the step before it with which
/// differences of second order are taken. Such differences are stable up to 1 + sqrt(2) (Grigorieff
/// 1983); below this bound the value is a free choice.
inline constexpr double kLargestRatioOfSteps = 2;

/// The equation of one step of length h from the time t^n to t^{n+1}. u^n are the velocities of all
/// particles at t^n, and M is the diagonal matrix of their masses m and moments of inertia. With
/// the mean force f over the step and the resistance R of the fluid (force per velocity), the
/// velocities U in the step solve
///
///     M (u^{n+1} - u^n)/h = f - R U + contact forces,   U = theta u^{n+1} + (1 - theta) u^n,
///
/// that is (R + M/(theta h)) U = f + M/(theta h) u^n + contact forces. A particle without mass has
/// theta = 1 and u^{n+1} = U. All others have theta = (1 + z)/(2 + z) with z = h c/m and the drag c
/// per velocity. If z is small, theta is 1/2 + O(h), with which the step is of second order. If z
/// is large, theta is close to 1, so that velocities do not oscillate. c is the larger one of the
/// Stokes drag and the drag in the step before, because near a wall the drag is many times the
/// Stokes drag. In the first step theta is 1, which does not change the order. A particle in
/// contact has theta = 1 (implicit Euler), because its velocity may jump.
///
/// In a fluid with inertia the problem of the fluid solver contains the masses (FlowStep). In this
/// class all inertia is then 0 and theta is 1. U = u^n are the velocities at the time t^n, and
/// forces contain the buoyancy in place of the hydrostatic pressure. Forces and given motions are
/// means from the middle of the step before to the middle of this one. The forces of all steps
/// together then have the whole impulse, wherever a force jumps.
class StepEquation {
 public:
  /// The equation of a step of length h > 0 [T] that ends at the time `next` [T]. `setting` must
  /// have a fluid, and `state` is the state before the step. Both references must outlive the
  /// object. Particles that had a contact in the step before are in contact.
  StepEquation(const Setting& setting, const State& state, double h, double next);

  // An array has motion_components() numbers for each particle unless its comment says otherwise.

  /// The particles for FluidSolver::place(), with M/(theta h) as FluidParticles::inertia. The spans
  /// of the result refer to this object and to the state.
  FluidParticles bodies() const;

  /// f + M/(theta h) u^n [M L/T^2, M L^2/T^2]. If a rigid body accelerates and its velocity does
  /// not jump, the forces on its members act at the places of the members in the middle of the
  /// step.
  std::vector<double> right_side() const;

  /// f [M L/T^2, M L^2/T^2].
  const std::vector<double>& forces() const { return forces_; }
  /// M/(theta h) >= 0 [M/T, M L^2/T]; 0 without inertia, and in a fluid with inertia.
  const std::vector<double>& inertia() const { return inertia_; }

  /// u^{n+1} [L/T, 1/T] of particles that move with the velocities `motions` in the step. For
  /// components without inertia and for driven particles, whose motion is given, it is `flow`,
  /// their velocity at the beginning of the step.
  std::vector<double> velocities_at_end(std::span<const double> motions,
                                        std::span<const double> flow) const;

  /// The velocities [L/T, 1/T] by which forces must be multiplied to give their power in the step.
  /// `drag` are the forces of the particles on the fluid. The part of a force that balances `drag`
  /// is multiplied by U = `flow`, the part that accelerates the particle by (u^n + u^{n+1})/2, with
  /// u^{n+1} = `at_end`. If U alone were used, the power would contain the energy that a step with
  /// theta > 1/2 loses if a velocity jumps.
  std::vector<double> velocities_of_work(std::span<const double> flow,
                                         std::span<const double> at_end,
                                         std::span<const double> drag) const;

  /// For each particle that accelerates, the time [T] after the beginning of the step at which its
  /// links act; -1 for other particles. A particle accelerates if it has a mass (its own, or a
  /// share of that of its body) and no given motion. The time is h/2 - (2 theta - 1) (1 - theta) h,
  /// but 0 in the first step and if the velocity of the particle may jump. The array has one number
  /// for each particle; it is empty if no particle accelerates, and in a fluid with inertia.
  const std::vector<double>& link_times() const { return link_times_; }

  /// In a fluid with inertia, the differences by which the fluid solver approximates rates of
  /// change, and the masses, which belong to this object. The order is 2 from the third step on, if
  /// no velocity may jump and the last step is at most kLargestRatioOfSteps times as long as the
  /// one before it; otherwise 1. In a fluid without inertia all members are 0 or empty.
  FlowStep flow_step() const;

  /// The inertia >= 0 [M/T, M L^2/T] by which Coupling::kSplitting weights changes of velocities.
  /// In a fluid with inertia it is the mass or moment of inertia divided by the length of the step;
  /// otherwise it is inertia().
  std::vector<double> inertia_of_projection() const;

  /// By how much a mean force or torque in the step changes the velocity at its end [T/M,
  /// T/(M L^2)], per force: h/m, or h over the moment of inertia. For particles without mass it is
  /// the inverse of the Stokes drag, for driven particles 0.
  std::vector<double> mobility_of_step() const;

  /// At least the order of the largest change of each velocity in the step by a force, per force
  /// [T/M, T/(M L^2)]: the smaller one of h/m (h over the moment of inertia) and the inverse of the
  /// Stokes drag; for driven particles 0.
  std::vector<double> largest_mobility() const;

  /// In a fluid with inertia, particles without contact move with U plus this share [1] of the
  /// change of U since the step before. The share is h divided by twice the length of the step
  /// before. It is -1/2 in the first step, and 0 if the step before was shorter than half of this
  /// step, because the change in a short step says little.
  double share_of_change() const;

  /// The mean over the step of the given motion of the driven particle with the number `driven`: x,
  /// y [L/T] and angular velocity [1/T]. On an axis the first number is the velocity along z, and
  /// the others are 0. Throws std::out_of_range if the particle is not driven.
  std::array<double, 3> given_in_step(std::int32_t driven) const;

  /// u^n of all components [L/T, 1/T]; for driven particles their given motions.
  std::vector<double> velocities() const;

  /// True if the motion of particle `k` is given.
  bool is_driven(std::int32_t k) const { return driven_.contains(k); }
  /// True if the velocity of particle `k` may jump, so that its theta is 1. The reason is a contact
  /// in the step before or in put_in_contact(), a hinge that rests at a stop, an arm whose rate of
  /// length jumps, or a link to a particle whose given velocity jumps. The same holds if there is
  /// such a reason for another particle that moves with this one because of rigid bodies, arms and
  /// stiff springs.
  bool is_in_contact(std::int32_t k) const { return in_contact_[index_of(k)] != 0; }

  /// Marks the particles of those `contacts` whose impulse is not 0 as in contact, except driven
  /// particles. Returns true if this changed a theta, or the order of the step of a fluid with
  /// inertia; the step must then be solved again.
  bool put_in_contact(std::span<const Contact<2>> contacts);

  /// True if a particle is in contact.
  bool is_any_in_contact() const;

  /// True if all given motions are the same as in the step before, and if no rate of an arm's
  /// length jumps in this step or the step before.
  bool drives_as_before() const;

 private:
  /// Times [T]: forces are means from `from_of_forces` to `to`, given motions from `from` to `to`.
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
  std::vector<double> masses_;  // mass or moment of inertia of each component [M, M L^2]
  double next_;                 // time at which the step ends [T]
  Window window_;
  std::vector<double> forces_;  // f
  std::vector<double> thetas_, inertia_;
  std::map<std::int32_t, std::array<double, 3>> driven_;
  std::vector<char> in_contact_;
  std::vector<double> link_times_;
  // Sets of two or more particles that move with each other because of bodies, arms and stiff
  // springs. Driven particles are in no set, because other particles do not change their
  // velocities.
  std::vector<std::vector<std::int32_t>> companions_;
};

}  // namespace viscontact::particles
