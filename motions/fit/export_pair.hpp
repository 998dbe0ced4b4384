// Writes the fit of a pair as code or data: a function of the gap for each resistance.
#pragma once

#include <string>
#include <string_view>

#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::motions {

/// The text for `target`: c-header, fortran, python, matlab, json or csv (export_targets() in
/// fitting/export/export_fit.hpp), in the units of the fit. For each resistance that the fit has,
/// code contains a function of the gap [L]: viscontact_squeeze [M/T], viscontact_slide [M/T],
/// viscontact_roll [M L^2/T], viscontact_slide_roll [M L/T] or viscontact_spin [M L^2/T]; names
/// have no prefix in Python and MATLAB. Programs of users call these names. Outside the interval of
/// gaps of the fit the function returns NaN (C, Fortran, MATLAB) or raises ValueError (Python). csv
/// has the columns gap, squeeze, slide, ... json has the keys about, formulas, interval, radius,
/// viscosity, functions (terms and largest residual of each resistance) and samples (the columns of
/// csv). csv and json have 201 gaps in geometric progression over the interval. `source` is the
/// name of the fit's file, which the text states; it may be empty. Throws Error(kBadInput) for an
/// unknown target.
std::string export_pair(const PairFit& fit, std::string_view target, std::string_view source);

}  // namespace viscontact::motions
