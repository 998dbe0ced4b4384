// Sums the terms of the fits of the resistances, and decides between rolling and sliding. Gaps [L],
// > 0 (not checked), and the resistances `slide` [M/T], `roll` [M L^2/T] and `slide_roll` [M L/T]
// are in the units of the fit, whose formula is also used below its gaps. A missing resistance, and
// a gap above those of the fit, are an Error(kBadInput). Used by rolling/roll_with_*.cpp. A change
// must keep the matrix of the resistances symmetric, and weights in the order of
// lubrication::all_terms().
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

void RollingFluid::check(double gap) const {
  if (gap > fit_.gap_interval[1])
    throw Error(ErrorKind::kBadInput,
                "the sphere rises above the gap {}, up to which the fit is known; tabulate and fit "
                "larger gaps",
                format_number(fit_.gap_interval[1]));
}

RollingResistance RollingFluid::at(double gap) const {
  check(gap);
  const auto sum = [gap](const auto& weights) { return lubrication::sum_values(weights, gap); };
  return {sum(slide_), sum(roll_), sum(slide_roll_)};
}

RollingResistance RollingFluid::slopes(double gap) const {
  check(gap);
  const auto sum = [gap](const auto& weights) { return lubrication::sum_log_slopes(weights, gap); };
  return {sum(slide_), sum(roll_), sum(slide_roll_)};
}

/// Forces [M L/T^2] or impulses [M L/T]; `compliance` > 0, the change of the slip per force or
/// impulse, and `bound` >= 0 are not checked.
Friction coulomb(double slip, double compliance, double bound) {
  const double sticking = -slip / compliance;
  if (std::abs(sticking) <= bound) return {sticking, SolidContact::kRolling};
  return {std::copysign(bound, sticking), SolidContact::kSliding};
}

}  // namespace viscontact::rolling
