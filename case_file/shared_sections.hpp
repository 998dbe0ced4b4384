// Sections that cases of one sphere and of a rolling one share (docs/case-file.md): [tabulation],
// and what both have in [sweep]. Lengths, masses and times are in the units of the case.
// case_file.cpp and rolling_case.cpp call it. A change must keep accepting users' cases.
#pragma once

#include <vector>

#include "viscontact/case_file/case_template.hpp"
#include "viscontact/case_file/keys.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::case_file {

/// Reads [tabulation] for a fluid of this viscosity [M/(L T)], > 0, and a sphere of this radius
/// [L], > 0. Throws Error(kBadInput) with file, line and key for a wrong value, and if the sphere
/// and its neighbour do not fit into the container at the largest gap.
freefem_axi::Tabulation read_tabulation(const TomlSection& section, double viscosity,
                                        double radius);

/// What docs/case-file.md says about the keys of [tabulation].
std::vector<KeyTable> tables_of_tabulation();

/// Declares the keys of [sweep] that choose points and what is drawn of them.
void points_and_plot_keys(Keys& keys, SweepRequest& sweep);

}  // namespace viscontact::case_file
