// FreeFEM or gnuplot missing or failing: exit code 5, what to do, and no half-made output.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/common/temporary_folder.hpp"
#include "tests/freefem_axi/fake_freefem.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

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
    expect_refusal(result, ErrorKind::kExternalProgram,
                   Names("no-such-freefem", "apt-get install freefem++"));
    EXPECT_EQ(files_below(scratch_.path()), before);
  }
}

// The main job from end to end: what a row that failed for good leaves, and what mends it.
TEST_F(ExternalPrograms, RunGoesOnWithoutARowThatFailedAndTriesItAgain) {
  const freefem_axi::FakeFreeFem fake(
      scratch_.path(),
      "[ $gap = 0.2 ] && [ ! -e \"$folder/mended\" ] && { echo tried >> \"$folder/tries\"; "
      "echo 'viscontact-error no solution'; exit 4; }\n");
  put_text(path("case.toml"),
           replaced(gentle_case_text(), "{ from = 0.05, to = 1.5, count = 6, spacing = \"log\" }",
                    "[0.05, 0.1, 0.2, 0.4, 0.8, 1.2, 1.5]"));
  const auto run = [&] {
    return run_viscontact({"run", path("case.toml"), "-o", path("out")},
                          {"VISCONTACT_FREEFEM=" + fake.executable()});
  };
  const auto first = run();
  expect_refusal(first, ErrorKind::kExternalProgram, Names("1 of 7"));
  EXPECT_THAT(first.errors, Names("1 of 7", "gap 0.2, velocity -1"));
  const auto diagnostics = nlohmann::json::parse(read_file(path("out/fit.json"))).at("diagnostics");
  EXPECT_EQ(diagnostics.at("rows"), 6);
  EXPECT_EQ(diagnostics.at("failed_rows"), 1);
  EXPECT_THAT(read_file(path("out/report.html")), HasSubstr("the table lacks 1 of 7 rows"));
  // The same command: the row is tried again, nothing else is made again, and the exit code stays.
  const auto before = files_below(path("out"));
  const auto second = run();
  expect_refusal(second, ErrorKind::kExternalProgram, Names("1 of 7"));
  EXPECT_THAT(second.errors, AllOf(IsUpToDate("fit.json"), IsUpToDate("trajectories")));
  EXPECT_EQ(files_below(path("out")), before);
  EXPECT_EQ(read_file(path("tries")), "tried\ntried\n");
  // With FreeFEM mended, it completes the table and makes all that depends on it again.
  put_text(path("mended"), "");
  expect_done(run());
  EXPECT_THAT(read_file(path("out/table.csv")),
              AllOf(HasSubstr("# rows: 7\n"), Not(HasSubstr("failed row"))));
  EXPECT_THAT(read_file(path("out/fit.json")), Not(HasSubstr("failed_rows")));
}

TEST_F(ExternalPrograms, TooFewRowsThatAreLeftAreSaidWithTheRowsThatFailed) {
  const freefem_axi::FakeFreeFem fake(
      scratch_.path(), "[ $gap = 1.5 ] || { echo 'viscontact-error no solution'; exit 4; }\n");
  put_text(path("case.toml"), gentle_case_text());
  const auto result = run_viscontact({"run", path("case.toml"), "-o", path("out")},
                                     {"VISCONTACT_FREEFEM=" + fake.executable()});
  expect_refusal(result, ErrorKind::kExternalProgram, Names("5 of 6"));
  EXPECT_THAT(result.errors, Names("1 different", "5"));
  EXPECT_FALSE(std::filesystem::exists(path("out/fit.json")));
}

TEST_F(ExternalPrograms, ManyRowsThatFailAreStillOneOrTwoLines) {
  const freefem_axi::FakeFreeFem fake(scratch_.path(),
                                      "echo 'viscontact-error no solution'; exit 4\n");
  put_text(path("case.toml"), gentle_case_text());
  const auto result = run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")},
                                     {"VISCONTACT_FREEFEM=" + fake.executable()});
  expect_refusal(result, ErrorKind::kExternalProgram, Names("6 of 6"));
}

TEST_F(ExternalPrograms, RowWithoutTheAskedAccuracyIsAWarningAndInTheTable) {
  const freefem_axi::FakeFreeFem fake(scratch_.path());  // its rows estimate their error as 1e-6
  put_text(path("case.toml"),
           replaced(gentle_case_text(), "relative_accuracy = 1e-3", "relative_accuracy = 1e-7"));
  const auto result = run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")},
                                     {"VISCONTACT_FREEFEM=" + fake.executable()});
  expect_done(result);
  EXPECT_THAT(result.errors, Names("1.5", "1e-06", "1e-07"));
  EXPECT_TRUE(std::filesystem::exists(path("table.csv")));
}

// Without the limit each of these would take an hour.
TEST_F(ExternalPrograms, FreeFemThatDoesNotSayItsVersionIsStopped) {
  put_text(path("freefem"), "#!/bin/sh\nexec sleep 3600\n");
  make_executable(path("freefem"));
  put_text(path("case.toml"), gentle_case_text());
  const std::vector<std::string> environment = {"VISCONTACT_FREEFEM=" + path("freefem"),
                                                "VISCONTACT_FREEFEM_TIME_LIMIT=1"};
  const auto said = Names(path("freefem"), "version");
  expect_refusal(
      run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")}, environment),
      ErrorKind::kExternalProgram, said);
  const auto doctor = run_viscontact({"doctor"}, environment);
  EXPECT_EQ(doctor.exit_status, results::exit_code_of(ErrorKind::kExternalProgram));
  EXPECT_THAT(doctor.output, said);
}

