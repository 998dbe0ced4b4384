// Finds, reads and fits the tables of a pair (docs/motions.md), writes the fit and reports to the
// user.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/motions/fit/fit_pair.hpp"

namespace viscontact::motions {

/// The paths of the tables that `paths` names, each of which is a file or a folder with some of the
/// tables MOTION.csv of lubrication::all_motions(). Throws Error(kBadInput) for a folder with none
/// of these tables, and for a folder that lacks a table which, by the head of another table, was
/// computed together with it.
std::vector<std::filesystem::path> pair_table_files(const std::vector<std::string>& paths);

/// True if fit_pair_stage() must fit the tables, false if they are a single table of the approach,
/// which pipeline/ fits. It is true if one of `paths` is a folder, if there are several tables, or
/// if the only table is of another motion than the approach. `files` is the result of
/// pair_table_files(paths). Throws std::filesystem::filesystem_error for a path that the system
/// cannot look up.
bool are_of_pair(const std::vector<std::string>& paths,
                 const std::vector<std::filesystem::path>& files);

/// Reads the tables in `files`. Throws Error(kBadInput) if a table is wrong or two of them are of
/// the same motion.
PairTables read_pair_tables(const std::vector<std::filesystem::path>& files);

/// Fits the tables in `files`, at least one, and writes the fit (JSON, PairFit) to `fit_path`,
/// unless this file already contains it. Prints, for each resistance, the largest relative residual
/// [1] and the coefficient of its leading term beside that of theory. Throws the errors of
/// read_pair_tables() and fit_pair(), and Error(kBadInput) if the fit cannot be written.
void fit_pair_stage(const std::vector<std::filesystem::path>& files,
                    const std::filesystem::path& fit_path, const PairFitSettings& settings,
                    const StopToken& stop);

/// Fits the tables in `files`, at least one, with each basis of pair_bases(), and prints the
/// largest relative residual [1] of each resistance as a table. If `json`, it prints an object for
/// each basis with an object for each resistance, whose keys are largest_relative_residual,
/// condition_number and, if it is known, left_one_out, the largest relative residual of an inner
/// row that was left out. The basis in `settings` is not used. The first basis that cannot be
/// fitted ends the comparison with its error.
void compare_pair_bases_stage(const std::vector<std::filesystem::path>& files,
                              PairFitSettings settings, bool json, const StopToken& stop);

}  // namespace viscontact::motions
