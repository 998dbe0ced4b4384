// The solution of Reynolds' equation in the film between a sphere and its neighbour, which slide
// past each other or turn (docs/physics.md (2.9), (2.10)). Lengths are in sphere radii, q is the
// gap, mu the viscosity, r the radius. The neighbour's curvature is the radius of the sphere over
// that of the neighbour (0: a plane). kappa is 1 plus this curvature; at the distance rho from the
// axis the film has the thickness q + kappa rho^2/2. The curvature must be > -1. velocity_ratio,
// the neighbour's velocity over that of the sphere, must be 0 unless the curvature is > 0. Results
// are numbers of any sign. Nothing is checked or thrown. This file is used by
// freefem_axi/motion_table_plan.cpp. A change must keep the coefficients, which published tables
// contain.
#include "viscontact/lubrication/near_contact.hpp"

#include <numbers>

namespace viscontact::lubrication {
namespace {

/// The coefficients of ln(1/q) in the force along x and in the torque about y on the sphere, in
/// units of mu r U and mu r^2 U, where U is the velocity of the sphere, or r times its angular
/// velocity.
struct FilmAction {
  double force = 0, torque = 0;
};

/// Evaluates (2.10) of docs/physics.md. `move` is the velocity of the sphere along x, and `turn`
/// its angular velocity about y, both in units of U; one of them is 1, the other one 0.
FilmAction across(double move, double turn, const NeighbourSurface& neighbour) {
  constexpr double kPi = std::numbers::pi;
  // Beside a plane without tangential stress (shear-free) the film does not resist sliding, and
  // rolling has a torque only.
  if (neighbour.is_shear_free) return {0, -6 * kPi / 5 * turn};
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

/// The coefficients [1] of the term "ln q" (slide, roll) or "q ln q" (spin) in the force factor and
/// the torque factor: force over -6 pi mu r U, torque over -8 pi mu r^2 U. For the approach, which
/// has no such term, the result is that of rolling and has no meaning.
LeadingFactors leading_factors(MotionKind motion, const NeighbourSurface& neighbour) {
  constexpr double kForceUnit = 6 * std::numbers::pi, kTorqueUnit = 8 * std::numbers::pi;
  if (motion == MotionKind::kSpin) {
    const double kappa = 1 + neighbour.curvature;
    const double relative = neighbour.is_shear_free ? 0 : 1 - neighbour.velocity_ratio;
    return {"q ln q", 0, relative / (2 * kappa * kappa)};
  }
  const bool moves = motion == MotionKind::kSlide;
  const auto action = across(moves ? 1 : 0, moves ? 0 : 1, neighbour);
  // ln q = -ln(1/q), and the factors have the opposite signs of force and torque; both changes of
  // sign cancel.
  return {"ln q", action.force / kForceUnit, action.torque / kTorqueUnit};
}

}  // namespace viscontact::lubrication
