// The stage that fits all resistances of a pair to the tables of its motions (docs/motions.md).
// Lengths, masses and times are in the units of the tables. The command `fit` and the stages of a
// rolling sphere call it. Besides the errors below, stages throw those of read_motion_table() and
// fit_pair(). If `stop` requests a stop, a stage throws Error(kInterrupted).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/motions/fit/fit_pair.hpp"

namespace viscontact::motions {

/// The tables that the paths name: files, or folders with some of approach.csv, slide.csv, roll.csv
/// and spin.csv. Throws Error(kBadInput) for a folder without any of them, and for one in which a
/// table names a motion of its tabulation whose table is missing.
std::vector<std::filesystem::path> pair_table_files(const std::vector<std::string>& paths);

/// True if the tables, which pair_table_files() found at these paths, are to be fitted as those of
/// a pair: a path is a folder, there are several tables, or the only one is a motion table.
bool are_of_pair(const std::vector<std::string>& paths,
                 const std::vector<std::filesystem::path>& files);

/// Reads the tables. Throws Error(kBadInput) if two of them are of the same motion.
PairTables read_pair_tables(const std::vector<std::filesystem::path>& files);

/// Fits the tables and writes the fit (JSON). If the file differs in its provenance only, it is
/// left as it is. Prints the residuals, and the leading coefficients beside those of theory.
void fit_pair_stage(const std::vector<std::filesystem::path>& files,
                    const std::filesystem::path& fit_path, const PairFitSettings& settings,
                    const StopToken& stop);

/// Fits the tables in every basis, and prints the largest relative residual of each entry.
void compare_pair_bases_stage(const std::vector<std::filesystem::path>& files,
                              PairFitSettings settings, bool json, const StopToken& stop);

}  // namespace viscontact::motions
