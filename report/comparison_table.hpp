// A comparison as a table to read on a terminal.
#pragma once

#include <string>

#include "viscontact/reduced_model/comparison.hpp"

namespace viscontact {

/// One line per model: smallest gap and its time, film recovered from gamma, times of contact, largest distance to the
/// reference model.
std::string comparison_table(const Comparison& comparison);

}  // namespace viscontact
