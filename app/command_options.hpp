// What several commands do with their options.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/results/foreign_files.hpp"

namespace viscontact {

// Type names of options: by them --help, the manual and the shells' completion know what goes there. Words to choose from are "word|word".
inline constexpr const char* kFile = "FILE";
inline constexpr const char* kFolder = "DIR";
inline constexpr const char* kModel = "MODEL";
inline constexpr const char* kModels = "MODEL,...";

/// What is said of a folder into which another process writes (LockedFolder).
inline constexpr const char* kFolderIsHeld =
    "another viscontact writes into it; wait until it has ended, or write elsewhere";

/// "word|word" of the names in a table.
template <class Table>
std::string words_of(const Table& table) {
  std::string words;
  for (const auto& row : table) words += (words.empty() ? "" : "|") + std::string(row.name);
  return words;
}

/// Refuses what is none of the words; --help has them in the type name.
CLI::Validator one_of(std::vector<std::string> words);

/// The value of a call that reads a word of the command line, such as the name of a basis: the
/// Error(kBadInput) of a word that is not known becomes an Error(kWrongUsage) that names the option.
template <class Read>
auto from_option(std::string_view option, const Read& read) {
  try {
    return read();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kBadInput) throw;
    throw Error(ErrorKind::kWrongUsage, std::string(option) + ": " + error.what());
  }
}

/// Throws Error(kWrongUsage) that names the option for a name that is not a model's.
void check_models(std::string_view option, const std::vector<std::string>& names);

/// Throws Error(kWrongUsage) if an output has no name, or two have the same.
void check_outputs(const std::vector<std::string>& paths);

/// One FreeFEM process for each core.
int default_jobs();

/// The option -j, --jobs into `jobs`.
CLI::Option* add_jobs(CLI::App& command, int& jobs, const std::string& help);

/// The flag --json into `json`.
CLI::Option* add_json(CLI::App& command, bool& json);

}  // namespace viscontact
