// The section [tabulation] of a case of one sphere or of a rolling one (docs/case-file.md).
// Lengths, masses and times are in the units of the case.
#pragma once

#include <vector>

#include "viscontact/case_file/keys.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::case_file {

/// Reads [tabulation]. Throws Error(kBadInput) with file, line and key for a wrong value, and if
/// the sphere and its neighbour do not fit into the container at the largest gap.
freefem_axi::Tabulation read_tabulation(const TomlSection& section, double viscosity,
                                        double radius);

/// What docs/case-file.md says about its keys.
std::vector<KeyTable> tables_of_tabulation();

}  // namespace viscontact::case_file
