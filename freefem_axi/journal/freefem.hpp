// Runs a script of freefem_axi/scripts/ in a FreeFEM process, which gets numbers as arguments and
// prints lines of text (docs/extending.md).
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

/// FreeFEM, its scripts, and when a process is killed.
struct FreeFem {
  std::string executable;               ///< a name to look for on PATH, or a path
  std::filesystem::path script_folder;  ///< share/viscontact/freefem_axi
  /// Time limit for one row of a table [s], > 0. The slowest row that was measured took less than
  /// two minutes; the default leaves a factor of 15 for slower machines.
  std::chrono::seconds row_limit = std::chrono::minutes(30);
  /// Time limit for FreeFEM to print its version [s], > 0. FreeFEM prints it in less than a second.
  std::chrono::seconds version_limit = std::chrono::minutes(2);
  /// Kills the FreeFEM process, which throws Error(kInterrupted).
  StopToken stop{};
};

/// The FreeFEM of the user: the executable is the value of the environment variable
/// VISCONTACT_FREEFEM if it is set and not empty, else FreeFem++-nw; it need not exist.
/// VISCONTACT_FREEFEM_TIME_LIMIT [s], if set, replaces both time limits. Throws
/// Error(kExternalProgram) if the scripts are not found (freefem::find_script_folder()), and
/// Error(kWrongUsage) if the limit is not a whole number from 1 to 10 million.
FreeFem default_freefem(const StopToken& stop = {});

/// Runs the script with the file name `script` on one thread to its end. In `arguments`, "-name"
/// and "value" alternate. After `time_limit` (else freefem.row_limit) FreeFEM is killed. If the
/// script fails, no error is thrown: the caller must look at exit_status and timed_out. Throws
/// Error(kExternalProgram) if FreeFEM cannot be started, and Error(kInterrupted) at a stop.
ProcessResult run_freefem(const FreeFem& freefem, std::string_view script,
                          const std::vector<std::string>& arguments,
                          std::optional<std::chrono::seconds> time_limit = {});

/// Appends the arguments that all scripts need: -accuracy, the largest relative error estimate of a
/// force [1], in (0, 1), and -cells, -levels and -attempts, constants of freefem.cpp that say how
/// fine the meshes are.
void append_mesh_arguments(std::vector<std::string>& arguments, double relative_accuracy);

/// Words for a message: FreeFEM was killed at its time limit, and what the user can do.
std::string timed_out_in_words(std::chrono::seconds time_limit);

/// Why a script failed: that it exceeded `time_limit`, or the error that it printed after the word
/// "viscontact-error", or else the last lines of its output, which may be empty.
std::string failure_in_words(const ProcessResult& result, std::chrono::seconds time_limit);

/// The rest of the first line that starts with `prefix` and a space; empty if there is none.
std::string line_after(const std::string& output, std::string_view prefix);

/// The version of the Debian package that has installed the executable, and the version that
/// FreeFEM states, such as "4.11+dfsg1-3 (Debian package freefem++; FreeFEM says 4.9)"; only the
/// latter, "4.9", if no package has installed it. Throws Error(kInterrupted) at a stop, and
/// Error(kExternalProgram) if FreeFEM cannot be started, fails, or does not answer within
/// freefem.version_limit.
std::string freefem_version(const FreeFem& freefem);

}  // namespace viscontact::freefem_axi
