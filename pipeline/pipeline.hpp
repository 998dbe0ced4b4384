// The stages behind the commands, but for tabulate (tabulate_stage.hpp) and simulate (simulate_stage.hpp): each reads files, calls its part, and writes files.
// `json`: the table that a stage prints is printed as JSON.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact {

/// The case's file and those that its motion reads.
std::vector<std::filesystem::path> files_of_motion(const Case& c);

/// Fits a table file into `fit_path`; a file that would not change, but for its provenance, is left as it is.
void fit_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
               const FitSettings& settings, const Provenance& provenance);

/// Fits a table in every basis, prints them side by side and draws their residuals (SVG).
void compare_bases_stage(const std::filesystem::path& table_path, const FitSettings& settings,
                         const std::filesystem::path& plot_path, bool json);

/// Fits the shift of a rough wall's table against a smooth wall's fit (fitting/wall_shift.hpp), prints it, and writes each row's (CSV), and a
/// picture (SVG) unless `plot_path` is empty.
void shift_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
                 const std::filesystem::path& shift_path, const std::filesystem::path& plot_path);

/// Compares a folder's trajectories, and other files, into `comparison_path`. `given`: the user's files that the trajectories were made from by the same
/// command; empty if they are the user's own. An empty `reference_model` is `inertial`, or the first
/// model with a trajectory if `inertial` failed.
void compare_stage(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& others,
                   const std::string& reference_model, const std::filesystem::path& comparison_path,
                   const std::vector<std::filesystem::path>& given, bool json);

/// All of it: tabulate, fit, simulate, compare, report. Stages whose inputs did not change are not
/// run again.
void run_stages(const Case& c, const std::filesystem::path& folder, int jobs, bool json);

}  // namespace viscontact
