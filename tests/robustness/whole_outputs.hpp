// Checks that the outputs below a folder are complete, and reads their numbers to compare two runs.
#pragma once

#include <filesystem>
#include <string>

namespace viscontact {

/// A case with two gaps of low accuracy and a short motion, with which the whole main job with
/// FreeFEM takes seconds.
std::string quick_case_text();

/// Expects that every file below a folder is a complete file of a kind that the program writes. A
/// journal may lack the end of its last line. Files NAME.viscontact-PID.tmp, into which the program
/// writes before it renames them, may have any content.
void expect_whole_files(const std::filesystem::path& folder);

/// The numbers of all outputs below a folder, file by file, without those that differ from run to
/// run: computing times, and hashes of files that contain such times.
std::string numbers_below(const std::filesystem::path& folder);

/// The number of files NAME.viscontact-PID.tmp below a folder.
int unfinished_below(const std::filesystem::path& folder);

}  // namespace viscontact
