// FreeFEM as a program that is given a script and numbers, and answers with lines.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/system/process.hpp"

namespace viscontact {

/// Which FreeFEM, where the scripts of this folder are, and how long FreeFEM may take.
struct FreeFem {
  std::string executable;  ///< name on PATH, or path
  std::filesystem::path script_folder;
  /// The longest time for one row. The slowest row that was measured took less than two minutes.
  std::chrono::seconds row_limit = std::chrono::minutes(30);
  /// The longest time for the question which version it is; FreeFEM answers within a second.
  std::chrono::seconds version_limit = std::chrono::minutes(2);
};

/// The environment variable VISCONTACT_FREEFEM if set, else FreeFem++-nw; the scripts beside or
/// above this executable (share/viscontact/freefem_axi). VISCONTACT_FREEFEM_TIME_LIMIT, if set, is
/// both time limits in seconds. Throws Error(kExternalProgram) if the scripts are nowhere,
/// Error(kWrongUsage) if that limit is no whole number of seconds from 1 to 10 million.
FreeFem default_freefem();

/// Runs a script with "-name value" arguments, on one thread. Kills FreeFEM after `time_limit`,
/// which is the row's limit unless given.
/// Throws Error(kExternalProgram) with what to do if FreeFEM is not there; the script's own failure
/// is in the result, and so is `timed_out`.
ProcessResult run_freefem(const FreeFem& freefem, std::string_view script,
                          const std::vector<std::string>& arguments,
                          std::optional<std::chrono::seconds> time_limit = {});

/// What an error says of a FreeFEM that was killed at its time limit, and what can be done.
std::string timed_out_in_words(std::chrono::seconds time_limit);

/// The rest of the first line of `output` that starts with `prefix` and a space; empty if there is
/// none.
std::string line_after(const std::string& output, std::string_view prefix);

/// The version that FreeFEM gives of itself. Throws Error(kExternalProgram) if it does not run or
/// does not answer within its time limit.
std::string freefem_version(const FreeFem& freefem);

}  // namespace viscontact
