// Long motions: fewer rows in the files, and progress on a terminal.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;

const std::string kFit = VISCONTACT_SOURCE_FOLDER "/data/fits/lecture.json";

TEST(OutputRows, AreAboutAsManyAsTheCaseSaysAndLoseNoSmallestGap) {
  const TemporaryFolder scratch;
  const auto simulate = [&](const std::string& name, const std::string& rows) {
    const auto case_file = (scratch.path() / (name + ".toml")).string();
    const auto folder = (scratch.path() / name).string();
    put_text(case_file, replaced(lecture_case_text(), "end_time = 4.0", "end_time = 4.0" + rows));
    expect_done(run_viscontact({"simulate", case_file, "--fit", kFit, "-o", folder}));
    expect_done(run_viscontact({"compare", folder}));
    return std::filesystem::path(folder);
  };
  const auto whole = simulate("whole", ""), fewer = simulate("fewer", "\nrows = 40");
  const auto comparison = reduced_model::read_comparison(whole / "comparison.json");
  const auto of_fewer = reduced_model::read_comparison(fewer / "comparison.json");
  for (std::size_t i = 0; i < comparison.models.size(); ++i) {
    const auto& model = comparison.models[i];
    const auto trajectory =
        reduced_model::read_trajectory(fewer / "trajectories" / (model.model + ".csv"));
    EXPECT_GE(trajectory.rows.size(), 40U) << model.model;
    EXPECT_LT(trajectory.rows.size(), 55U) << model.model;
    EXPECT_EQ(trajectory.provenance.at("rows_computed"),
              std::to_string(
                  reduced_model::read_trajectory(whole / "trajectories" / (model.model + ".csv"))
                      .rows.size()));
    EXPECT_EQ(of_fewer.models[i].minimal_gap, model.minimal_gap) << model.model;
    EXPECT_EQ(of_fewer.models[i].minimal_gap_time, model.minimal_gap_time) << model.model;
    EXPECT_EQ(of_fewer.models[i].film_from_gamma, model.film_from_gamma) << model.model;
    EXPECT_EQ(of_fewer.models[i].contact_interval, model.contact_interval) << model.model;
  }
}

TEST(OutputRows, BelowTwoAreRefused) {
  const TemporaryFolder scratch;
  const auto case_file = (scratch.path() / "case.toml").string();
  put_text(case_file, replaced(lecture_case_text(), "end_time = 4.0", "end_time = 4.0\nrows = 1"));
  expect_refusal(run_viscontact({"simulate", case_file, "--fit", kFit, "-o",
                                 (scratch.path() / "run").string()}),
                 ErrorKind::kBadInput, Names("motion.rows"));
}

TEST(SimulationProgress, IsShownOnATerminalAndNowhereElse) {
  const TemporaryFolder scratch;
  const auto case_file = (scratch.path() / "case.toml").string();
  // Steps enough for about a second, so that the line is renewed.
  put_text(case_file,
           replaced(replaced(lecture_case_text(), "end_time = 4.0",
                             "end_time = 4.0\nrows = 10\nmodels = [\"reference_exact\"]"),
                    "[reference]\ntime_step = 1e-3", "[reference]\ntime_step = 1e-5"));
  const std::string words = "simulate: reference_exact (1 of 1), ";
  const auto command = [&](const std::string& folder) {
    return std::vector<std::string>{"simulate", case_file, "--fit",
                                    kFit,       "-o",      (scratch.path() / folder).string()};
  };
  const auto plain = run_viscontact(command("plain"));
  expect_done(plain);
  EXPECT_THAT(plain.errors, ::testing::Not(HasSubstr(words)));
  // `script` gives the program a terminal.
  std::string line = VISCONTACT_EXECUTABLE;
  for (const auto& word : command("terminal")) line += " '" + word + "'";
  const auto shown = run_process({"script", "-qec", line, "/dev/null"}, {"TERM=xterm"});
  EXPECT_EQ(shown.exit_status, 0) << shown.output;
  EXPECT_THAT(shown.output, HasSubstr("\r\033[K" + words));
}

}  // namespace
}  // namespace viscontact
