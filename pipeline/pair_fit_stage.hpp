// The stage that fits all resistances of a pair to the tables of its motions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/fit_pair.hpp"

namespace viscontact::pipeline {

/// The tables that the paths name: files, or folders with approach.csv, slide.csv, roll.csv and
/// spin.csv, of which some may be missing.
std::vector<std::filesystem::path> pair_table_files(const std::vector<std::string>& paths);

/// True if the tables are to be fitted as those of a pair: there are several of them, or the only
/// one is a motion table.
bool are_of_pair(const std::vector<std::filesystem::path>& files);

/// Reads the tables. Throws Error(kBadInput) if two of them are of the same motion.
fitting::PairTables read_pair_tables(const std::vector<std::filesystem::path>& files);

/// Fits the tables and writes the fit (JSON). If the file differs in its provenance only, it is
/// left as it is. Prints the residuals, and the leading coefficients beside those of theory.
void fit_pair_stage(const std::vector<std::filesystem::path>& files,
                    const std::filesystem::path& fit_path, const fitting::PairFitSettings& settings,
                    const StopToken& stop);

/// Fits the tables in every basis, and prints the largest relative residual of each entry.
void compare_pair_bases_stage(const std::vector<std::filesystem::path>& files,
                              fitting::PairFitSettings settings, bool json, const StopToken& stop);

}  // namespace viscontact::pipeline
