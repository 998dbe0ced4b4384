// Reynolds' equation in the film of a sphere and its neighbour (docs/physics.md (2.9), (2.10)).
#include "viscontact/lubrication/near_contact.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/lubrication/pairs/pair_near_contact.hpp"

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

namespace {

/// The flows of an azimuthal mode: their entries in kPairEntryTerms, and the singular terms.
struct Block {
  std::size_t first, count;
  std::size_t term;  ///< the most singular one: 0: 1/q, 1: ln q, 2: q ln q
};

Block block_of(MotionKind motion) {
  if (is_axial(motion)) return {0, 10, 0};
  if (motion == MotionKind::kTwofoldStrain) return {31, 3, 2};
  if (motion == MotionKind::kSpin) return {34, 3, 2};
  return {10, 21, 1};
}

PairComponent component_of(MotionKind motion) {
  if (is_strain(motion)) return kStrain;
  return motion == MotionKind::kApproach || motion == MotionKind::kSlide ? kMove : kTurn;
}

/// The sign that a component gets by the mirror from the axis of pair_near_contact.hpp, which goes
/// from the sphere to its neighbour, to the axis of tables.
double parity(const Block& block, PairComponent component) {
  const bool is_across = block.term == 1, is_axial = block.term == 0;
  if (component == kMove) return is_axial ? -1 : 1;
  return is_across ? -1 : 1;
}

/// The coefficient of block.term by (radius 1, curvature), viscosity 1, loads E:S.
double coefficient(const Block& block, const PairEntryTerms& entry, double curvature) {
  const auto& [denominator, numerator] = entry.terms[block.term];
  // pi numerator(b)/(denominator (1 + b)^3) ((1 + b)/2)^(1 - term), in powers of 1/b.
  const auto term = static_cast<double>(block.term);
  double sum = 0;
  for (std::size_t p = 0; p < numerator.size(); ++p) {
    const double power = 2 + term - static_cast<double>(p);
    if (numerator[p] != 0) sum += numerator[p] * std::pow(curvature, power);
  }
  return std::numbers::pi * sum / denominator * std::pow(1 + curvature, -(2 + term)) /
         std::pow(2, 1 - term);
}

}  // namespace

LeadingLoads leading_loads(MotionKind motion, double curvature) {
  assert(curvature >= 0);
  const auto block = block_of(motion);
  const auto source = component_of(motion);
  const auto units = action_units(motion, 1, 1);
  // E of a strain at the rate 1 over the unit tensor of the table, whose E:S over the stresslet is
  // 1 (axial) or 2.
  const double rate = motion == MotionKind::kAxialStrain ? 1.5 : 1;
  const double contracted = block.term == 0 ? 1 : 2;
  LeadingLoads loads;
  for (const auto& entry : std::span(kPairEntryTerms).subspan(block.first, block.count))
    for (const bool is_transposed : {false, true}) {
      const auto row = is_transposed ? entry.column : entry.row;
      const auto column = is_transposed ? entry.row : entry.column;
      const int body = is_transposed ? entry.column_sphere : entry.row_sphere;
      const int of = is_transposed ? entry.row_sphere : entry.column_sphere;
      if (column != source || of != 0 || (body == 1 && curvature == 0)) continue;
      const double value =
          parity(block, row) * parity(block, column) * rate * coefficient(block, entry, curvature);
      auto& factors = body == 0 ? loads.sphere : loads.neighbour;
      // Forces and torques are on the fluid there, and have the sign of the factors.
      if (row == kMove) factors.force = value / units.force;
      if (row == kTurn) factors.torque = value / units.torque;
      if (row == kStrain) factors.stresslet = value / contracted / units.stresslet;
    }
  return loads;
}

}  // namespace viscontact::lubrication
