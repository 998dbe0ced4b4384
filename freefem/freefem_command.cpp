// The command line and the environment of FreeFEM, its scripts, and its Debian package.
#include "viscontact/freefem/freefem_command.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cassert>
#include <charconv>
#include <cstdlib>
#include <sstream>
#include <system_error>

#include "viscontact/common/error.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact::freefem {
namespace {

// FreeFEM of Debian 12 (4.11) and 13 (4.15) looks for its own files in folders that do not exist
// (/etc/freefem++.pref names them). These are the folders in which Debian installs the files.
constexpr std::string_view kIncludeFolder = "/usr/include/freefem++/idp";
constexpr std::string_view kLoadFolder = "/usr/lib/freefem++";

/// The path of the file of a program, with symbolic links resolved. `name` is a path, or a name to
/// look for on PATH.
std::optional<std::filesystem::path> path_of_program(const std::string& name) {
  std::vector<std::filesystem::path> candidates = {name};
  if (name.find('/') == std::string::npos) {
    candidates.clear();
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
      candidates.push_back(std::filesystem::path(folder) / name);
  }
  for (const auto& candidate : candidates) {
    std::error_code none;
    if (std::filesystem::is_regular_file(candidate, none))
      return std::filesystem::canonical(candidate, none);
  }
  return {};
}

/// A pattern for dpkg-query that only `path` matches: its wildcards are escaped.
std::string pattern_of(const std::string& path) {
  std::string pattern;
  for (const char c : path) {
    if (std::string_view("*?[\\").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

/// The package that owns `path` according to `answer`, the output of dpkg-query --search; empty if
/// it names none. A line of the output is "PACKAGE: PATH", "PACKAGE:ARCHITECTURE: PATH", "PACKAGE,
/// PACKAGE: PATH" if several packages own the file, or "diversion by PACKAGE from: PATH" if PACKAGE
/// has replaced the file of another package.
std::string owner_in(const std::string& answer, const std::string& path) {
  constexpr std::string_view kDiversion = "diversion by ", kFrom = " from";
  const std::string end = ": " + path;
  std::string owner;
  std::istringstream lines(answer);
  for (std::string line; std::getline(lines, line);) {
    if (!line.ends_with(end)) continue;
    const auto names = line.substr(0, line.size() - end.size());
    if (names.starts_with(kDiversion) && names.ends_with(kFrom))
      return names.substr(kDiversion.size(), names.size() - kDiversion.size() - kFrom.size());
    // The other lines of a diversion have several words before the colon; they are skipped.
    const auto first = names.substr(0, names.find(", "));
    if (owner.empty() && first.find(' ') == std::string::npos) owner = first;
  }
  return owner;
}

}  // namespace

std::string executable_of_user() {
  const char* named = std::getenv("VISCONTACT_FREEFEM");
  return named != nullptr && *named != '\0' ? named : "FreeFem++-nw";
}

std::optional<std::chrono::seconds> time_limit_of_user() {
  // Four months; the check finds typing errors, and any longer time works too.
  constexpr int kLongest = 10'000'000;
  const char* text = std::getenv(kTimeLimit);
  if (text == nullptr || *text == '\0') return {};
  const std::string_view word = text;
  int seconds = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), seconds);
  if (error != std::errc() || end != word.data() + word.size() || seconds < 1 || seconds > kLongest)
    throw Error(ErrorKind::kWrongUsage,
                "{} is '{}'; it must be a whole number of seconds from 1 to {}", kTimeLimit, word,
                kLongest);
  return std::chrono::seconds(seconds);
}

std::optional<Package> package_of(const std::string& executable, const StopToken& stop) {
  // dpkg answers within a second. If it takes longer than this limit, the system counts as one
  // without dpkg.
  constexpr std::chrono::seconds kLongest(10);
  const auto file = path_of_program(executable);
  if (!file) return {};
  const auto ask = [&](const std::vector<std::string>& arguments) {
    const auto result = run_process(arguments, {"LC_ALL=C"}, {}, {}, kLongest, stop);
    return result.started && result.exit_status == 0 ? result.output : std::string();
  };
  const auto answer = ask({"dpkg-query", "--search", pattern_of(file->string())});
  Package package{owner_in(answer, file->string()), {}};
  if (package.name.empty()) return {};
  package.version = ask({"dpkg-query", "--show", "--showformat=${Version}", package.name});
  if (package.version.empty()) return {};
  return package;
}

std::filesystem::path find_script_folder(std::string_view part, std::string_view script) {
  assert(!part.empty() && !script.empty());
  namespace fs = std::filesystem;
  const auto program_folder = fs::read_symlink("/proc/self/exe").parent_path();
  std::vector<fs::path> beside = {program_folder, program_folder.parent_path()};
  // dladdr() gives the file that contains this code: the shared library, or the program. The name
  // of a program is not used, because it is as the user typed it and may lack the folder.
  if (Dl_info info; dladdr(reinterpret_cast<const void*>(&find_script_folder), &info) != 0 &&
                    fs::path(info.dli_fname).filename().string().find(".so") != std::string::npos)
    for (auto folder = fs::canonical(info.dli_fname).parent_path();;
         folder = folder.parent_path()) {
      beside.push_back(folder);
      if (folder == folder.root_path()) break;
    }
  for (const auto& one : beside) {
    auto folder = (one / "share/viscontact" / part).lexically_normal();
    if (fs::exists(folder / script)) return folder;
  }
  throw Error(
      ErrorKind::kExternalProgram,
      "the FreeFEM scripts are not in share/viscontact/{} beside {}; build or install again", part,
      program_folder.string());
}

Command make_command(const std::string& executable, const std::filesystem::path& script_folder,
                     std::string_view script, const std::vector<std::string>& arguments) {
  assert(!executable.empty() && !script.empty());
  const auto scripts = std::filesystem::absolute(script_folder);
  // A name with a slash is a path relative to the working folder of Viscontact. It is made
  // absolute, because FreeFEM runs in another folder.
  const bool is_path = executable.find('/') != std::string::npos;
  Command command;
  command.arguments = {is_path ? std::filesystem::absolute(executable).string() : executable, "-nw",
                       "-v", "0", (scripts / script).string()};
  command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
  // Several processes, one for each row or case, already use all cores, so that further threads in
  // a process would only slow down the others.
  command.environment = {fmt::format("FF_INCLUDEPATH={};{}", scripts.string(), kIncludeFolder),
                         fmt::format("FF_LOADPATH={}", kLoadFolder), "OMP_NUM_THREADS=1",
                         "OPENBLAS_NUM_THREADS=1", "LC_ALL=C"};
  // The working folder is that of the scripts, because FreeFEM looks for includes there first, and
  // a user's folder may contain files with the same names.
  command.folder = scripts.string();
  return command;
}

}  // namespace viscontact::freefem
