// Runs FreeFEM processes to their end and reads what they print. Times are whole seconds: by
// default at most 30 minutes for a row and 2 minutes for the version, or what the user's time limit
// says (1 to 10 million). Accuracies are relative, in (0, 1) (not checked). A FreeFEM that does not
// start and scripts that are not found are an Error(kExternalProgram), a wrong time limit of the
// user is an Error(kWrongUsage), and a requested stop is an Error(kInterrupted); a script that
// fails throws nothing. Used by tabulation.cpp, motion_row.cpp, tabulate.cpp, swimmer/tabulation/,
// pipeline/tabulate/, results/, app/ and bench/. A change must keep each process on one thread and
// within its time limit, and the words "viscontact-error" and "viscontact-version", which the
// scripts print.
#include "viscontact/freefem_axi/journal/freefem.hpp"

#include <fmt/format.h>

#include <sstream>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem/freefem_command.hpp"

namespace viscontact::freefem_axi {
namespace {

// Each row is solved on a sequence of kLevels meshes (the error estimate needs three), each twice
// as fine as the one before. The coarsest has kCoarsestCells cells across the gap; with fewer than
// two the gap would be a single layer of triangles. At most kAttempts sequences with other numbers
// of cells are solved until the accuracy is reached (extrapolation.idp). The first sequence reaches
// an accuracy of 1e-5 for gaps of 1e-6 to 10 radii in about a second (bench/README.md).
// Other numbers change the errors and times of all tables.
constexpr int kCoarsestCells = 2;
constexpr int kLevels = 3;
constexpr int kAttempts = 3;

/// The last four lines of a program's output that are not blank, joined to one line.
std::string last_lines(const std::string& output) {
  constexpr std::size_t kLines = 4;  // a free choice: the lines are only a part of a message
  std::vector<std::string> lines;
  std::istringstream stream(output);
  for (std::string line; std::getline(stream, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line);
  if (lines.size() > kLines) lines.erase(lines.begin(), lines.end() - kLines);
  return fmt::format("{}", fmt::join(lines, " | "));
}

}  // namespace

/// The FreeFEM of the user: the program, the folder of the scripts, and the time limits. That the
/// program exists is not checked.
FreeFem default_freefem(const StopToken& stop) {
  FreeFem freefem;
  freefem.stop = stop;
  freefem.executable = freefem::executable_of_user();
  if (const auto limit = freefem::time_limit_of_user())
    freefem.row_limit = freefem.version_limit = *limit;
  freefem.script_folder = freefem::find_script_folder("freefem_axi", "plane.edp");
  return freefem;
}

/// Runs a script of freefem.script_folder to its end, for at most `time_limit` (by default
/// freefem.row_limit). In `arguments` "-name" and "value" alternate. A script that fails or exceeds
/// its time limit throws nothing: the caller must look at `exit_status` and `timed_out` of the
/// result.
ProcessResult run_freefem(const FreeFem& freefem, std::string_view script,
                          const std::vector<std::string>& arguments,
                          std::optional<std::chrono::seconds> time_limit) {
  const auto command =
      freefem::make_command(freefem.executable, freefem.script_folder, script, arguments);
  auto result = run_process(command.arguments, command.environment, {}, command.folder,
                            time_limit.value_or(freefem.row_limit), freefem.stop);
  if (!result.started || result.exit_status == 127)
    throw Error(ErrorKind::kExternalProgram, "{} cannot be run ({}); {}", freefem.executable,
                result.output, freefem::kHowToInstall);
  return result;
}

/// Appends the arguments that say how fine the meshes are. `relative_accuracy` is the largest
/// relative error estimate of a force.
void append_mesh_arguments(std::vector<std::string>& arguments, double relative_accuracy) {
  arguments.insert(
      arguments.end(),
      {"-accuracy", format_number(relative_accuracy), "-cells", std::to_string(kCoarsestCells),
       "-levels", std::to_string(kLevels), "-attempts", std::to_string(kAttempts)});
}

/// Words for a process that was killed at its time limit.
std::string timed_out_in_words(std::chrono::seconds time_limit) {
  return fmt::format(
      "it had not ended after {} s and was stopped; too little memory can make FreeFEM hang "
      "(ulimit -v); on a slow machine set {} to more seconds",
      time_limit.count(), freefem::kTimeLimit);
}

/// Why a script failed: the time limit, or the text after "viscontact-error", or the last lines
/// that it printed; empty if it printed nothing.
std::string failure_in_words(const ProcessResult& result, std::chrono::seconds time_limit) {
  if (result.timed_out) return timed_out_in_words(time_limit);
  const std::string said = line_after(result.output, "viscontact-error");
  return said.empty() ? last_lines(result.output) : said;
}

/// The rest of the first line that begins with `prefix` and a blank; empty if there is no such
/// line.
std::string line_after(const std::string& output, std::string_view prefix) {
  std::istringstream lines(output);
  const std::string start = std::string(prefix) + " ";
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(start)) return line.substr(start.size());
  return {};
}

/// The version in words, such as "4.11+dfsg1-3 (Debian package freefem++; FreeFEM says 4.9)".
/// Throws Error(kExternalProgram) if FreeFEM fails or does not answer in time.
std::string freefem_version(const FreeFem& freefem) {
  const auto result = run_freefem(freefem, "version.edp", {}, freefem.version_limit);
  if (result.timed_out)
    throw Error(ErrorKind::kExternalProgram, "{} does not say which version it is: {}",
                freefem.executable, timed_out_in_words(freefem.version_limit));
  std::string version = line_after(result.output, "viscontact-version");
  if (result.exit_status != 0 || version.empty())
    throw Error(ErrorKind::kExternalProgram, "{} does not answer as FreeFEM does (exit status {})",
                freefem.executable, result.exit_status);
  const auto package = freefem::package_of(freefem.executable, freefem.stop);
  if (!package) return version;
  return fmt::format("{} (Debian package {}; FreeFEM says {})", package->version, package->name,
                     version);
}

}  // namespace viscontact::freefem_axi