TEST_F(ExternalPrograms, RowAtWhichFreeFemHangsIsNamedAndTheOthersAreKept) {
  const freefem_axi::FakeFreeFem fake(scratch_.path(), "[ $gap = 1.5 ] && exec sleep 3600\n");
  put_text(path("case.toml"), gentle_case_text());
  // The other rows, which answer at once, have time even on a busy machine.
  const auto result = run_viscontact(
      {"tabulate", path("case.toml"), "-o", path("table.csv")},
      {"VISCONTACT_FREEFEM=" + fake.executable(), "VISCONTACT_FREEFEM_TIME_LIMIT=3"});
  expect_refusal(result, ErrorKind::kExternalProgram, Names("1 of 6"));
  EXPECT_THAT(result.errors, Names("1.5", "3", "VISCONTACT_FREEFEM_TIME_LIMIT"));
  EXPECT_THAT(read_file(path("table.csv")),
              AllOf(HasSubstr("# rows: 5\n"), HasSubstr("# failed row, gap 1.5, velocity -1: ")));
  EXPECT_FALSE(std::filesystem::exists(path("table.csv.rows")));
}

TEST_F(ExternalPrograms, FreeFemThatTooLittleMemoryMakesHangIsStopped) {
  // Under this limit FreeFEM 4.11 of Debian 12 says its version and hangs in the first row.
  const std::string six_gaps = "gaps = { from = 0.05, to = 1.5, count = 6, spacing = \"log\" }";
  put_text(path("case.toml"), replaced(gentle_case_text(), six_gaps, "gaps = [0.05]"));
  const auto result =
      run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv"), "--jobs", "1"},
                     {"VISCONTACT_FREEFEM_TIME_LIMIT=3"}, "ulimit -v 200000;");
  EXPECT_EQ(result.exit_status, results::exit_code_of(ErrorKind::kExternalProgram))
      << result.errors;
  EXPECT_THAT(result.errors, Names("0.05"));
}

TEST_F(ExternalPrograms, TimeLimitThatIsNoNumberOfSecondsIsWrongUsage) {
  put_text(path("case.toml"), gentle_case_text());
  for (const auto* limit : {"0", "-1", "soon", "1.5", "1e3", "99999999999"})
    expect_refusal(run_viscontact({"tabulate", path("case.toml"), "-o", path("table.csv")},
                                  {std::string("VISCONTACT_FREEFEM_TIME_LIMIT=") + limit}),
                   ErrorKind::kWrongUsage, Names("VISCONTACT_FREEFEM_TIME_LIMIT"));
}

TEST_F(ExternalPrograms, FailingGnuplotIsAnErrorWithWhatItSaidAndTheReportIsWritten) {
  const std::string run = simulated_folder();
  const auto result = run_viscontact(
      {"report", run}, {"PATH=" + folder_with_gnuplot("echo 'no svg terminal'; exit 1\n")});
  expect_refusal(result, ErrorKind::kExternalProgram, Names("gnuplot", "no svg terminal"));
  EXPECT_TRUE(std::filesystem::exists(run + "/report.html"));
  EXPECT_FALSE(std::filesystem::exists(run + "/plots"));
}

TEST_F(ExternalPrograms, GnuplotThatDiesBeforeItHasReadItsInputIsAnError) {
  const std::string run = simulated_folder();
  // The first plot is small. The next ones fill the pipe: writing to a reader that is gone must not
  // end viscontact (SIGPIPE).
  const std::string bin = folder_with_gnuplot(
      "[ -e \"$0.called\" ] && exit 1\n: > \"$0.called\"\necho '<svg></svg>'\n");
  const auto result = run_viscontact({"report", run}, {"PATH=" + bin});
  expect_refusal(result, ErrorKind::kExternalProgram, Names("gnuplot"));
  EXPECT_FALSE(std::filesystem::exists(run + "/plots"));
}

TEST_F(ExternalPrograms, MissingGnuplotLosesNoNumbers) {
  put_text(path("table.csv"), exact_table_text());
  const TemporaryFolder empty;
  const std::vector<std::string> environment = {"PATH=" + empty.path().string()};
  const auto bases = run_viscontact({"fit", path("table.csv"), "-o", path("fit.json"), "--basis",
                                     "asymptotic", "--compare-bases"},
                                    environment);
  EXPECT_EQ(bases.exit_status, results::exit_code_of(ErrorKind::kExternalProgram)) << bases.errors;
  EXPECT_THAT(bases.output, HasSubstr("asymptotic_extended"));
  EXPECT_TRUE(std::filesystem::exists(path("fit.json")));
  const auto shift = run_viscontact({"shift", path("table.csv"), "--fit", path("fit.json"), "-o",
                                     path("shift.csv"), "--plot", path("shift.svg")},
                                    environment);
  EXPECT_EQ(shift.exit_status, results::exit_code_of(ErrorKind::kExternalProgram)) << shift.errors;
  EXPECT_THAT(shift.output, HasSubstr("shift "));
  EXPECT_TRUE(std::filesystem::exists(path("shift.csv")));
}

}  // namespace
}  // namespace viscontact
