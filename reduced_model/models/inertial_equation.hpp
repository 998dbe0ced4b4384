// The equation of motion of the sphere with its inertia, problem (M), by way of its first integral.
//
//     m d^2q/dt^2 = -R(q) dq/dt + f_ext(t)                                           (M)
//     m u + Gamma(q) = P(t) := m u0 + Gamma(q0) + int_0^t f_ext,   u = dq/dt         (I)
//     ds/dt = (P(t) - Gamma(q))/(m q),   q = r e^s                                   (S)
//
// (I) is exact, because Gamma' = R; it leaves the equation (S) of first order, in s = ln(q/r). A change
// of this file must keep: gaps stay above 0 whatever the error of s; P is continuous where f_ext
// jumps; and the radius r in s makes the error weights of CVODE, and so its steps, independent of the
// unit of length.
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/integration/cvode.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact {

/// The sphere at one time.
struct InertialInstant {
  double gap;             ///< q [L], > 0
  double velocity;        ///< u [L/T]
  double velocity_error;  ///< by how much `velocity` may be off [L/T], >= 0
  double resistance;      ///< R(q) [M/T]
};

/// Equation (S) and what follows from a solution of it. The motion and the force must outlive it.
class InertialEquation {
 public:
  InertialEquation(const Motion& motion, const LubricationForce& force);

  double gap_of(double s) const;      ///< q = r e^s [L]
  double state_of(double gap) const;  ///< s = ln(q/r)
  double momentum(double t) const;    ///< P(t) [M L/T]

  /// (S), its Jacobian and its tolerances, for CVODE. `step_begin` is read at each call: the time
  /// at which the present step of CVODE begins.
  StiffSystem system(const double& step_begin) const;

  /// The sphere at time t and gap q.
  ///
  /// Its velocity is (P - Gamma)/m, or, where that cancels (a film so thin that m/R is short beside
  /// all other times), the balance of the drag and the force with its first correction for inertia,
  /// u = u_0 - (m/R) du_0/dt, u_0 = f/R, if both agree to within the error of the former.
  /// `force_time`: t, or just before t where f_ext jumps at t, because the velocity does not jump.
  InertialInstant instant(double t, double gap, double force_time) const;

  /// The first step [T] that CVODE should try at time t and gap q after a restart; 0 leaves it to
  /// CVODE. After a jump of f_ext, a film that damps within the rounding of t follows at once.
  double first_step(double t, double gap) const;

  /// The state in which the balance of forces at time t holds as well as (I) lets it.
  double balanced_state(double t, double gap) const;

  /// True if what is left of a fall is over before t has another digit: the film of thickness
  /// Gamma^{-1}(P) then takes all the momentum at once. `film` is set to that thickness [L].
  bool lands_at_once(double t, const InertialInstant& now, double& film) const;

  /// Fraction of a time that a step can still resolve.
  static constexpr double kTimeResolution = 1e-12;

 private:
  double slope(double t, double gap) const;

  const Motion& motion_;
  const LubricationForce& force_;
  double momentum_at_start_;  // P(0)
};

}  // namespace viscontact
