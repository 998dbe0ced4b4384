// The key `units` of all cases: the words for the units in which the case is written.
#pragma once

#include "viscontact/case_file/keys.hpp"
#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/text/units.hpp"

namespace viscontact::case_file {

/// Reads the key `units` of the root table, if it is there. Throws Error(kBadInput) with the line if
/// a word is missing, empty or longer than 20 bytes, or has a character that pages or gnuplot would
/// read as a command.
void read_units(const TomlSection& root, Units& units);

/// What docs/case-file.md says about it.
KeyTable table_of_units();

}  // namespace viscontact::case_file
