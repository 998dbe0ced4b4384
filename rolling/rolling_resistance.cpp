// Sums the terms of the fits of the resistances of the fluid, and decides between rolling and
// sliding. Gaps [L], > 0 (not checked), and the resistances `slide` [M/T], `roll` [M L^2/T] and
// `slide_roll` [M L/T] are in the units of the fit. The formula of the fit is also used below its
// smallest gap. A missing resistance, and a gap above those of the fit, throw Error(kBadInput).
// rolling/roll_with_*.cpp use this file. A change must keep the matrix of the resistances
// symmetric, and weights in the order of lubrication::all_terms().
#include "viscontact/rolling/rolling_resistance.hpp"

#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::rolling {
namespace {

using motions::PairEntry;

/// The coefficients of the fit of one resistance, in the order of lubrication::all_terms().
std::vector<double> weights_of(const motions::PairFit& fit, PairEntry entry) {
  std::vector<double> weights(lubrication::all_terms().size());
  for (const auto& term : fit.entries.at(entry).fit.terms)
    weights[lubrication::place_of(term.name)] += term.coefficient;
  return weights;
}

}  // namespace

/// Reads the coefficients of the resistances. Throws Error(kBadInput) if `fit` lacks one of the
/// four entries squeeze, slide, roll and slide_roll.
RollingFluid::RollingFluid(const motions::PairFit& fit) : fit_(fit) {
  for (const auto entry :
       {PairEntry::kSqueeze, PairEntry::kSlide, PairEntry::kRoll, PairEntry::kSlideRoll})
    if (!fit.entries.contains(entry))
      throw Error(
          ErrorKind::kBadInput,
          "the fit lacks the entry {}; it must be made from tables of approach, slide and roll",
          motions::pair_entries()[static_cast<std::size_t>(entry)].name);
  slide_ = weights_of(fit, PairEntry::kSlide);
  roll_ = weights_of(fit, PairEntry::kRoll);
  slide_roll_ = weights_of(fit, PairEntry::kSlideRoll);
}

/// Throws Error(kBadInput) if the gap [L] is above those of the fit.
void RollingFluid::check(double gap) const {
  if (gap > fit_.gap_interval[1])
    throw Error(ErrorKind::kBadInput,
                "the sphere rises above the gap {}, up to which the fit is known; tabulate and fit "
                "larger gaps",
                format_number(fit_.gap_interval[1]));
}

/// The three resistances at the gap [L].
RollingResistance RollingFluid::at(double gap) const {
  check(gap);
  const auto sum = [gap](const auto& weights) { return lubrication::sum_values(weights, gap); };
  return {sum(slide_), sum(roll_), sum(slide_roll_)};
}

/// The derivatives of the three resistances by the logarithm of the gap, in their units.
RollingResistance RollingFluid::slopes(double gap) const {
  check(gap);
  const auto sum = [gap](const auto& weights) { return lubrication::sum_log_slopes(weights, gap); };
  return {sum(slide_), sum(roll_), sum(slide_roll_)};
}

/// Coulomb's friction on the lowest point of the sphere, which is a force [M L/T^2] or an impulse
/// [M L/T]. `slip` is the velocity of the lowest point without friction [L/T], or its rate [L/T^2];
/// `compliance` > 0 is the change of `slip` per unit of friction, and `bound` >= 0 is the largest
/// friction; neither is checked. The sphere rolls if a friction of at most `bound` makes the slip
/// 0; otherwise it slides with the friction `bound` against the slip.
Friction coulomb(double slip, double compliance, double bound) {
  const double sticking = -slip / compliance;
  if (std::abs(sticking) <= bound) return {sticking, SolidContact::kRolling};
  return {std::copysign(bound, sticking), SolidContact::kSliding};
}

}  // namespace viscontact::rolling
