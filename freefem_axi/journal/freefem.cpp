// FreeFEM processes: how they are started, and what they print.
#include "viscontact/freefem_axi/journal/freefem.hpp"

#include <fmt/format.h>

#include <sstream>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/freefem/freefem_command.hpp"

namespace viscontact::freefem_axi {
namespace {

/// Free choices of the meshes of a row (extrapolation.idp). Other numbers change the errors and
/// times of all tables.
struct MeshSequenceTuning {
  // Cells across the gap on the coarsest mesh; with fewer than two the gap would be a single layer
  // of triangles.
  static constexpr int kCoarsestCells = 2;
  // Meshes, each twice as fine as the one before; the error estimate needs three.
  static constexpr int kLevels = 3;
  // Sequences of meshes with other numbers of cells that are solved, at most, until the accuracy is
  // reached. The first reaches 1e-5 for gaps of 1e-6 to 10 radii in about a second
  // (bench/README.md).
  static constexpr int kAttempts = 3;
};

/// The last lines of a program's output that are not blank, joined to one line.
std::string last_lines(const std::string& output) {
  constexpr std::size_t kLines = 4;  // the lines are only a part of a message
  std::vector<std::string> lines;
  std::istringstream stream(output);
  for (std::string line; std::getline(stream, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line);
  if (lines.size() > kLines) lines.erase(lines.begin(), lines.end() - kLines);
  return fmt::format("{}", fmt::join(lines, " | "));
}

}  // namespace

FreeFem default_freefem(const StopToken& stop) {
  FreeFem freefem;
  freefem.stop = stop;
  freefem.executable = freefem::executable_of_user();
  if (const auto limit = freefem::time_limit_of_user())
    freefem.row_limit = freefem.version_limit = *limit;
  freefem.script_folder = freefem::find_script_folder("freefem_axi", "plane.edp");
  return freefem;
}

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

void append_mesh_arguments(std::vector<std::string>& arguments, double relative_accuracy) {
  arguments.insert(arguments.end(), {"-accuracy", format_number(relative_accuracy), "-cells",
                                     std::to_string(MeshSequenceTuning::kCoarsestCells), "-levels",
                                     std::to_string(MeshSequenceTuning::kLevels), "-attempts",
                                     std::to_string(MeshSequenceTuning::kAttempts)});
}

std::string timed_out_in_words(std::chrono::seconds time_limit) {
  return fmt::format(
      "it had not ended after {} s and was stopped; too little memory can make FreeFEM hang "
      "(ulimit -v); on a slow machine set {} to more seconds",
      time_limit.count(), freefem::kTimeLimit);
}

std::string failure_in_words(const ProcessResult& result, std::chrono::seconds time_limit) {
  if (result.timed_out) return timed_out_in_words(time_limit);
  const std::string said = line_after(result.output, "viscontact-error");
  return said.empty() ? last_lines(result.output) : said;
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
