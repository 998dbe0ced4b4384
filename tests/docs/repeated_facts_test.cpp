// What pages repeat of the program: its exit codes in docs/command-line.md, and its version in
// CITATION.cff.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>

#include "tests/common/regular_expressions.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;

const std::string kFolder = VISCONTACT_SOURCE_FOLDER;

TEST(CommandLine, ListsTheExitCodesOfTheProgram) {
  const auto page = read_file(kFolder + "/docs/command-line.md");
  for (const auto& [kind, code, meaning] : results::exit_codes())
    EXPECT_THAT(page, HasSubstr(fmt::format("\n| {} | {}", code, meaning)));
}

TEST(Citation, HasTheVersionOfTheProgram) {
  const auto version = matches_in(read_file(kFolder + "/CMakeLists.txt"),
                                  "project\\(viscontact VERSION ([0-9.]+)", 1);
  ASSERT_EQ(version.size(), 1U);
  EXPECT_THAT(read_file(kFolder + "/CITATION.cff"), HasSubstr("\nversion: " + version[0] + "\n"));
}

}  // namespace
}  // namespace viscontact
