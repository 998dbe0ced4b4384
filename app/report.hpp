// report.html: one self-contained page with what a run found.
#pragma once

#include <filesystem>
#include <vector>

namespace viscontact {

/// Writes report.html into a run's folder from its case, fit, trajectories and comparison (and
/// table, if there is one). Throws Error(kBadInput) if one of those is missing or wrong,
/// Error(kExternalProgram) if gnuplot is. `given`: the user's files from which the same command made the folder's; empty if the folder's are the user's.
void write_report(const std::filesystem::path& folder,
                  const std::vector<std::filesystem::path>& given = {});

/// True if the folder's report and its plots are there, made from what the report's inputs still are.
bool report_is_current(const std::filesystem::path& folder);

}  // namespace viscontact
