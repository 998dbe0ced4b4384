// Forces on a sphere that moves along a plane and turns: the fluid's resistance and dry friction.
#pragma once

#include <vector>

#include "viscontact/motions/pair_fit.hpp"
#include "viscontact/rolling/rolling_motion.hpp"

namespace viscontact::rolling {

/// Velocity u of the sphere along x relative to the plane, and angular velocity w about y.
struct RollingVelocity {
  double move = 0;  ///< [L/T]
  double turn = 0;  ///< [1/T]
};

/// A force along x and a torque about y, or an impulse and its moment.
struct RollingForce {
  double force = 0,  ///< [M L/T^2], of an impulse [M L/T]
      torque = 0;    ///< [M L^2/T^2], of an impulse [M L^2/T]
};

/// The symmetric matrix that takes velocities to the force and torque against them.
struct RollingResistance {
  double slide = 0;       ///< [M/T]
  double roll = 0;        ///< [M L^2/T]
  double slide_roll = 0;  ///< [M L/T]; the entries off the diagonal are -slide_roll
};

/// The resistances at a gap, and their derivatives by ln q.
class RollingFluid {
 public:
  /// Throws Error(kBadInput) if the fit lacks squeeze, slide, roll or slide_roll.
  explicit RollingFluid(const motions::PairFit& fit);

  /// At a gap [L] > 0. Below the interval of the fit its formula is continued; it has the terms of
  /// theory. Throws Error(kBadInput) above the interval.
  RollingResistance at(double gap) const;
  RollingResistance slopes(double gap) const;  ///< d/d ln q of at()

  /// r of the sphere [L], > 0.
  double radius() const { return fit_.radius; }
  /// Largest gap at which the resistances are known [L].
  double largest_gap() const { return fit_.gap_interval[1]; }

 private:
  void check(double gap) const;

  const motions::PairFit& fit_;
  // The coefficients of the entries in the order of lubrication::all_terms().
  std::vector<double> slide_, roll_, slide_roll_;
};

/// The force of the fluid.
inline RollingForce fluid_force(const RollingResistance& r, const RollingVelocity& v) {
  return {-r.slide * v.move + r.slide_roll * v.turn, r.slide_roll * v.move - r.roll * v.turn};
}

/// The velocity of the sphere's lowest point relative to the plane [L/T].
inline double slip_of(const RollingVelocity& v, double radius) { return v.move - radius * v.turn; }

/// Dry friction (Coulomb): the force along x on the lowest point of a sphere, and what it does.
struct Friction {
  double force = 0;  ///< [M L/T^2], of an impulse [M L/T]
  /// kRolling if the friction prevents slip, otherwise kSliding.
  SolidContact contact = SolidContact::kRolling;
};

/// The friction on a sphere of which the lowest point would have the slip (or its rate) `slip`
/// without friction and `slip` + `compliance` T with the friction T: no slip if |T| <= bound, else
/// T = -+bound.
Friction coulomb(double slip, double compliance, double bound);

}  // namespace viscontact::rolling
