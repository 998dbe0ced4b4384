// The stage compare: how far the motions of the models are from the reference
// (docs/file-formats.md, "Comparison").
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/reduced_model/comparison.hpp"

namespace viscontact::pipeline {

/// The CSV files of a folder that are named after models, in no particular order; none if the
/// folder does not exist. Throws std::filesystem::filesystem_error if the folder cannot be listed.
std::vector<std::filesystem::path> files_of_models(const std::filesystem::path& folder);

/// Prints a comparison to standard output, as JSON if `json` is true, else as a table.
void print_comparison(const reduced_model::Comparison& comparison, bool json);

/// Compares the trajectories of a folder and those in the files `others`, writes the comparison to
/// `comparison_path` and prints it like print_comparison(). The trajectories of the folder are the
/// CSV files except table.csv in its sub-folder trajectories/ or, if there is none, in the folder
/// itself: first the models in the order of reduced_model::all_models(), then the user's files by
/// name. `given` are the files of the user from which the same command made the trajectories; it is
/// empty if the user gave the trajectories themselves. If `reference_model` is empty, the reference
/// is reduced_model::usual_reference() or, if that model failed, the model of the first trajectory.
/// Throws Error(kBadInput) if the folder does not exist, if there is no trajectory, if one cannot
/// be read or compared, if the reference has none, if the record failed_models.json of the folder
/// is damaged or if the file cannot be written, Error(kInterrupted) at a stop before anything is
/// written, and Error(kWrongUsage) if the environment variable SOURCE_DATE_EPOCH is not a time.
void compare_stage(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& others,
                   const std::string& reference_model, const std::filesystem::path& comparison_path,
                   const std::vector<std::filesystem::path>& given, bool json,
                   const StopToken& stop);

}  // namespace viscontact::pipeline
