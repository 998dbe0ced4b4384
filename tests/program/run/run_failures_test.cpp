// `viscontact run`: what it refuses, what it never replaces, and what a failure leaves.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/run/run.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/reduced_model/comparison.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Run, NeverReplacesATableThatItDidNotWrite) {
  const auto table = folder() / "table.csv";
  fs::create_directories(folder());
  put_text(table, "# viscosity: 3\n# radius: 1\ngap,reference_velocity,force\n0.1,-1,900\n");
  const auto before = read_file(table);
  expect_refusal(run(), ErrorKind::kBadInput, Names(table.string()));
  EXPECT_EQ(read_file(table), before);
}

/// A push that all models but the two without drag near contact cannot follow in the table; those
/// two are left out.
std::string case_that_no_model_can_follow() {
  return replaced(replaced(gentle_case_text(), "value = -20.0", "value = -2000.0"),
                  "end_time = 4.0",
                  "end_time = 4.0\nmodels = [\"reference\", \"reference_exact\", \"inertial\"]");
}

TEST_F(Run, MotionThatLeavesTheTableIsAnErrorThatKeepsTableAndFit) {
  put_text(case_file(), case_that_no_model_can_follow());
  expect_refusal(run(), ErrorKind::kBadInput, Names("0.05"));
  EXPECT_TRUE(fs::exists(folder() / "table.csv"));
  EXPECT_TRUE(fs::exists(folder() / "fit.json"));
  EXPECT_FALSE(fs::exists(folder() / "trajectories"));
  EXPECT_FALSE(fs::exists(folder() / "report.html"));
}

TEST_F(Run, ThatFailsKeepsTheResultsOfTheOneBefore) {
  expect_done(run());
  const auto before = files_below(folder());
  const auto made = write_times(folder());
  put_text(case_file(), case_that_no_model_can_follow());
  expect_refusal(run(), ErrorKind::kBadInput, Names(case_file().string(), "reference"));
  EXPECT_EQ(files_below(folder()), before);
  EXPECT_EQ(write_times(folder()), made);
  put_text(case_file(), gentle_case_text());
  EXPECT_THAT(run().errors, IsUpToDate("report"));
}

