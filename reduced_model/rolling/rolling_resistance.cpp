// Sums the terms of the fit.
#include "viscontact/reduced_model/rolling/rolling_resistance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::reduced_model {
namespace {

using lubrication::PairEntry;

template <bool slope>
double sum_of_entry(const lubrication::PairFit& fit, PairEntry entry, double gap, double log_gap) {
  double sum = 0;
  for (const auto& term : fit.entries.at(entry).fit.terms) {
    const auto known = *lubrication::find_term(term.name);
    sum += term.coefficient *
           (slope ? known.log_slope.at(gap, log_gap) : known.value.at(gap, log_gap));
  }
  return sum;
}

}  // namespace

RollingFluid::RollingFluid(const lubrication::PairFit& fit) : fit_(fit) {
  for (const auto entry :
       {PairEntry::kSqueeze, PairEntry::kSlide, PairEntry::kRoll, PairEntry::kSlideRoll})
    if (!fit.entries.contains(entry))
      throw Error(
          ErrorKind::kBadInput,
          fmt::format("the fit lacks the entry {}; it must be made from tables of approach, "
                      "slide and roll",
                      lubrication::pair_entries()[static_cast<std::size_t>(entry)].name));
}

template <bool slope>
RollingResistance RollingFluid::sum(double gap) const {
  if (gap > fit_.gap_interval[1])
    throw Error(ErrorKind::kBadInput,
                fmt::format("the sphere rises above the gap {}, up to which the fit is known; "
                            "tabulate and fit larger gaps",
                            format_number(fit_.gap_interval[1])));
  const double log_gap = std::log(gap);
  return {sum_of_entry<slope>(fit_, PairEntry::kSlide, gap, log_gap),
          sum_of_entry<slope>(fit_, PairEntry::kRoll, gap, log_gap),
          sum_of_entry<slope>(fit_, PairEntry::kSlideRoll, gap, log_gap)};
}

RollingResistance RollingFluid::at(double gap) const { return sum<false>(gap); }

RollingResistance RollingFluid::slopes(double gap) const { return sum<true>(gap); }

Friction coulomb(double slip, double compliance, double bound) {
  const double sticking = -slip / compliance;
  if (std::abs(sticking) <= bound) return {sticking, SolidContact::kRolling};
  return {std::copysign(bound, sticking), SolidContact::kSliding};
}

}  // namespace viscontact::reduced_model
