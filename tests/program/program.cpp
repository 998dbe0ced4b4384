#include "tests/program/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {

ProgramResult run_viscontact(const std::vector<std::string>& arguments,
                             const std::vector<std::string>& environment,
                             const std::string& shell_before) {
  // The shell becomes the program, so that a signal that ends it is seen, and FreeFEM's parent is
  // viscontact.
  const TemporaryFolder scratch;
  const auto errors = scratch.path() / "errors";
  std::vector<std::string> command = {
      "/bin/sh", "-c", "exec 2>\"$1\"; shift; " + shell_before + " exec \"$0\" \"$@\"",
      VISCONTACT_EXECUTABLE, errors.string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const auto result = run_process(command, environment);
  return {result.exit_status, result.output, read_file(errors)};
}

void expect_done(const ProgramResult& result) { EXPECT_EQ(result.exit_status, 0) << result.errors; }

void expect_refusal(const ProgramResult& result, ErrorKind kind,
                    const ::testing::Matcher<std::string>& matcher) {
  EXPECT_EQ(result.exit_status, results::exit_code_of(kind)) << result.errors;
  std::istringstream stream(result.errors);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  const auto error = std::ranges::find_if(
      lines, [](const std::string& line) { return line.starts_with("viscontact: "); });
  ASSERT_NE(error, lines.end()) << result.errors;
  EXPECT_THAT(*error, matcher);
  EXPECT_LE(lines.end() - error, 2) << result.errors;
  for (auto line = lines.begin(); line != error; ++line)
    EXPECT_THAT(*line, ::testing::MatchesRegex(
                           "(tabulate|fit|simulate|compare|report|compare, report|particles|"
                           "rolling): .*"));
}

std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    files[entry.path().string()] = entry.is_regular_file() ? read_file(entry.path()) : "";
  return files;
}

}  // namespace viscontact
