// Outputs that are whole, and outputs that are equal.
#pragma once

#include <filesystem>
#include <string>

namespace viscontact {

/// A case of three gaps, rough and short: the whole pipeline with FreeFEM takes seconds.
std::string quick_case_text();

/// Expects every file below a folder to be one that the program makes and can read to its end. A
/// journal may lack the end of its last line; a file that was being written beside its place
/// (NAME.viscontact-PID.tmp) may be anything.
void expect_whole_files(const std::filesystem::path& folder);

/// The numbers of all the outputs below a folder, file by file, but for those that are no two runs'
/// alike: times and hashes of files that hold them.
std::string numbers_below(const std::filesystem::path& folder);

/// The number of files NAME.viscontact-PID.tmp below a folder.
int unfinished_below(const std::filesystem::path& folder);

}  // namespace viscontact
