// The equation of motion of the sphere with its inertia in the form of its first integral,
// physics.md (4.1) and (4.2).
#pragma once

#include <cstddef>
#include <limits>

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/integration/cvode.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact::reduced_model {

/// The state of the sphere at one time, in any consistent units.
struct InertialInstant {
  double gap;             ///< q [L], > 0
  double velocity;        ///< u [L/T]
  double velocity_error;  ///< error bound of `velocity` [L/T], >= 0
  double resistance;      ///< R(q) [M/T], > 0
};

/// Free choices of the integration of (S).
struct InertialTuning {
  /// Fraction of the tolerance of the user that a step may have, because the errors of earlier
  /// steps add to its error. simulate_inertial() states it, and its product with kFlightShare.
  static constexpr double kShare = 0.1;
  /// Fraction of the error of other steps that a step in free flight may have: the film damps
  /// errors so slowly there that they do not decay before the motion ends, and a landing, in which
  /// ln q changes fast, multiplies them.
  static constexpr double kFlightShare = 3e-4;
  /// If the motion lasts more than this many damping times m/R, errors decay before it ends.
  static constexpr double kManyDampings = 10;
  /// Relative rounding error of s, below which no error is asked for.
  static constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  /// The smallest ratio of a step to the time t that CVODE is asked to resolve, far above the
  /// rounding error of a time, 1e-16.
  static constexpr double kTimeResolution = 1e-12;
  /// If m times the velocity is more than kMuchInertia times R q, and the velocity from the
  /// momentum is more than kExactMomentum times its error (three exact digits), this velocity is
  /// more exact than that from the balance of drag and force.
  static constexpr double kMuchInertia = 1e-2, kExactMomentum = 1e3;
  /// Error bounds of the velocity from the momentum within which that from the balance agrees.
  static constexpr double kAgreement = 4;
  /// If a step has more rows than this, the expansion of s in powers of the time takes less time
  /// than an interpolation by CVODE for each row.
  static constexpr std::ptrdiff_t kManyRows = 8;
};

/// The first integral of the motion and what follows from it. q is the gap, r the radius, m the
/// mass, u the velocity, R the resistance, Gamma its primitive, f_ext the external force; the index
/// 0 marks values at the start:
///
///     m u + Gamma(q) = P(t) := m u0 + Gamma(q0) + int_0^t f_ext,   u = dq/dt         (I)
///     ds/dt = (P(t) - Gamma(q))/(m q),   q = r e^s                                   (S)
///
/// The unknown s keeps gaps > 0 whatever its error. It contains r, so that the error weights of
/// CVODE do not depend on the unit of length. Motion and force must outlive the object. Every
/// function of a gap but state_of() throws Error(kBadInput) if the gap is outside the interval of
/// the force, and so does the constructor for the initial gap.
class InertialEquation {
 public:
  /// `relative_tolerance` > 0 is the relative tolerance of the gap [1].
  InertialEquation(const Motion& motion, const lubrication::LubricationForce& force,
                   double relative_tolerance);

  double gap_of(double s) const;      ///< q = r e^s [L], for s [1]; below a second wall
  double state_of(double gap) const;  ///< s = ln(q/r), for q > 0 [1]
  double momentum(double t) const;    ///< P(t) [M L/T]
  /// Adds an impulse to P, such as that of an impact.
  void add_impulse(double impulse) { momentum_at_start_ += impulse; }

  /// Equation (S), its Jacobian and its tolerances, for CVODE. The system reads `step_begin`, the
  /// time at which the present step of CVODE begins, at each call.
  StiffSystem system(const double& step_begin) const;

  /// The state of the sphere at time t [T] and gap q.
  ///
  /// The velocity is (P - Gamma)/m. In a film so thin that m/R is much shorter than all other
  /// times, this difference loses its digits. The velocity then follows from the balance of drag
  /// and force with its first correction for inertia, u = v - (m/R) dv/dt with v = f_ext/R,
  /// provided that both values agree within InertialTuning::kAgreement error bounds.
  /// `force_time` is t, or a time just before t if f_ext jumps at t, because the velocity does not
  /// jump.
  InertialInstant instant(double t, double gap, double force_time) const;

  /// The first step that CVODE should try after a restart; 0 leaves the choice to CVODE. It is
  /// positive if the damping time m/R is below InertialTuning::kTimeResolution t, so that the
  /// velocity follows a jump of f_ext at once.
  double first_step(double t, double gap) const;

  /// The state near that of `gap` in which drag and force at time t are balanced. It obeys (I)
  /// exactly. If no gap of the force does, throws Error(kBadInput), or Error(kNotConverged) if the
  /// gap is too small for a double.
  double balanced_state(double t, double gap) const;

  /// True if the rest of a fall, and the damping time m/R at its end, are below
  /// InertialTuning::kTimeResolution t. Then `film` is the gap Gamma^{-1}(P(t)), at which the
  /// velocity is 0 by (I). Throws the errors of balanced_state().
  bool lands_at_once(double t, const InertialInstant& now, double& film) const;

 private:
  // ds/dt at the time t and this gap [1/T].
  double slope(double t, double gap) const;

  const Motion& motion_;
  const lubrication::LubricationForce& force_;
  double relative_tolerance_;
  double momentum_at_start_;  // P(0), with the impulses added
};

}  // namespace viscontact::reduced_model