TEST_F(Run, WrongParameterOfAModelIsFoundBeforeTheTabulation) {
  put_text(case_file(), replaced(gentle_case_text(), "threshold_gap = 0.1", "threshold_gap = 3.0"));
  expect_refusal(run(), ErrorKind::kBadInput,
                 Names(case_file().string(), "threshold_gap", "3", "motion.initial_gap"));
  EXPECT_TRUE(fake_.answered().empty());
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(Run, GapsThatTheModelsOrTheBasisCannotDoWithAreFoundBeforeTheTabulation) {
  const auto refused = [&](const std::string& text, const auto&... named) {
    put_text(case_file(), text);
    expect_refusal(run(), ErrorKind::kBadInput, Names(case_file().string(), named...));
  };
  const auto text = gentle_case_text();
  refused(replaced(text, "count = 6", "count = 4"), "tabulation.gaps");
  refused(replaced(text, "initial_gap = 1.0", "initial_gap = 2.0"), "motion.initial_gap");
  refused(replaced(text, "initial_gap = 1.0", "initial_gap = 0.01"), "motion.initial_gap");
  const auto of_model = [&](const std::string& model, const std::string& roughness) {
    return replaced(
        replaced(text, "end_time = 4.0", "end_time = 4.0\nmodels = [\"" + model + "\"]"),
        "roughness = [0.0, 0.0]", "roughness = " + roughness);
  };
  for (const std::string model : {"viscous_contact_regular_drag", "viscous_contact_threshold"})
    refused(replaced(of_model(model, "[0.0, 0.0]"), "initial_gap = 1.0", "initial_gap = 2.0"),
            "motion.initial_gap", "2", "tabulation.gaps", "1.5", model);
  refused(
      replaced(of_model("inertial_rough", "[0.4, 0.1]"), "initial_gap = 1.0", "initial_gap = 0.5"),
      "motion.initial_gap");
  EXPECT_TRUE(fake_.answered().empty());
}

TEST_F(Run, FolderIntoWhichAnotherWritesIsRefused) {
  expect_done(run());
  const auto made = write_times(folder());
  const LockedFolder lock(folder(), "");
  const auto refused = Names(folder().string());
  expect_refusal(run(), ErrorKind::kBadInput, refused);
  const auto name = folder().string();
  expect_refusal(run_viscontact({"report", name}), ErrorKind::kBadInput, refused);
  expect_refusal(run_viscontact({"compare", name}), ErrorKind::kBadInput, refused);
  expect_refusal(
      run_viscontact({"simulate", case_file().string(), "--fit", name + "/fit.json", "-o", name}),
      ErrorKind::kBadInput, refused);
  EXPECT_EQ(write_times(folder()), made);
}

TEST_F(Run, NeverReplacesWhatItDidNotWrite) {
  fs::create_directories(folder() / "trajectories");
  for (const auto* name : {"fit.json", "comparison.json", "report.html", "uncertainty.json",
                           "failed_models.json", "trajectories/inertial.csv"}) {
    put_text(folder() / name, "my notes\n");
    expect_refusal(run(), ErrorKind::kBadInput, Names(name));
    EXPECT_EQ(read_file(folder() / name), "my notes\n");
    fs::remove(folder() / name);
  }
  EXPECT_TRUE(fake_.answered().empty());
}

TEST_F(Run, ForeignTableThatIsNotNeededDoesNoHarm) {
  const auto table = folder() / "table.csv";
  fs::create_directories(folder());
  put_text(table, "my,own\ntable,here\n");
  put_text(case_file(), exact_case_text());
  expect_done(run());
  EXPECT_TRUE(fs::exists(folder() / "report.html"));
  EXPECT_EQ(read_file(table), "my,own\ntable,here\n");
}

TEST_F(Run, WithoutGnuplotEndsWithAReportAndTheNextRunDrawsThePictures) {
  const TemporaryFolder programs;  // all that a fake FreeFEM needs, and no gnuplot
  for (const auto* program : {"awk", "sh"})
    fs::create_symlink(std::string("/usr/bin/") + program, programs.path() / program);
  const auto without = [&] {
    return run_viscontact(
        {"run", case_file().string(), "-o", folder().string(), "--jobs", "1"},
        {"VISCONTACT_FREEFEM=" + fake_.executable(), "PATH=" + programs.path().string()});
  };
  for (int n = 0; n < 2; ++n) {
    const auto result = without();
    expect_done(result);
    EXPECT_THAT(result.errors, Names("gnuplot", "apt-get install gnuplot-nox"));
    EXPECT_TRUE(fs::exists(folder() / "report.html"));
    EXPECT_FALSE(fs::exists(folder() / "plots"));
  }
  const auto page = read_file(folder() / "report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("<figure data-plot=\"gap\">"), HasSubstr("no still pictures"),
                          Not(HasSubstr("plots/gap.svg"))));
  expect_done(run());
  EXPECT_TRUE(fs::exists(folder() / "plots/gap.svg"));
  EXPECT_THAT(read_file(folder() / "report.html"), Not(HasSubstr("no still pictures")));
  EXPECT_THAT(run().errors, IsUpToDate("report"));
  // Pictures of an earlier report do not stay beside one that has none.
  put_text(case_file(), replaced(gentle_case_text(), "value = -20.0", "value = -10.0"));
  expect_done(without());
  EXPECT_FALSE(fs::exists(folder() / "plots/gap.svg"));
}

TEST_F(Run, FailingGnuplotLeavesAReportWithoutPicturesAndTheNextRunMakesThem) {
  const TemporaryFolder programs;
  put_text(programs.path() / "gnuplot", "#!/bin/sh\nexit 1\n");
  make_executable(programs.path() / "gnuplot");
  const auto failed =
      run_viscontact({"run", case_file().string(), "-o", folder().string(), "--jobs", "1"},
                     {"VISCONTACT_FREEFEM=" + fake_.executable(),
                      "PATH=" + programs.path().string() + ":" + std::getenv("PATH")});
  expect_refusal(failed, ErrorKind::kExternalProgram, Names("gnuplot"));
  EXPECT_TRUE(fs::exists(folder() / "comparison.json"));
  EXPECT_TRUE(fs::exists(folder() / "report.html"));
  EXPECT_FALSE(fs::exists(folder() / "plots"));
  const auto again = run();
  expect_done(again);
  EXPECT_THAT(again.errors, IsUpToDate("trajectories"));
  EXPECT_TRUE(fs::exists(folder() / "report.html"));
  EXPECT_TRUE(fs::exists(folder() / "plots/gap.svg"));
}

}  // namespace
}  // namespace viscontact
