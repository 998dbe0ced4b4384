// The equation of motion of a step in a fluid, docs/physics.md (6.1) and (6.5).
#pragma once

#include <array>
#include <cassert>
#include <map>
#include <span>
#include <vector>

#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// The largest ratio [1] of the length of a step to that of the step before it with which
/// differences of second order are taken. Such differences are stable up to 1 + sqrt(2) (Grigorieff
/// 1983).
inline constexpr double kLargestRatioOfSteps = 2;

/// The equation (6.5) of one step of length h from the time t^n to t^{n+1}. With the velocities u^n
/// of all particles at t^n, the diagonal matrix M of masses m and moments of inertia, the mean
/// force f over the step and the resistance R of the fluid, the velocities U in the step solve
///
///     M (u^{n+1} - u^n)/h = f - R U + contact forces,   U = theta u^{n+1} + (1 - theta) u^n,
///
/// that is (R + M/(theta h)) U = f + M/(theta h) u^n + contact forces. A particle without mass has
/// theta = 1 and u^{n+1} = U. Others have theta = (1 + z)/(2 + z) with z = h c/m, where c is the
/// larger one of the Stokes drag per velocity and the drag in the step before, which near a wall is
/// many times as large. In the first step and in contact theta is 1 (implicit Euler).
///
/// In a fluid with inertia the problem of the fluid solver contains the masses (FlowStep). Here all
/// inertia is then 0, theta is 1, U = u^n, and forces contain the buoyancy in place of the
/// hydrostatic pressure. Forces and given motions are means from the middle of the step before to
/// the middle of this one, so that the forces of all steps together have the whole impulse.
class StepEquation {
 public:
  /// The equation of a step of length h [T] that ends at the time `next` [T]. `setting` has a
  /// fluid, and `state` is the state before the step; both must outlive the object. Particles that
  /// had a contact in the step before, or whose film remembers an impulse, are in contact.
  StepEquation(const Setting& setting, const State& state, double h, double next);

  // Arrays have motion_components() numbers for each particle.

  /// The particles for FluidSolver::place(). The spans of the result refer to this object and to
  /// the state.
  FluidParticles bodies() const;

  /// f + M/(theta h) u^n [M L/T^2, M L^2/T^2]. If a rigid body accelerates and its velocity does
  /// not jump, the forces on its members act at their places in the middle of the step.
  std::vector<double> right_side() const;

  /// f [M L/T^2, M L^2/T^2].
  const std::vector<double>& forces() const { return forces_; }
  /// M/(theta h) >= 0 [M/T, M L^2/T]; 0 without inertia, and in a fluid with inertia.
  const std::vector<double>& inertia() const { return inertia_; }

  /// u^{n+1} [L/T, 1/T] of particles that move with the velocities `motions` in the step; `flow`
  /// for components without inertia and for driven particles, whose motion is given.
  std::vector<double> velocities_at_end(std::span<const double> motions,
                                        std::span<const double> flow) const;

  /// The velocities [L/T, 1/T] by which forces must be multiplied to give their power in the step:
  /// U = `flow` for the part that balances `drag`, the forces on the fluid, and (u^n + u^{n+1})/2
  /// with u^{n+1} = `at_end` for the part that accelerates the particle. With U alone the power
  /// would contain the energy that a step with theta > 1/2 loses if a velocity jumps.
  std::vector<double> velocities_of_work(std::span<const double> flow,
                                         std::span<const double> at_end,
                                         std::span<const double> drag) const;

  /// For each particle that accelerates (it has a mass, or a share of that of its body, and no
  /// given motion), the time [T] after the beginning of the step at which its links act; -1 for
  /// others. The time is h/2 - (2 theta - 1) (1 - theta) h, but 0 in the first step and if the
  /// velocity may jump. Empty if no particle accelerates, and in a fluid with inertia.
  const std::vector<double>& link_times() const { return link_times_; }

