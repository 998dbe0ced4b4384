// Texts of files without the parts that differ from run to run, to compare an interrupted run with
// one that was not interrupted.
#pragma once

#include <filesystem>
#include <string>

namespace viscontact {

/// The text of a file without the line with its provenance.
std::string rest_of(const std::filesystem::path& file);

/// rest_of() a table, without the column of computing times.
std::string without_seconds(const std::filesystem::path& table);

}  // namespace viscontact
