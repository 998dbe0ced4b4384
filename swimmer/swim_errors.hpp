// How exact the results of a stroke are, from fits that are changed by about their errors. Lengths,
// masses and times are in the units of the fit.
#pragma once

#include <vector>

#include "viscontact/swimmer/swim.hpp"

namespace viscontact::swimmer {

/// Estimates of the errors of SwimSums, >= 0.
struct SwimErrors {
  double displacement = 0;  ///< [L]
  double energy = 0;        ///< [M L^2/T^2]
};

/// The errors of the sums of a stroke: for each fit of lower degree the change of the sums, plus
/// twice the root mean square of their changes by the errors of the table
/// (fitting/fit_resistance.hpp makes both kinds of fits). For the optimal stroke, `multiplier` is
/// OptimalStroke::multiplier over the period, and the error of the energy is that of an optimum
/// that has the asked displacement in the changed fit; for any other stroke `multiplier` is 0.
SwimErrors swim_errors(const SwimSums& sums, const Stroke& stroke,
                       const std::vector<ResistanceFit>& lower_degrees,
                       const std::vector<ResistanceFit>& table_errors, double multiplier = 0);

}  // namespace viscontact::swimmer
