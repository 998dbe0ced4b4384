// The command line and the environment of FreeFEM processes. Times are in seconds.
#include "viscontact/freefem_axi/freefem.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <sstream>

#include "viscontact/common/error.hpp"

namespace viscontact::freefem_axi {
namespace {

// The packages of Debian 12 (FreeFEM 4.11) and 13 (4.15) look for their own files in folders that
// do not exist (/etc/freefem++.pref names them). Viscontact therefore names the folders in which
// Debian installs these files.
constexpr std::string_view kIncludeFolder = "/usr/include/freefem++/idp";
constexpr std::string_view kLoadFolder = "/usr/lib/freefem++";

constexpr const char* kTimeLimit = "VISCONTACT_FREEFEM_TIME_LIMIT";

/// The time limit that the user has set, or nothing.
std::optional<std::chrono::seconds> time_limit_of_user() {
  constexpr int kLongest = 10'000'000;  // four months
  const char* text = std::getenv(kTimeLimit);
  if (text == nullptr || *text == '\0') return {};
  const std::string_view word = text;
  int seconds = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), seconds);
  if (error != std::errc() || end != word.data() + word.size() || seconds < 1 || seconds > kLongest)
    throw Error(ErrorKind::kWrongUsage,
                fmt::format("{} is '{}'; it must be a whole number of seconds from 1 to {}",
                            kTimeLimit, word, kLongest));
  return std::chrono::seconds(seconds);
}

}  // namespace

FreeFem default_freefem(const StopToken& stop) {
  FreeFem freefem;
  freefem.stop = stop;
  const char* named = std::getenv("VISCONTACT_FREEFEM");
  freefem.executable = named != nullptr && *named != '\0' ? named : "FreeFem++-nw";
  if (const auto limit = time_limit_of_user()) freefem.row_limit = freefem.version_limit = *limit;
  const auto program_folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (const auto* up : {".", ".."}) {
    auto folder = (program_folder / up / "share/viscontact/freefem_axi").lexically_normal();
    if (!std::filesystem::exists(folder / "plane.edp")) continue;
    freefem.script_folder = folder;
    return freefem;
  }
  throw Error(ErrorKind::kExternalProgram,
              fmt::format("the FreeFEM scripts are not in share/viscontact/freefem_axi beside {}; "
                          "build or install again",
                          program_folder.string()));
}

ProcessResult run_freefem(const FreeFem& freefem, std::string_view script,
                          const std::vector<std::string>& arguments,
                          std::optional<std::chrono::seconds> time_limit) {
  const auto scripts = std::filesystem::absolute(freefem.script_folder);
  // A name with a slash is a path relative to the working folder of Viscontact. It is made
  // absolute, because FreeFEM runs in another folder.
  const bool is_path = freefem.executable.find('/') != std::string::npos;
  const std::string executable =
      is_path ? std::filesystem::absolute(freefem.executable).string() : freefem.executable;
  std::vector<std::string> command = {executable, "-nw", "-v", "0", (scripts / script).string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  // Several processes, one for each row, already use all cores, so that further threads in a
  // process would only slow down the others. The working folder is that of the scripts, because
  // FreeFEM looks for includes there first, and a user's folder may contain files with the same
  // names.
  auto result =
      run_process(command,
                  {fmt::format("FF_INCLUDEPATH={};{}", scripts.string(), kIncludeFolder),
                   fmt::format("FF_LOADPATH={}", kLoadFolder), "OMP_NUM_THREADS=1",
                   "OPENBLAS_NUM_THREADS=1", "LC_ALL=C"},
                  {}, scripts.string(), time_limit.value_or(freefem.row_limit), freefem.stop);
  if (!result.started || result.exit_status == 127)
    throw Error(ErrorKind::kExternalProgram,
                fmt::format("{} cannot be run ({}); install FreeFEM (apt-get install freefem++) or "
                            "set VISCONTACT_FREEFEM to it",
                            freefem.executable, result.output));
  return result;
}

std::string timed_out_in_words(std::chrono::seconds time_limit) {
  return fmt::format(
      "it had not ended after {} s and was stopped; too little memory can make FreeFEM hang "
      "(ulimit -v); on a slow machine set {} to more seconds",
      time_limit.count(), kTimeLimit);
}

std::string line_after(const std::string& output, std::string_view prefix) {
  std::istringstream lines(output);
  const std::string start = std::string(prefix) + " ";
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(start)) return line.substr(start.size());
  return {};
}

std::string freefem_version(const FreeFem& freefem) {
  const auto result = run_freefem(freefem, "version.edp", {}, freefem.version_limit);
  if (result.timed_out)
    throw Error(ErrorKind::kExternalProgram,
                fmt::format("{} does not say which version it is: {}", freefem.executable,
                            timed_out_in_words(freefem.version_limit)));
  std::string version = line_after(result.output, "viscontact-version");
  if (result.exit_status != 0 || version.empty())
    throw Error(ErrorKind::kExternalProgram,
                fmt::format("{} does not answer as FreeFEM does (exit status {})",
                            freefem.executable, result.exit_status));
  return version;
}

}  // namespace viscontact::freefem_axi
