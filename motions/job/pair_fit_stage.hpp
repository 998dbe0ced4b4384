// Reads the tables of force and torque on a sphere beside a body at rest, fits all its resistances,
// writes the fit and reports to the user (docs/motions.md). Lengths, masses and times are in the
// units of the tables. Used by the command `fit` (app/commands/), rolling/job/ and the Python
// module. Besides the errors below, functions that read or fit throw those of read_motion_table()
// and fit_pair(); if `stop` requests a stop, Error(kInterrupted). A change must keep that a fit
// that did not change is not written again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/motions/fit/fit_pair.hpp"

namespace viscontact::motions {

/// The tables that the paths name: files, or folders with some of approach.csv, slide.csv, roll.csv
/// and spin.csv. Throws Error(kBadInput) for a folder with none of these tables, and for a folder
/// that lacks a table which, by the head of another one, was asked for together with it.
std::vector<std::filesystem::path> pair_table_files(const std::vector<std::string>& paths);

/// True if the tables are to be fitted by fit_pair_stage() and not as a single table of the
/// approach: one of `paths` is a folder, there are several tables, or the only one is of another
/// motion than the approach. `files` is the result of pair_table_files(paths). Throws
/// std::filesystem::filesystem_error for a path that the system cannot look up.
bool are_of_pair(const std::vector<std::string>& paths,
                 const std::vector<std::filesystem::path>& files);

/// Reads the tables. Throws Error(kBadInput) if two of them are of the same motion.
PairTables read_pair_tables(const std::vector<std::filesystem::path>& files);

/// Fits the tables, writes the fit (JSON) to `fit_path`, and prints the residuals and the leading
/// coefficients beside those of theory. If `fit_path` already contains this fit, it is not written.
/// `files` has at least one element (not checked). Throws Error(kBadInput) if the fit cannot be
/// written.
void fit_pair_stage(const std::vector<std::filesystem::path>& files,
                    const std::filesystem::path& fit_path, const PairFitSettings& settings,
                    const StopToken& stop);

/// Fits the tables in each of pair_bases(), and prints the largest relative residual of each
/// resistance as a table, or, if `json`, as JSON with further diagnostics. The basis in `settings`
/// is not used. The first basis that cannot be fitted ends the comparison with its error.
void compare_pair_bases_stage(const std::vector<std::filesystem::path>& files,
                              PairFitSettings settings, bool json, const StopToken& stop);

}  // namespace viscontact::motions
