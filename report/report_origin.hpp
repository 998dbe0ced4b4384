// The section of the report that says how the run's files were made: commands, inputs with their
// hashes, versions and times.
#pragma once

#include <string>

#include "viscontact/results/run_results.hpp"

namespace viscontact {

/// The section as HTML. Throws Error(kBadInput) if the provenance in a file is damaged.
std::string origin_section(const RunResults& run);

}  // namespace viscontact