  /// In a fluid with inertia, the differences that approximate rates of change, and the masses,
  /// which belong to this object; otherwise all members are 0 or empty. The order is 2 from the
  /// third step on, if no velocity may jump and the ratio of steps is at most kLargestRatioOfSteps.
  FlowStep flow_step() const;

  /// The inertia >= 0 [M/T, M L^2/T] by which Coupling::kSplitting weights changes of velocities:
  /// the mass over the length of the step in a fluid with inertia, otherwise inertia().
  std::vector<double> inertia_of_projection() const;

  /// By how much a mean force or torque in the step changes the velocity at its end, per force
  /// [T/M, T/(M L^2)]: h/m, without mass the inverse of the Stokes drag, for driven particles 0.
  std::vector<double> mobility_of_step() const;

  /// At least the order of the largest change of each velocity in the step by a force: the smaller
  /// one of h/m and the inverse of the Stokes drag; for driven particles 0.
  std::vector<double> largest_mobility() const;

  /// In a fluid with inertia, particles without contact move with U plus this share [1] of the
  /// change of U since the step before: h over twice the length of the step before; -1/2 in the
  /// first step; 0 if the step before was shorter than half of this one, because the change in a
  /// short step says little.
  double share_of_change() const;

  /// The mean over the step of the given motion of particle `driven`, as given_motion(). Throws
  /// std::out_of_range if it is not driven.
  std::array<double, 3> given_in_step(std::int32_t driven) const;

  /// u^n; for driven particles their given motions.
  std::vector<double> velocities() const;

  bool is_driven(std::int32_t k) const { return driven_.contains(k); }
  /// True if the velocity of particle `k` may jump, so that its theta is 1: because of a contact, a
  /// hinge at a stop, an arm whose rate of length jumps, or a link to a particle whose given
  /// velocity jumps, of this particle or of one that moves with it.
  bool is_in_contact(std::int32_t k) const {
    assert(index_of(k) < in_contact_.size());
    return in_contact_[index_of(k)] != 0;
  }

  /// Puts the particles of those `contacts` whose impulse is not 0 in contact, except driven ones.
  /// Returns true if this changed a theta, or the order of the step of a fluid with inertia; the
  /// step must then be solved again.
  bool put_in_contact(std::span<const Contact<2>> contacts);

  bool is_any_in_contact() const;

  /// True if no given motion differs from that in the step before, and no rate of an arm's length
  /// jumps in this step or the step before.
  bool drives_as_before() const;

 private:
  /// Times [T]: forces are means from `from_of_forces` to `to`, given motions from `from` to `to`.
  struct Window {
    double from_of_forces, from, to;
  };
  static Window window(const Setting& setting, const State& state, double h, double next);
  void add_inertia();
  /// Also sets in_contact_ of particles whose velocities may jump because of a link.
  void find_companions();
  /// To all particles that move with a particle in contact.
  void spread_contact();
  bool has_jump(std::int32_t driven) const;
  /// Force per velocity of a sphere, or torque per angular velocity of a disc.
  double stokes_drag(std::size_t k, std::size_t component) const;
  /// Of a particle without a body, with the mass [M] or moment of inertia [M L^2] `mass`.
  double theta(std::size_t k, std::size_t component, double mass) const;
  double theta_of_body(const RigidBody& body) const;
  /// |F|/|U| of the force F on the fluid and the velocity U in the step before, or of torque and
  /// angular velocity; 0 if there was no motion, infinite if there was no step.
  double earlier_drag(std::size_t k, std::size_t component) const;
  double velocity(std::size_t k, std::size_t component) const;
  /// The mean between two times [T]: x, y [L/T] and angular velocity [1/T]; on an axis z, 0, 0.
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
  // Particles that move with each other because of bodies, arms and stiff springs, but no driven
  // ones, whose velocities others do not change.
  std::vector<std::vector<std::int32_t>> companions_;
};

}  // namespace viscontact::particles
