// Compares trajectories: computes how far the motion that each model computed is from the motion of
// one of the models, the reference (docs/file-formats.md, "Comparison"). The gaps [L], >= 0,
// velocities [L/T] and times [T] are in the units of the trajectories. The commands `run`
// (run_stages.cpp) and `compare` call these functions. Error(kBadInput) is thrown if trajectories
// are missing or cannot be compared, Error(kInterrupted) at a stop. A change must keep the order of
// the models in the file of the comparison: first the order of reduced_model::all_models(), then
// the user's files by name.
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

/// Prints a comparison to standard output, as JSON if `json` is true, else as a table. The content
/// is that of reduced_model::Comparison: for each model its smallest gap [L], its times of contact
/// [T], and the largest value and the integrals of its distances from the reference. Nothing is
/// thrown.
void print_comparison(const reduced_model::Comparison& comparison, bool json);

/// Compares the trajectories of a folder and those in the files `others`, a list that may be empty.
/// Writes the comparison to `comparison_path` and prints it, as JSON if `json` is true, else as a
/// table. The trajectories of the folder are the CSV files except table.csv in its sub-folder
/// trajectories/ or, if there is none, in the folder itself. `given` are the files of the user from
/// which the same command made the trajectories; it is empty if the user gave the trajectories
/// themselves. If `reference_model` is empty, the reference is reduced_model::usual_reference() or,
/// if that model failed, the model of the first trajectory. Throws Error(kBadInput) if the folder
/// does not exist, if there is no trajectory, if one cannot be read or compared, if the reference
/// has none, or if the record failed_models.json of the folder is damaged, and Error(kInterrupted)
/// if `stop` requests a stop before a trajectory is read or compared; then nothing is written.
/// Throws Error(kBadInput) if the file cannot be written, and Error(kWrongUsage) if the environment
/// variable SOURCE_DATE_EPOCH is set and is not a time.
void compare_stage(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& others,
                   const std::string& reference_model, const std::filesystem::path& comparison_path,
                   const std::vector<std::filesystem::path>& given, bool json,
                   const StopToken& stop);

}  // namespace viscontact::pipeline
