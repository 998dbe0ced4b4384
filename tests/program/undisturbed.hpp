// A table to compare with: that of a run that nothing disturbed.
#pragma once

#include <filesystem>
#include <string>

namespace viscontact {

/// The text of a file apart from the line that says how it was made: what two makings have in
/// common.
std::string rest_of(const std::filesystem::path& file);

/// The rest_of a table file but for the column of seconds, which differ from run to run.
std::string without_seconds(const std::filesystem::path& table);

}  // namespace viscontact
