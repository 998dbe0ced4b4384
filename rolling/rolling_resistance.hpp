// Forces on a sphere that moves along a plane and turns: the resistance of the fluid
// (docs/physics.md (2.12)) and dry friction.
#pragma once

#include <vector>

#include "viscontact/motions/pair_fit.hpp"
#include "viscontact/rolling/rolling_motion.hpp"

namespace viscontact::rolling {

/// Velocity of the sphere along x relative to the plane, and angular velocity about y.
struct RollingVelocity {
  double move = 0;  ///< [L/T]
  double turn = 0;  ///< [1/T]
};

/// A force along x, and a torque about the axis through the centre along y; or an impulse and its
/// moment.
struct RollingForce {
  double force = 0,  ///< [M L/T^2], of an impulse [M L/T]
      torque = 0;    ///< [M L^2/T^2], of an impulse [M L^2/T]
};

/// The symmetric matrix that maps a RollingVelocity to the force and the torque with which the
/// fluid opposes this velocity (fluid_force()).
struct RollingResistance {
  double slide = 0;       ///< force per velocity [M/T], > 0 by theory
  double roll = 0;        ///< torque per angular velocity [M L^2/T], > 0 by theory
  double slide_roll = 0;  ///< [M L/T]; the entries off the diagonal are -slide_roll
};

/// The resistances of the fluid as functions of the gap q, and their derivatives by ln q.
class RollingFluid {
 public:
  /// `fit` must outlive the object. Throws Error(kBadInput) if `fit` lacks one of the entries
  /// squeeze, slide, roll and slide_roll.
  explicit RollingFluid(const motions::PairFit& fit);

  /// The resistances at a gap [L]. Below the gaps of the fit the formula of the fit is continued,
  /// because it has the terms of lubrication theory. Throws Error(kBadInput) if the gap is larger
  /// than those of the fit. The results are NaN or infinite for a gap <= 0 or NaN.
  RollingResistance at(double gap) const;
  /// The derivatives of at() by ln q, with the errors of at().
  RollingResistance slopes(double gap) const;

  /// r of the sphere [L].
  double radius() const { return fit_.radius; }
  /// Largest gap at which the resistances are known [L].
  double largest_gap() const { return fit_.gap_interval[1]; }

 private:
  /// Throws Error(kBadInput) if the gap is above those of the fit.
  void check(double gap) const;

  const motions::PairFit& fit_;
  // The coefficients of the entries in the order of lubrication::all_terms().
  std::vector<double> slide_, roll_, slide_roll_;
};

/// The force [M L/T^2] and torque [M L^2/T^2] of the fluid on the sphere.
inline RollingForce fluid_force(const RollingResistance& r, const RollingVelocity& v) {
  return {-r.slide * v.move + r.slide_roll * v.turn, r.slide_roll * v.move - r.roll * v.turn};
}

/// The velocity of the sphere's lowest point relative to the plane [L/T].
inline double slip_of(const RollingVelocity& v, double radius) { return v.move - radius * v.turn; }

/// Coulomb's dry friction: its force along x on the lowest point of a sphere, and whether the
/// sphere rolls or slides.
struct Friction {
  double force = 0;  ///< [M L/T^2], of an impulse [M L/T]
  /// kRolling if the friction prevents slip, otherwise kSliding.
  SolidContact contact = SolidContact::kRolling;
};

/// Coulomb's friction T on the lowest point of a sphere. The slip of this point would be `slip`
/// without friction, and is `slip` + `compliance` T with it. If |T| <= bound is enough to make the
/// slip 0, the slip is 0 (kRolling); otherwise T is bound or -bound, against the slip (kSliding).
/// The caller chooses one of these three sets of units:
///   T, bound [M L/T^2], a force;   slip [L/T^2], its rate;   compliance [1/M]
///   T, bound [M L/T], an impulse;  slip [L/T];               compliance [1/M]
///   T, bound [M L/T^2], a force;   slip [L/T] after a step;  compliance [T/M]
/// compliance is > 0.
Friction coulomb(double slip, double compliance, double bound);

}  // namespace viscontact::rolling
