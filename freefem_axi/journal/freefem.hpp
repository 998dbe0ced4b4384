// Runs FreeFEM as a separate process, which gets a script and numbers and prints lines of text
// (docs/extending.md). Times are in seconds. Rows of all tables are computed by it. A change must
// keep each process on one thread and within its time limit.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact::freefem_axi {

/// The FreeFEM program, the folder of the scripts, and the conditions on which a process is killed.
struct FreeFem {
  std::string executable;  ///< a name to look for on PATH, or a path
  /// Folder share/viscontact/freefem_axi with the scripts.
  std::filesystem::path script_folder;
  /// Time limit for one row. The slowest row that was measured took less than two minutes.
  std::chrono::seconds row_limit = std::chrono::minutes(30);
  /// Time limit for FreeFEM to print its version, which takes it less than a second.
  std::chrono::seconds version_limit = std::chrono::minutes(2);
  /// If it requests a stop, FreeFEM is killed and Error(kInterrupted) is thrown.
  StopToken stop{};
};

/// The executable is that of the environment variable VISCONTACT_FREEFEM if it is set, else
/// FreeFem++-nw. The script folder is share/viscontact/freefem_axi in the folder of this program or
/// in the one above it. VISCONTACT_FREEFEM_TIME_LIMIT, if set, is the number of seconds of both
/// time limits. Throws Error(kExternalProgram) if there is no script folder, and Error(kWrongUsage)
/// if the limit is not a whole number from 1 to 10 million.
FreeFem default_freefem(const StopToken& stop = {});

/// Runs a script with arguments "-name value" on one thread. After `time_limit`, which is row_limit
/// unless given, FreeFEM is killed and `timed_out` is set in the result. If the script fails, this
/// is not an error here; the caller must look at the result. Throws Error(kExternalProgram) with a
/// remedy if FreeFEM cannot be started.
ProcessResult run_freefem(const FreeFem& freefem, std::string_view script,
                          const std::vector<std::string>& arguments,
                          std::optional<std::chrono::seconds> time_limit = {});

/// Appends the arguments of scripts/arguments.idp: the largest relative error estimate [1]
/// that is asked of each force, in (0, 1), and the numbers of cells of the meshes.
void append_mesh_arguments(std::vector<std::string>& arguments, double relative_accuracy);

/// The part of a message that says that FreeFEM was killed at its time limit, and the remedy.
std::string timed_out_in_words(std::chrono::seconds time_limit);

/// Why a script failed, for an error message: its time limit, the error that it printed, or the
/// last lines of its output.
std::string failure_in_words(const ProcessResult& result, std::chrono::seconds time_limit);

/// The rest of the first line of `output` that starts with `prefix` and a space; else empty.
std::string line_after(const std::string& output, std::string_view prefix);

/// The version of FreeFEM by which others can find the same program: "4.11+dfsg1-3 (Debian package
/// freefem++; FreeFEM says 4.9)". If no Debian package has installed the executable, it is the
/// version that FreeFEM states, "4.9", which is not always that of its release. Throws
/// Error(kExternalProgram) if FreeFEM does not run or does not answer within its time limit.
std::string freefem_version(const FreeFem& freefem);

}  // namespace viscontact::freefem_axi
