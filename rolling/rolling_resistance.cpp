// Sums of the terms of the fits, and the decision between rolling and sliding.
#include "viscontact/rolling/rolling_resistance.hpp"

#include <cassert>
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

Friction coulomb(double slip, double compliance, double bound) {
  assert(!(bound < 0));  // NaN comes from motions that leave the range of a double
  const double sticking = -slip / compliance;
  if (std::abs(sticking) <= bound) return {sticking, SolidContact::kRolling};
  return {std::copysign(bound, sticking), SolidContact::kSliding};
}

}  // namespace viscontact::rolling
