// Reynolds' equation in the film of a sphere and its neighbour (docs/physics.md (2.9), (2.10)).
#include "viscontact/lubrication/near_contact.hpp"

#include <cassert>
#include <numbers>

namespace viscontact::lubrication {
namespace {

/// The coefficients of ln(1/q) in the force along x and in the torque about y on the sphere, in
/// units of mu r U and mu r^2 U, where mu is the viscosity, r the radius and U the velocity of the
/// sphere, or r times its angular velocity.
struct FilmAction {
  double force = 0, torque = 0;
};

/// (2.10) of docs/physics.md. `move` is the velocity of the sphere along x, and `turn` its angular
/// velocity about y, both in units of U; one of them is 1, the other one 0.
FilmAction across(double move, double turn, const NeighbourSurface& neighbour) {
  constexpr double kPi = std::numbers::pi;
  // Beside a plane without tangential stress (shear-free) the film does not resist sliding, and
  // rolling has a torque only.
  if (neighbour.is_shear_free) return {0, -6 * kPi / 5 * turn};
  // At the distance rho from the axis the film has the thickness q + kappa rho^2/2.
  const double kappa = 1 + neighbour.curvature;
  // slip: velocity of the sphere's surface at the gap minus that of the neighbour's surface.
  // source: the right side S of Reynolds' equation (2.9).
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
  assert(motion != MotionKind::kApproach && neighbour.curvature > -1);
  assert(neighbour.velocity_ratio == 0 || neighbour.curvature > 0);
  assert(!neighbour.is_shear_free || neighbour.curvature == 0);
  constexpr double kForceUnit = 6 * std::numbers::pi, kTorqueUnit = 8 * std::numbers::pi;
  if (motion == MotionKind::kSpin) {
    const double kappa = 1 + neighbour.curvature;
    const double relative = neighbour.is_shear_free ? 0 : 1 - neighbour.velocity_ratio;
    return {"q ln q", 0, relative / (2 * kappa * kappa)};
  }
  const bool moves = motion == MotionKind::kSlide;
  const auto action = across(moves ? 1 : 0, moves ? 0 : 1, neighbour);
  // ln q = -ln(1/q), and the factors are those of -force and -torque: both signs cancel.
  return {"ln q", action.force / kForceUnit, action.torque / kTorqueUnit};
}

}  // namespace viscontact::lubrication
