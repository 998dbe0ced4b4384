// Declares the equation of motion of the sphere with its inertia, in the form of its first integral
// (physics.md (4.1), (4.2)). q is the gap, r the radius, m the mass, u the velocity, R the
// resistance, Gamma the primitive of R, f_ext the external force; the index 0 marks values at the
// start. Lengths, masses and times are in any consistent units. Error(kBadInput) is thrown if a gap
// is outside the interval of the force; times are not checked. The models `inertial` and
// `inertial_rough` integrate the equation; rolling/ does so for the motion along the normal of the
// plane.
//
//     m d^2q/dt^2 = -R(q) dq/dt + f_ext(t)                                           (M)
//     m u + Gamma(q) = P(t) := m u0 + Gamma(q0) + int_0^t f_ext,   u = dq/dt         (I)
//     ds/dt = (P(t) - Gamma(q))/(m q),   q = r e^s                                   (S)
//
// (I) is exact, because dGamma/dq = R. With (I), (M) becomes the equation (S) of first order for
// the unknown s = ln(q/r). A change must keep that gaps are > 0 whatever the error of s, that P is
// continuous where f_ext jumps, and that s contains the radius r, which makes the error weights of
// CVODE, and so its steps, independent of the unit of length. A change of results must raise
// kModelsRevision.
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/integration/cvode.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact::reduced_model {

/// The state of the sphere at one time.
struct InertialInstant {
  double gap;             ///< q [L], > 0
  double velocity;        ///< u [L/T]
  double velocity_error;  ///< error bound of `velocity` [L/T], >= 0
  double resistance;      ///< R(q) [M/T], > 0
};

/// Equation (S) and the quantities that follow from a solution of it. Motion and force must outlive
/// the object. Every function of a gap but state_of() throws Error(kBadInput) if the gap is outside
/// the interval of the force, and so does the constructor for the initial gap. Times [T] are in [0,
/// end_time], which is not checked.
class InertialEquation {
 public:
  /// The equation for the sphere of `motion` under the drag `force`; `relative_tolerance` > 0 is
  /// the relative tolerance of the gap [1].
  InertialEquation(const Motion& motion, const lubrication::LubricationForce& force,
                   double relative_tolerance);

  double gap_of(double s) const;      ///< q = r e^s [L], for s [1]; below a second wall
  double state_of(double gap) const;  ///< s = ln(q/r), for q > 0 [1]
  double momentum(double t) const;    ///< P(t) [M L/T]
  /// Adds an impulse [M L/T] to P, such as the impulse of an impact, or of solids that carried the
  /// external force.
  void add_impulse(double impulse) { momentum_at_start_ += impulse; }

  /// Equation (S), its Jacobian and its tolerances, for CVODE. `step_begin` is the time [T] at
  /// which the present step of CVODE begins; the system reads it at each call, so it must outlive
  /// the system.
  StiffSystem system(const double& step_begin) const;

  /// The state of the sphere at time t [T] and gap q.
  ///
  /// The velocity is (P - Gamma)/m. In a film so thin that m/R is much shorter than all other
  /// times, this difference loses its digits. The velocity then follows from the balance of drag
  /// and force with its first correction for inertia, u = v - (m/R) dv/dt with v = f_ext/R,
  /// provided that both values agree within four times the error bound of the difference.
  /// `force_time` is t, or a time just before t if f_ext jumps at t, because the velocity does not
  /// jump.
  InertialInstant instant(double t, double gap, double force_time) const;

  /// The first step [T] that CVODE should try after a restart at time t and gap q; 0 leaves the
  /// choice to CVODE. It is positive if the damping time m/R is below kTimeResolution t, so that
  /// the velocity follows a jump of f_ext at once.
  double first_step(double t, double gap) const;

  /// The state s [1] near the state of `gap` [L] in which drag and force at time t are balanced. It
  /// obeys (I) exactly. If no gap of the force obeys (I), throws Error(kBadInput), or
  /// Error(kNotConverged) if the gap is too small for a double.
  double balanced_state(double t, double gap) const;

  /// True if the rest of a fall, and the damping time m/R at its end, are below kTimeResolution t.
  /// `film` [L] is then set to the gap Gamma^{-1}(P(t)), at which the velocity is 0 by (I); if the
  /// result is false, `film` has no meaning. If the force has no such gap, throws Error(kBadInput),
  /// or Error(kNotConverged) if the gap is too small for a double.
  bool lands_at_once(double t, const InertialInstant& now, double& film) const;

  /// The smallest ratio of a step to the time t that CVODE is asked to resolve, far above the
  /// rounding error of a time, 1e-16.
  static constexpr double kTimeResolution = 1e-12;

 private:
  double slope(double t, double gap) const;

  const Motion& motion_;
  const lubrication::LubricationForce& force_;
  double relative_tolerance_;
  double momentum_at_start_;  // P(0), with the impulses added
};

}  // namespace viscontact::reduced_model
