// The stages of the main job: fit, compare and report; tabulate and simulate are in
// tabulate_stage.hpp and simulate_stage.hpp. Each stage reads files, calls the part of the library
// that computes, and writes files with their provenance. If `json` is true, a stage prints its
// table as JSON.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact {

/// The case file and the files of sampled forces that its motion reads.
std::vector<std::filesystem::path> files_of_motion(const Case& c);

/// Fits the table in `table_path` and writes the fit to `fit_path`. If the file there differs in
/// its provenance only, it is left as it is. Throws as read_force_table and fit_force_table do.
void fit_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
               const FitSettings& settings, const Provenance& provenance);

/// Fits a table in every basis, prints the fits side by side and draws their residuals (SVG).
/// Throws Error(kBadInput) if no basis can be fitted, Error(kExternalProgram) if gnuplot fails.
void compare_bases_stage(const std::filesystem::path& table_path, const FitSettings& settings,
                         const std::filesystem::path& plot_path, bool json);

/// Fits how far below its crests a rough wall acts like a smooth wall (fitting/wall_shift.hpp),
/// from the rough wall's table and the smooth wall's fit. Prints the shift [L], writes the shift of
/// each row (CSV) and, unless `plot_path` is empty, a picture (SVG).
void shift_stage(const std::filesystem::path& table_path, const std::filesystem::path& fit_path,
                 const std::filesystem::path& shift_path, const std::filesystem::path& plot_path);

/// Compares the trajectories of a folder, and those in the files `others`, and writes the
/// comparison to `comparison_path`. `given` are the files of the user from which the same command
/// made the trajectories; it is empty if the user gave the trajectories themselves. If
/// `reference_model` is empty, the reference is `inertial`, or the first model with a trajectory if
/// `inertial` failed.
void compare_stage(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& others,
                   const std::string& reference_model, const std::filesystem::path& comparison_path,
                   const std::vector<std::filesystem::path>& given, bool json);

/// The main job: tabulate, fit, simulate, compare and report into a run's folder. A stage whose
/// inputs did not change is not run again. Errors of the case, and files that must not be replaced,
/// are found before the tabulation starts. If models failed, the error of the first is thrown after
/// everything else is written.
void run_stages(const Case& c, const std::filesystem::path& folder, int jobs, bool json);

}  // namespace viscontact
