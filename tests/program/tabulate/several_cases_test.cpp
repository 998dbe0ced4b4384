// Several cases in one command: here, in shares as a cluster's tasks compute them, and gathered.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

/// Two cases of six rows; the second fluid is twice as viscous.
class Sweep : public ::testing::Test {
 protected:
  Sweep() {
    put_text(path("thin.toml"), gentle_case_text());
    put_text(path("thick.toml"),
             replaced(gentle_case_text(), "viscosity = 3.0", "viscosity = 6.0"));
  }
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  ProgramResult tabulate(const std::string& output, const std::vector<std::string>& options = {},
                         const std::string& freefem = "") const {
    std::vector<std::string> arguments = {"tabulate", path("thin.toml"), path("thick.toml"), "-o",
                                          path(output)};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_viscontact(
        arguments, {"VISCONTACT_FREEFEM=" + (freefem.empty() ? fake_.executable() : freefem)});
  }

  TemporaryFolder scratch_;
  TemporaryFolder fake_folder_;
  freefem_axi::FakeFreeFem fake_{
      fake_folder_.path(),
      "[ -e \"$folder/fails\" ] && [ $viscosity = 3 ] && [ $gap = 1.5 ] && { echo no "
      "luck; exit 4; }\n"};
};

TEST_F(Sweep, TablesAreNamedAfterTheCasesAndThoseOfEachAlone) {
  expect_done(tabulate("out"));
  for (const std::string name : {"thin", "thick"}) {
    expect_done(run_viscontact({"tabulate", path(name + ".toml"), "-o", path(name + ".csv")},
                               {"VISCONTACT_FREEFEM=" + fake_.executable()}));
    EXPECT_EQ(without_seconds(path("out/" + name + ".csv")), without_seconds(path(name + ".csv")));
  }
  const auto answers = fake_.answered().size();
  EXPECT_THAT(tabulate("out").errors, AllOf(IsUpToDate("thin.csv"), IsUpToDate("thick.csv")));
  EXPECT_EQ(fake_.answered().size(), answers);
}

TEST_F(Sweep, FailingRowOfOneCaseDoesNotStopTheOther) {
  put_text(fake_folder_.path() / "fails", "");
  const auto failed = tabulate("out");
  expect_refusal(failed, ErrorKind::kExternalProgram, Names("1 of 2"));
  EXPECT_THAT(failed.errors, Names("thin.csv", "1 of 6", "gap 1.5, velocity -1", "no luck"));
  EXPECT_TRUE(std::filesystem::exists(path("out/thick.csv")));
  const auto dry = nlohmann::json::parse(tabulate("out", {"--dry-run", "--json"}).output);
  EXPECT_EQ(dry.at("outputs").at(0).at("finished"), 5);
  EXPECT_EQ(dry.at("outputs").at(0).at("failed"), 1);
  EXPECT_EQ(dry.at("outputs").at(1).at("failed"), 0);
  std::filesystem::remove(fake_folder_.path() / "fails");
  expect_done(tabulate("out"));
  EXPECT_THAT(fake_.answered(), SizeIs(12));
}

TEST_F(Sweep, SharesMakeUpTheWholeAndAreGatheredWithoutFreeFem) {
  expect_done(tabulate("undisturbed"));
  const auto answers = fake_.answered().size();
  for (const auto* share : {"0/5", "3/5", "4/5", "1/5"})
    expect_done(tabulate("out", {"--task", share}));
  EXPECT_FALSE(std::filesystem::exists(path("out/thin.csv")));
  // Missing: rows 2 and 7 of 0 to 11.
  const auto missing = tabulate("out", {"--gather"}, "no-such-freefem");
  expect_refusal(missing, ErrorKind::kNotConverged, Names("2 of 2"));
  EXPECT_THAT(missing.errors,
              AllOf(Names("thin.csv", "1 of 6", "thick.csv", "--launcher"), HasSubstr("gap 0.19"),
                    HasSubstr("gap 0.09"), Not(HasSubstr("failed"))));
  expect_done(tabulate("out", {"--task", "2/5"}));
  expect_done(tabulate("out", {"--task", "2/5"}));  // again: nothing to do
  EXPECT_EQ(fake_.answered().size(), answers + 12);
  expect_done(tabulate("out", {"--gather"}, "no-such-freefem"));
  for (const std::string name : {"thin.csv", "thick.csv"})
    EXPECT_EQ(without_seconds(path("out/" + name)), without_seconds(path("undisturbed/" + name)));
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(path("out")))
    left.push_back(entry.path().filename().string());
  EXPECT_THAT(left, UnorderedElementsAre("thin.csv", "thick.csv"));  // and no journal
}

TEST_F(Sweep, GatherTellsWhyARowFailedAndWritesTheTablesWithoutIt) {
  put_text(fake_folder_.path() / "fails", "");
  for (const auto* share : {"0/2", "1/2"}) (void)tabulate("out", {"--task", share});
  const auto failed = tabulate("out", {"--gather"});
  expect_refusal(failed, ErrorKind::kExternalProgram, Names("1 of 2"));
  EXPECT_THAT(failed.errors, Names("thin.csv", "1 of 6", "FreeFEM", "1.5", "no luck"));
  EXPECT_TRUE(std::filesystem::exists(path("out/thick.csv")));
  EXPECT_THAT(read_file(path("out/thin.csv")),
              AllOf(HasSubstr("# rows: 5\n"), HasSubstr("# failed row, gap 1.5, velocity -1: ")));
}

TEST_F(Sweep, GatherTellsThatAClustersNodesHaveNoFreeFem) {
  EXPECT_EQ(tabulate("out", {"--task", "0/1"}, "no-such-freefem").exit_status, 5);
  const auto failed = tabulate("out", {"--gather"});
  expect_refusal(failed, ErrorKind::kExternalProgram, Names("2 of 2"));
  EXPECT_THAT(failed.errors, Names("no-such-freefem"));
}

TEST_F(Sweep, RowsThatTasksFinishedAreTakenUpByARunHere) {
  expect_done(tabulate("out", {"--task", "0/2"}));
  expect_done(tabulate("out"));
  EXPECT_THAT(fake_.answered(), SizeIs(12));
}

TEST_F(Sweep, TaskThatStartsAfterTheTableIsThereDoesNothing) {
  expect_done(tabulate("out"));
  expect_done(tabulate("out", {"--task", "0/2"}));
  EXPECT_THAT(fake_.answered(), SizeIs(12));
  EXPECT_FALSE(std::filesystem::exists(path("out/thin.csv.rows")));
}

}  // namespace
}  // namespace viscontact
