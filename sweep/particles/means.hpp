// Means and standard errors over the draws of a sweep of particles (docs/file-formats.md).
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/sweep/particles/particles_sweep.hpp"

namespace viscontact::sweep {

/// The table of means of a finished file of rows: for each point of the sweep its varied keys, the
/// number of draws that succeeded, the number of those that failed, and, for each column of
/// results, COLUMN.mean and COLUMN.standard_error over the draws that succeeded. The standard error
/// is the standard deviation (with n - 1) over the root of n; it is empty if n < 2. Throws
/// Error(kBadInput) if the file cannot be read or has other rows than the sweep.
std::string table_of_means(const ParticlesSweep& sweep, const std::filesystem::path& path);

/// The path of the table of means beside a file of rows: "rows.csv" gives "rows_means.csv".
std::filesystem::path path_of_means(const std::filesystem::path& rows);

}  // namespace viscontact::sweep
