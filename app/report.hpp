// report.html: one self-contained page with what a run found.
#pragma once

#include <filesystem>

namespace viscontact {

/// Writes report.html into a run's folder from its case, fit, trajectories and comparison (and
/// table, if there is one). Throws Error(kBadInput) if one of those is missing or wrong,
/// Error(kExternalProgram) if gnuplot is.
void write_report(const std::filesystem::path& folder);

}  // namespace viscontact
