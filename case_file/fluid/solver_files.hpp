// The files that the command of a user's own fluid solver names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viscontact::case_file {

/// The command with an absolute path in place of each word that names an existing file relative to
/// `folder`, that of the case file. A first word without a slash stays, because it is the name of a
/// program on PATH.
std::vector<std::string> with_absolute_files(std::vector<std::string> command,
                                             const std::filesystem::path& folder);

}  // namespace viscontact::case_file
