// README's commands do what README says. They run in the source folder, as a reader would run them; results go to out/.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/docs/document.hpp"
#include "viscontact/common/system/process.hpp"

namespace viscontact {
namespace {

using ::testing::AnyOf;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// README's fenced blocks in that language, in order.
std::vector<std::string> blocks_in(const std::string& language) {
  std::vector<std::string> texts;
  for (const auto& block : blocks_of(VISCONTACT_SOURCE_FOLDER "/README.md"))
    if (block.language == language) texts.push_back(block.text);
  return texts;
}

ProcessResult run_in_source_folder(const std::string& commands) {
  return run_process({"sh", "-ec", "cd '" VISCONTACT_SOURCE_FOLDER "'\n" + commands});
}

TEST(Readme, EveryCommandThatItShowsSucceedsInItsOrder) {
  const auto blocks = blocks_in("sh");
  ASSERT_THAT(blocks, Not(IsEmpty()));
  int tests_commands = 0;
  for (const auto& block : blocks) {
    if (block == "scripts/test\n") {
      ++tests_commands;  // this test is a part of it
      continue;
    }
    const auto result = run_in_source_folder(block);
    EXPECT_EQ(result.exit_status, 0) << block << result.output;
  }
  EXPECT_EQ(tests_commands, 1);
}

TEST(Readme, TheOutputThatItPromisesIsWhatTheMainJobPrints) {
  const auto promised = blocks_in("text");
  ASSERT_EQ(promised.size(), 1U);
  const auto result = run_in_source_folder("scripts/run");
  ASSERT_EQ(result.exit_status, 0) << result.output;
  std::istringstream lines(promised.front());
  int compared = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string model = line.substr(0, line.find(' '));
    std::istringstream printed(result.output);
    bool found = false;
    for (std::string other; std::getline(printed, other) && !found;) {
      if (!other.starts_with(model + " ")) continue;
      found = true;
      if (model == "model") continue;
      const auto expected = numbers_in(line.substr(30));
      const auto actual = numbers_in(other.substr(30));
      ASSERT_EQ(actual.size(), expected.size()) << other;
      // Another processor's arithmetic may move the mesh and so the table within its own accuracy, 1e-5; q_min answers to a relative change of
      // the drag with ln(q_min) = -6 times that. The rest is rounding in print.
      for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(actual[i], expected[i], 2e-3 * std::abs(expected[i])) << other;
      ++compared;
    }
    EXPECT_TRUE(found) << "no line for " << model << " in\n" << result.output;
  }
  EXPECT_EQ(compared, 6);
}

}  // namespace
}  // namespace viscontact
