// Reads the sections [stroke] and [optimal] of a swimmer's case.
#pragma once

#include "viscontact/case_file/swimmer/swimmer_case.hpp"

namespace viscontact::case_file {

/// Reads both sections, if the case has them, into `c`, whose spheres and gaps are known. Throws
/// Error(kBadInput) if a stroke leaves the table or is not closed.
void read_strokes(const TomlSection& root, SwimmerCase& c);

}  // namespace viscontact::case_file
