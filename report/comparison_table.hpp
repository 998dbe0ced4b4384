// The comparison of models as a table for the terminal, in the units of the case.
#pragma once

#include <string>

#include "viscontact/reduced_model/comparison.hpp"

namespace viscontact {

/// One line per model: smallest gap and its time, recovered film, times of contact, largest
/// distance to the reference.
std::string comparison_table(const Comparison& comparison);

}  // namespace viscontact
