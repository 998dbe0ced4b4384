// How a process of FreeFEM is started: program, scripts, arguments, environment and working folder.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::freefem {

/// Name of the environment variable with the time limit of a FreeFEM process [s].
inline constexpr const char* kTimeLimit = "VISCONTACT_FREEFEM_TIME_LIMIT";

/// The value of the environment variable VISCONTACT_FREEFEM if it is set and not empty, else
/// FreeFem++-nw: a name to look for on PATH, or a path, whether the program exists or not.
std::string executable_of_user();

/// The value of VISCONTACT_FREEFEM_TIME_LIMIT [s], or nothing if it is not set or empty. Throws
/// Error(kWrongUsage) if it is not a whole number from 1 to 10 million.
std::optional<std::chrono::seconds> time_limit_of_user();

/// The folder share/viscontact/PART that contains the file `script`, where PART is `part`, the name
/// of a source folder such as freefem_axi. The folder share/ is looked for beside the running
/// program (as in a build folder), then one folder above it (as after an installation). If this
/// code is in a shared library, such as the Python module, it is then looked for beside the library
/// and in all folders above it. Throws Error(kExternalProgram) if there is no such folder.
std::filesystem::path find_script_folder(std::string_view part, std::string_view script);

/// How a process of FreeFEM is started.
struct Command {
  std::vector<std::string> arguments;    ///< the program and its arguments
  std::vector<std::string> environment;  ///< "NAME=value" each, for this process only
  std::string folder;                    ///< working folder, an absolute path
};

/// The command that runs a script of `script_folder` without graphics and on one thread.
/// `executable` is a name to look for on PATH, or a path relative to the current folder.
/// `arguments` are passed to the script: "-name" and "value" alternate, each an element of its own.
/// Whether program and script exist shows when the process is started.
Command make_command(const std::string& executable, const std::filesystem::path& script_folder,
                     std::string_view script, const std::vector<std::string>& arguments);

/// A package of Debian.
struct Package {
  std::string name;     ///< "freefem++"
  std::string version;  ///< with the revision of Debian, such as "4.11+dfsg1-3"
};

/// The package that has installed an executable, which is a path or a name to look for on PATH. The
/// result is nothing if no package has installed it, if the system has no dpkg, or if dpkg takes
/// more than 10 s. Throws Error(kInterrupted) if `stop` requests a stop.
std::optional<Package> package_of(const std::string& executable, const StopToken& stop = {});

/// The end of an error message, which says what to do if FreeFEM cannot be run.
inline constexpr std::string_view kHowToInstall =
    "install FreeFEM (apt-get install freefem++) or set VISCONTACT_FREEFEM to it";

}  // namespace viscontact::freefem
