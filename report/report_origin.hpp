// How a run's files were made: commands, inputs with their hashes, versions, times; as HTML.
#pragma once

#include <string>

#include "viscontact/results/run_results.hpp"

namespace viscontact {

/// Throws Error(kBadInput) if the provenance in a file is damaged.
std::string origin_section(const RunResults& run);

}  // namespace viscontact
