// Writes the fit of a pair as one header, module or file, with a function for each entry. Lengths,
// masses and times are in the units of the fit. The command `export` calls it. A change must keep
// the names of the functions.
#pragma once

#include <string>
#include <string_view>

#include "viscontact/motions/pair_fit.hpp"

namespace viscontact::motions {

/// The text for one of export_targets(). The functions viscontact_squeeze, viscontact_slide,
/// viscontact_roll, viscontact_slide_roll and viscontact_spin (without the prefix in Python and
/// MATLAB) have the gap as argument; there is none for an entry that the fit lacks. Outside the
/// interval of gaps the code returns NaN (C, Fortran, MATLAB) or raises ValueError (Python).
/// `source` is the name of the fit's file, which the text states. Throws Error(kBadInput) for an
/// unknown target.
std::string export_pair(const PairFit& fit, std::string_view target, std::string_view source);

}  // namespace viscontact::motions
