// The stage compare: how far the trajectories of a folder are from that of the reference
// (docs/file-formats.md, "Comparison"). Numbers are in the units of the trajectories. The main job
// and the command `compare` call it. A change must keep the order of the models in the file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/reduced_model/comparison.hpp"

namespace viscontact::pipeline {

/// The CSV files of a folder that are named after models; none if the folder does not exist.
std::vector<std::filesystem::path> files_of_models(const std::filesystem::path& folder);

/// Prints a comparison to standard output, as a table or as JSON.
void print_comparison(const reduced_model::Comparison& comparison, bool json);

/// Compares the trajectories of a folder, and those in the files `others`, and writes the
/// comparison to `comparison_path`. `given` are the files of the user from which the same command
/// made the trajectories; it is empty if the user gave the trajectories themselves. If
/// `reference_model` is empty, the reference is the usual one, or the first model with a trajectory
/// if the usual one failed. The comparison is printed, as JSON if `json` is true.
/// Throws Error(kBadInput) if the folder or a trajectory is missing or wrong, and
/// Error(kInterrupted) if `stop` requests a stop; then nothing is written.
void compare_stage(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& others,
                   const std::string& reference_model, const std::filesystem::path& comparison_path,
                   const std::vector<std::filesystem::path>& given, bool json,
                   const StopToken& stop);

}  // namespace viscontact::pipeline
