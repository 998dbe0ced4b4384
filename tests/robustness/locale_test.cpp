// A decimal comma: every number is written and read as without.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/robustness/whole_outputs.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

/// The pictures' lines but for the one that says when and how they were made.
std::string pictures_below(const fs::path& folder) {
  std::string text;
  for (const auto& [name, content] : files_below(folder)) {
    if (!name.ends_with(".svg")) continue;
    std::istringstream lines(content);
    for (std::string line; std::getline(lines, line);)
      if (line.find("provenance") == std::string::npos) text += line + "\n";
  }
  return text;
}

TEST(Locale, ADecimalCommaChangesNoNumberOfThePipelineWithFreeFem) {
  const TemporaryFolder scratch;
  // A locale of our own, so that nothing need be set up on the machine.
  const auto made = run_process(
      {"localedef", "-i", "fr_FR", "-f", "UTF-8", (scratch.path() / "fr_FR.UTF-8").string()});
  ASSERT_EQ(made.exit_status, 0) << made.output << " (package locales)";
  const std::vector<std::string> french = {"LOCPATH=" + scratch.path().string(),
                                           "LC_ALL=fr_FR.UTF-8", "LANG=fr_FR.UTF-8"};
  ASSERT_EQ(run_process({"/usr/bin/printf", "%.1f", "0,5"}, french).output, "0,5");

  put_text(scratch.path() / "case.toml", quick_case_text());
  const auto run = [&](const std::string& folder, const std::vector<std::string>& environment) {
    expect_done(run_viscontact({"run", (scratch.path() / "case.toml").string(), "-o",
                                (scratch.path() / folder).string(), "--jobs", "2"},
                               environment));
  };
  run("comma", french);
  run("point", {"LC_ALL=C"});
  expect_whole_files(scratch.path() / "comma");
  EXPECT_EQ(numbers_below(scratch.path() / "comma"), numbers_below(scratch.path() / "point"));
  EXPECT_EQ(pictures_below(scratch.path() / "comma"), pictures_below(scratch.path() / "point"));
}

}  // namespace
}  // namespace viscontact
