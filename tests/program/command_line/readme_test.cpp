// README's commands do what README says. They run in the source folder, as a reader would run them;
// results go to out/.
#include <gmock/gmock.h>

#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/docs/document.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/freefem_axi/journal/row_journal.hpp"
#include "viscontact/freefem_axi/journal/row_record.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
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

/// Leaves in out/ what an interrupted tabulation of the lecture's case leaves: a journal, here with
/// all but two rows of the main job's table. README says that the same command continues there;
/// to compute all rows once more would take minutes.
void interrupt_tabulation() {
  const fs::path out = fs::path(VISCONTACT_SOURCE_FOLDER) / "out";
  const auto lecture =
      case_file::read_case(fs::path(VISCONTACT_SOURCE_FOLDER) / "data/cases/lecture.toml");
  const auto plan = freefem_axi::force_table_plan(*lecture.tabulation);
  const auto rows = plan.read(out / "lecture/table.csv").finished;
  ASSERT_GT(rows.size(), 2U) << "scripts/run has made no table of its case";
  fs::remove(out / "table.csv");
  fs::remove(freefem_axi::journal_path(out / "table.csv"));
  freefem_axi::RowJournal journal(freefem_axi::journal_path(out / "table.csv"), plan.hash);
  for (auto row = rows.begin(); row != std::prev(rows.end(), 2); ++row) journal.append(row->second);
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
    if (block.find("viscontact tabulate data/cases/lecture.toml -o out/table.csv") != block.npos)
      interrupt_tabulation();
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
      // Another processor's arithmetic may move the mesh and so the table within its accuracy,
      // 1e-5. A relative change of the drag changes q_min by ln(q_min) = -6 times as much. The rest
      // is rounding in print.
      for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(actual[i], expected[i], 2e-3 * std::abs(expected[i])) << other;
      ++compared;
    }
    EXPECT_TRUE(found) << "no line for " << model << " in\n" << result.output;
  }
  EXPECT_EQ(compared, 7);  // six models, and the largest Stokes number
}

}  // namespace
}  // namespace viscontact
