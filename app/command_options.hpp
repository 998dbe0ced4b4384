// What several commands do with their options.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace viscontact {

/// An output that is there already is replaced only if it is of the same kind: its text has the
/// marker. Throws Error(kBadInput) otherwise.
void refuse_other_kind(const std::string& path, std::string_view marker, std::string_view kind);

/// Throws Error(kWrongUsage) if an output has no name, or two have the same.
void check_outputs(const std::vector<std::string>& paths);

/// One FreeFEM process for each core.
int default_jobs();

/// The option -j, --jobs into `jobs`.
CLI::Option* add_jobs(CLI::App& command, int& jobs, const std::string& help);

}  // namespace viscontact
