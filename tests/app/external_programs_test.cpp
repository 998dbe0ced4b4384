// FreeFEM or gnuplot missing or failing: exit code 5, what to do, and no half-made output.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/program.hpp"
#include "tests/app/sample_files.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ExternalPrograms : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  /// A run's folder that lacks only the report.
  std::string simulated_folder() const {
    put_text(path("case.toml"), lecture_case_text());
    put_text(path("table.csv"), exact_table_text());
    expect_done(run_viscontact(
        {"fit", path("table.csv"), "-o", path("fit.json"), "--basis", "asymptotic"}));
    expect_done(run_viscontact(
        {"simulate", path("case.toml"), "--fit", path("fit.json"), "-o", path("run")}));
    expect_done(run_viscontact({"compare", path("run")}));
    return path("run");
  }

  /// A folder with a program named gnuplot that does this.
  std::string folder_with_gnuplot(const std::string& script) const {
    const auto folder = scratch_.path() / "bin";
    std::filesystem::create_directory(folder);
    put_text(folder / "gnuplot", "#!/bin/sh\n" + script);
    make_executable(folder / "gnuplot");
    return folder.string();
  }

  TemporaryFolder scratch_;
};

TEST_F(ExternalPrograms, MissingFreeFemIsSaidWithWhatToDo) {
  put_text(path("case.toml"), lecture_case_text());
  const auto before = files_below(scratch_.path());
  for (const auto& arguments :
       {std::vector<std::string>{"tabulate", path("case.toml"), "-o", path("table.csv")},
        std::vector<std::string>{"run", path("case.toml"), "-o", path("out")}}) {
    const auto result = run_viscontact(arguments, {"VISCONTACT_FREEFEM=no-such-freefem"});
    expect_refusal(result, ExitCode::kExternalProgram,
                   AllOf(HasSubstr("no-such-freefem"), HasSubstr("apt-get install freefem++")));
    EXPECT_EQ(files_below(scratch_.path()), before);
  }
}

TEST_F(ExternalPrograms, RowThatFreeFemCannotSolveIsNamedAndTheOthersAreKept) {
  const FakeFreeFem fake(scratch_.path(),
                         "[ $gap = 1.5 ] && { echo 'viscontact-error no solution'; exit 4; }\n");
  put_text(path("case.toml"), gentle_case_text());
  const auto result = run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")},
                                     {"VISCONTACT_FREEFEM=" + fake.executable()});
  expect_refusal(result, ExitCode::kExternalProgram, HasSubstr("1 of 6 rows failed"));
  EXPECT_THAT(result.errors, AllOf(HasSubstr("gap 1.5"), HasSubstr("no solution")));
  EXPECT_FALSE(std::filesystem::exists(path("table.csv")));
  EXPECT_TRUE(std::filesystem::exists(path("table.csv.rows")));
}

TEST_F(ExternalPrograms, ManyRowsThatFailAreStillOneOrTwoLines) {
  const FakeFreeFem fake(scratch_.path(), "echo 'viscontact-error no solution'; exit 4\n");
  put_text(path("case.toml"), gentle_case_text());
  const auto result = run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")},
                                     {"VISCONTACT_FREEFEM=" + fake.executable()});
  expect_refusal(result, ExitCode::kExternalProgram, HasSubstr("6 of 6 rows failed"));
}

TEST_F(ExternalPrograms, RowWithoutTheAskedAccuracyIsAWarningAndInTheTable) {
  const FakeFreeFem fake(scratch_.path());  // its rows estimate their error as 1e-6
  put_text(path("case.toml"),
           replaced(gentle_case_text(), "relative_accuracy = 1e-3", "relative_accuracy = 1e-7"));
  const auto result = run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")},
                                     {"VISCONTACT_FREEFEM=" + fake.executable()});
  expect_done(result);
  EXPECT_THAT(result.errors, AllOf(HasSubstr("warning: gap 1.5"), HasSubstr("1e-06"),
                                   HasSubstr("1e-07 was asked")));
  EXPECT_TRUE(std::filesystem::exists(path("table.csv")));
}

TEST_F(ExternalPrograms, MissingGnuplotLeavesNoReport) {
  const std::string run = simulated_folder();
  const TemporaryFolder empty;
  const auto before = files_below(run);
  const auto result = run_viscontact({"report", run}, {"PATH=" + empty.path().string()});
  expect_refusal(result, ExitCode::kExternalProgram,
                 AllOf(HasSubstr("gnuplot"), HasSubstr("apt-get install gnuplot-nox")));
  EXPECT_EQ(files_below(run), before);
}

TEST_F(ExternalPrograms, FailingGnuplotIsAnErrorWithWhatItSaid) {
  const std::string run = simulated_folder();
  const auto before = files_below(run);
  const auto result = run_viscontact(
      {"report", run}, {"PATH=" + folder_with_gnuplot("echo 'no svg terminal'; exit 1\n")});
  expect_refusal(result, ExitCode::kExternalProgram,
                 AllOf(HasSubstr("gnuplot failed"), HasSubstr("no svg terminal")));
  EXPECT_EQ(files_below(run), before);
}

TEST_F(ExternalPrograms, GnuplotThatDiesBeforeItHasReadItsInputIsAnError) {
  const std::string run = simulated_folder();
  // The first plot is small. The next ones fill the pipe: writing to a reader that is gone must not end viscontact (SIGPIPE).
  const std::string bin = folder_with_gnuplot(
      "[ -e \"$0.called\" ] && exit 1\n: > \"$0.called\"\necho '<svg></svg>'\n");
  const auto result = run_viscontact({"report", run}, {"PATH=" + bin});
  expect_refusal(result, ExitCode::kExternalProgram, HasSubstr("gnuplot failed"));
  EXPECT_FALSE(std::filesystem::exists(run + "/report.html"));
}

}  // namespace
}  // namespace viscontact
