// FreeFEM as a program that is given a script and numbers, and answers with lines.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/process.hpp"

namespace viscontact {

/// Which FreeFEM, and where the scripts of this folder are.
struct FreeFem {
  std::string executable;  ///< name on PATH, or path
  std::filesystem::path script_folder;
};

/// The environment variable VISCONTACT_FREEFEM if set, else FreeFem++-nw; the scripts beside or
/// above this executable (share/viscontact/freefem_axi). Throws Error(kExternalProgram) if the
/// scripts are nowhere.
FreeFem default_freefem();

/// Runs a script with "-name value" arguments, on one thread.
/// Throws Error(kExternalProgram) with what to do if FreeFEM is not there; the script's own failure
/// is in the result.
ProcessResult run_freefem(const FreeFem& freefem, std::string_view script,
                          const std::vector<std::string>& arguments);

/// The rest of the first line of `output` that starts with `prefix` and a space; empty if there is
/// none.
std::string line_after(const std::string& output, std::string_view prefix);

/// The version that FreeFEM gives of itself. Throws Error(kExternalProgram) if it does not run.
std::string freefem_version(const FreeFem& freefem);

}  // namespace viscontact
