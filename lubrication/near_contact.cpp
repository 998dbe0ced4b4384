// The solution of Reynolds' equation (physics.md (2.9), (2.10)) in the film between two curved
// surfaces that move along it. Lengths are in sphere radii, q is the gap, mu the viscosity, r the
// radius, and kappa is 1 plus the neighbour's curvature. Nothing is thrown. A change must keep the
// coefficients, which published tables contain.
#include "viscontact/lubrication/near_contact.hpp"

#include <numbers>

namespace viscontact::lubrication {
namespace {

/// Force and torque on the sphere divided by ln(1/q), in units of mu r U and mu r^2 U, where U is
/// the velocity of the motion.
struct FilmAction {
  double force = 0, torque = 0;
};

/// physics.md (2.10). `move` is the velocity of the sphere along x and `turn` its angular velocity
/// about y, one of them 1 and the other one 0.
FilmAction across(double move, double turn, const NeighbourSurface& neighbour) {
  constexpr double kPi = std::numbers::pi;
  // A shear-free plane does not resist sliding in the film. Rolling presses fluid through it.
  if (neighbour.is_shear_free) return {0, -6 * kPi / 5 * turn};
  const double kappa = 1 + neighbour.curvature;
  // Velocity of the sphere's surface at the gap minus that of the neighbour's surface.
  double slip = move - turn - neighbour.velocity_ratio * move;
  double source = -turn;
  if (neighbour.velocity_ratio != 0) {
    slip -= neighbour.velocity_ratio * turn / neighbour.curvature;
    source += neighbour.velocity_ratio * turn;
  }
  source += slip * (neighbour.curvature - 1) / 2;
  const double shear = 2 * slip / kappa, pressure = 12 * source / (5 * kappa * kappa);
  return {-kPi * (shear + pressure * (1 - 2 / kappa)), kPi * (shear + pressure)};
}

}  // namespace

LeadingFactors leading_factors(MotionKind motion, const NeighbourSurface& neighbour) {
  constexpr double kForceUnit = 6 * std::numbers::pi, kTorqueUnit = 8 * std::numbers::pi;
  if (motion == MotionKind::kSpin) {
    const double kappa = 1 + neighbour.curvature;
    const double relative = neighbour.is_shear_free ? 0 : 1 - neighbour.velocity_ratio;
    return {"q ln q", 0, relative / (2 * kappa * kappa)};
  }
  const bool moves = motion == MotionKind::kSlide;
  const auto action = across(moves ? 1 : 0, moves ? 0 : 1, neighbour);
  // ln q = -ln(1/q), and factors have the sign opposite to that of force and torque.
  return {"ln q", action.force / kForceUnit, action.torque / kTorqueUnit};
}

}  // namespace viscontact::lubrication
