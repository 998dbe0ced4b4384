// Writes the fit of a pair, the resistances of a sphere beside a body at rest (pair_fit.hpp), as
// code or data with a function of the gap for each resistance. Lengths, masses and times are in the
// units of the fit. An unknown target throws Error(kBadInput); the values of the fit are not
// checked. Used by the command `export` (app/commands/). A change must keep the names of functions
// and keys, which programs of users call.
#pragma once

#include <string>
#include <string_view>

#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::motions {

/// The text for `target`, one of export_targets() (fitting/export/export_fit.hpp). For each
/// resistance that the fit has, code contains a function of the gap [L]: viscontact_squeeze [M/T],
/// viscontact_slide [M/T], viscontact_roll [M L^2/T], viscontact_slide_roll [M L/T] and
/// viscontact_spin [M L^2/T], without the prefix in Python and MATLAB. Outside the interval of gaps
/// it returns NaN (C, Fortran, MATLAB) or raises ValueError (Python). json and csv contain 201
/// samples. `source` is the name of the fit's file, which the text states; it may be empty. Throws
/// Error(kBadInput) for an unknown target. That resistances are positive is not checked.
std::string export_pair(const PairFit& fit, std::string_view target, std::string_view source);

}  // namespace viscontact::motions
