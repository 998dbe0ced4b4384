// `viscontact sweep` of a case of many particles: rows, means, what is kept, kills, and tasks.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/particle_runs/sweep/particles_case.hpp"
#include "tests/program/sweep/sweep_command.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/common/text/csv.hpp"

namespace viscontact {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Eight runs: two area fractions with four draws.
class SweepOfParticles : public SweepCommand {
 protected:
  SweepOfParticles() { put_text(path("case.toml"), small_particles_case()); }
  ProgramResult run(const std::string& output, const std::vector<std::string>& more = {},
                    const std::string& shell_before = "", const std::string& draws = "4") const {
    std::vector<std::string> options = {"--vary", "arrangement.area_fraction=0.2,0.4", "--draws",
                                        draws};
    options.insert(options.end(), more.begin(), more.end());
    return sweep(path("case.toml"), options, output, shell_before);
  }
  /// The time at which the run of this folder ended.
  auto time_of(const std::string& output, const std::string& folder) const {
    return std::filesystem::last_write_time(path(output + ".runs/" + folder + "/result.json"));
  }
  void expect_same_tables(const std::string& one, const std::string& other) const {
    EXPECT_EQ(rest_of(path(one + ".csv")), rest_of(path(other + ".csv")));
    EXPECT_EQ(rest_of(path(one + "_means.csv")), rest_of(path(other + "_means.csv")));
  }
};

TEST_F(SweepOfParticles, DryRunMeasuresSteps) {
  const auto dry = run_viscontact({"sweep", path("case.toml"), "-o", path("rows.csv"), "--draws",
                                   "6", "--jobs", "1", "--dry-run", "--json"});
  expect_done(dry);
  const auto json = nlohmann::json::parse(dry.output);
  EXPECT_GT(json.at("seconds"), 0);
  const auto& output = json.at("outputs").at(0);
  EXPECT_EQ(output.at("rows"), 6);
  EXPECT_EQ(output.at("finished"), 0);
  EXPECT_GT(output.at("seconds_per_row"), 0);
  EXPECT_THAT(output.at("estimated_from").get<std::string>(), Names("row 1"));
  EXPECT_FALSE(std::filesystem::exists(path("rows.csv")));
  EXPECT_FALSE(std::filesystem::exists(path("rows.csv.runs")));
}

TEST_F(SweepOfParticles, WritesARowForEachRunAndTheMeansOverDraws) {
  const auto result = run("rows.csv");
  expect_done(result);
  EXPECT_EQ(result.output, "");
  EXPECT_THAT(result.errors, AllOf(Names("8 rows", path("rows.csv"), "rows_means.csv"),
                                   Not(HasSubstr("particles:"))));
  const auto rows = read_csv<5>(
      path("rows.csv"), {"arrangement.seed", "particles", "steps", "to_time", "area_fraction"}, 5);
  ASSERT_EQ(rows.rows.size(), 8U);
  EXPECT_EQ(*rows.rows[2].fields[0], 7);
  EXPECT_EQ(*rows.rows[2].fields[1], 20);  // 0.2 * 80/(pi/4) = 20.4
  EXPECT_EQ(*rows.rows[7].fields[1], 41);
  EXPECT_NEAR(*rows.rows[7].fields[4], 41 * 0.785398163 / 80, 1e-9);
  for (const auto& row : rows.rows) {
    EXPECT_EQ(*row.fields[2], 10);
    EXPECT_NEAR(*row.fields[3], 0.5, 1e-12);
  }
  const auto means = lines("rows_means.csv");
  ASSERT_EQ(means.size(), 3U);
  EXPECT_THAT(means[0],
              HasSubstr("arrangement.area_fraction,draws,failed,particles.mean,particles.s"));
  EXPECT_THAT(means[1], ::testing::StartsWith("0.2,4,0,20,0,"));

  // Draws differ, and a case of a row is the same run by itself.
  EXPECT_NE(lines()[1].substr(10), lines()[2].substr(10));
  EXPECT_TRUE(std::filesystem::exists(path("rows.csv.runs/1-3/run/run.json")));
  EXPECT_FALSE(std::filesystem::exists(path("rows.csv.runs/1-3/run/restart.bin")));
  const auto alone =
      run_viscontact({"particles", path("rows.csv.runs/1-3/case.toml"), "-o", path("alone")});
  expect_done(alone);
  const auto steps_of = [&](const std::string& file) {
    const auto text = read_file(path(file));
    return text.substr(text.find("\nstep,"));
  };
  EXPECT_EQ(steps_of("alone/steps.csv"), steps_of("rows.csv.runs/1-3/run/steps.csv"));

  const auto again = run("rows.csv");
  expect_done(again);
  EXPECT_THAT(again.errors, IsUpToDate("rows.csv"));
  expect_done(run_viscontact({"sweep", path("case.toml"), "-o", path("other.csv"), "--vary",
                              "arrangement.area_fraction=0.2,0.4", "--draws", "4", "--jobs", "1"}));
  expect_same_tables("rows", "other");
}

TEST_F(SweepOfParticles, MoreDrawsRunOnlyTheNewOnes) {
  expect_done(run("rows.csv"));
  const auto before = time_of("rows.csv", "1-3");
  expect_done(run("rows.csv", {}, "", "6"));
  EXPECT_EQ(lines().size(), 13U);
  EXPECT_EQ(time_of("rows.csv", "1-3"), before);
  EXPECT_TRUE(std::filesystem::exists(path("rows.csv.runs/1-5/result.json")));
}

TEST_F(SweepOfParticles, KilledAgainAndAgainItEndsWithTheTablesOfAnUndisturbedOne) {
  // Runs of some tenths of a second, which are killed at any time.
  put_text(path("case.toml"),
           replaced(small_particles_case(), "time_step = 0.05", "time_step = 0.0005"));
  expect_done(run("undisturbed.csv"));
  for (const int runs : {1, 3, 6}) {
    const auto kill = fmt::format(
        "(while kill -0 $$ && ! [ \"$(ls \"{}\"/*/result.json | wc -l)\" -ge {} ]; do sleep 0.01; "
        "done; kill -KILL $$) >/dev/null 2>&1 & ",
        path("rows.csv.runs"), runs);
    const auto killed = run("rows.csv", {}, kill);
    ASSERT_EQ(killed.exit_status, 128 + SIGKILL) << killed.errors;
    EXPECT_FALSE(std::filesystem::exists(path("rows.csv")));
  }
  const auto first = time_of("rows.csv", "0-0");
  expect_done(run("rows.csv"));
  EXPECT_EQ(time_of("rows.csv", "0-0"), first);  // a finished run is not computed again
  expect_same_tables("rows", "undisturbed");
}

TEST_F(SweepOfParticles, InterruptKeepsRunsAndTheSameCommandContinuesThem) {
  put_text(path("case.toml"),
           replaced(small_particles_case(), "time_step = 0.05", "time_step = 0.0005"));
  expect_done(run("undisturbed.csv"));
  const auto stop = fmt::format(
      "(while kill -0 $$ && ! [ -e \"{}\" ]; do sleep 0.01; done; kill -INT $$) >/dev/null 2>&1 & ",
      path("rows.csv.runs/0-2/result.json"));
  expect_refusal(run("rows.csv", {}, stop), ErrorKind::kInterrupted);
  expect_done(run("rows.csv"));
  expect_same_tables("rows", "undisturbed");
}

TEST_F(SweepOfParticles, TasksComputeSharesThatGatherPutsTogether) {
  expect_done(run("local.csv"));
  expect_done(run("rows.csv", {"--task", "1/3"}));
  EXPECT_TRUE(std::filesystem::exists(path("rows.csv.runs/1-0/result.json")));   // row 4
  EXPECT_FALSE(std::filesystem::exists(path("rows.csv.runs/0-0/result.json")));  // row 0
  const auto early = run("rows.csv", {"--gather"});
  expect_refusal(early, ErrorKind::kNotConverged, Names("5 of 8", "--gather"));
  EXPECT_FALSE(std::filesystem::exists(path("rows.csv")));
  expect_done(run("rows.csv", {"--task", "0/3"}));
  expect_done(run("rows.csv", {"--task", "2/3"}));
  expect_done(run("rows.csv", {"--gather"}));
  expect_same_tables("rows", "local");
}

TEST_F(SweepOfParticles, RunThatFailsStopsNoOther) {
  // With gaps of 3 the discs do not fit.
  const auto result = run("rows.csv", {"--vary", "arrangement.smallest_gap=0.02,3,0.03"});
  expect_done(result);
  EXPECT_THAT(result.errors, Names("8 runs", "'failure'"));
  EXPECT_THAT(lines()[5], AllOf(HasSubstr(",,,"), HasSubstr("case.toml:"), HasSubstr("do not fit"),
                                Not(HasSubstr("rows.csv.runs"))));
  EXPECT_THAT(lines("rows_means.csv")[2], ::testing::StartsWith("0.2,3,0,4,,"));
  // The same in a table that tasks make.
  expect_done(
      run("tasks.csv", {"--vary", "arrangement.smallest_gap=0.02,3,0.03", "--task", "0/1"}));
  expect_done(run("tasks.csv", {"--vary", "arrangement.smallest_gap=0.02,3,0.03", "--gather"}));
  expect_same_tables("tasks", "rows");
}

TEST_F(SweepOfParticles, KeepsAllFilesOfTheRunsIfAsked) {
  expect_done(run("rows.csv", {"--keep-runs"}));
  for (const auto* name : {"particles.html", "restart.bin", "particles_00000.vtp"})
    EXPECT_TRUE(std::filesystem::exists(path(std::string("rows.csv.runs/0-0/run/") + name)));
}

TEST_F(SweepOfParticles, DrawsRowsOrTheMeansOfDrawsWithTheirErrors) {
  const auto plot = [&](const std::string& name) {
    return std::vector<std::string>{"--plot", path(name), "--column", "contacts,iterations"};
  };
  expect_done(run("rows.csv", plot("means.svg")));
  const auto means = read_file(path("means.svg"));
  EXPECT_THAT(means, AllOf(HasSubstr("rows_means.csv"), HasSubstr(">contacts<"),
                           HasSubstr(">arrangement.area_fraction<")));
  // A curve, and a curve of bars, for each column.
  expect_done(sweep(path("case.toml"),
                    {"--vary", "arrangement.area_fraction=0.2,0.4", "--plot", path("rows.svg"),
                     "--column", "contacts,iterations"},
                    "single.csv"));
  const auto count = [](const std::string& text, std::string_view part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  const auto curve = "<g id=\"gnuplot_plot_";
  EXPECT_EQ(count(read_file(path("rows.svg")), curve), 2U);
  EXPECT_EQ(count(means, curve), 4U);
}

TEST_F(SweepOfParticles, OptionsOfTheOtherKindOfCaseAreRefused) {
  const auto refused = [&](const std::vector<std::string>& options, const std::string& words) {
    expect_refused(path("case.toml"), options, ErrorKind::kWrongUsage, Names(words));
  };
  refused({"--draws", "2", "--models", "inertial"}, "one sphere");
  refused({}, "--draws");
  refused({"--draws", "2", "--task", "2/2"}, "--task");
  refused({"--draws", "2", "--tasks", "2"}, "--launcher");
  refused({"--draws", "2", "--plot", path("x.svg")}, "--vary");
  refused({"--draws", "2", "--task", "0/2", "--plot", path("x.svg")}, "--gather");
  refused({"--vary", "arrangement.area_fraction=0.2,0.4", "--plot", path("x.svg"), "--column", "u"},
          "'u'");
  expect_refused(data("cases/vanishing_viscosity.toml"), {"--draws", "2"}, ErrorKind::kWrongUsage,
                 Names("--draws"));
  expect_refused(data("cases/vanishing_viscosity.toml"), {"--launcher", "slurm"},
                 ErrorKind::kWrongUsage, Names("--launcher"));
}

TEST_F(SweepOfParticles, DoesNotReplaceAFileThatIsNoTableOfMeans) {
  put_text(path("rows_means.csv"), "mine\n");
  expect_refused(path("case.toml"), {"--draws", "2"}, ErrorKind::kBadInput,
                 Names("rows_means.csv"));
}

TEST_F(SweepOfParticles, ArrayJobAsksForTheTasksWhoseRunsAreMissing) {
  const auto program = [&](const std::string& name, const std::string& script) {
    put_text(path("bin/" + name), "#!/bin/sh\n" + script + "\n");
    make_executable(path("bin/" + name));
  };
  make_folder(path("bin"));
  program("squeue", "true");
  program("sbatch",
          "for word; do printf '%s\\n' \"$word\"; done > '" + path("asked") + "'\necho 12");
  const auto submit = [&] {
    return run_viscontact({"sweep", path("case.toml"), "-o", path("rows.csv"), "--draws", "8",
                           "--launcher", "slurm", "--tasks", "4"},
                          {"PATH=" + path("bin") + ":/usr/bin:/bin"});
  };
  const auto submitted = submit();
  expect_done(submitted);
  EXPECT_EQ(submitted.output, "12\n");
  EXPECT_THAT(submitted.errors, Names("job 12", "4 tasks", "--draws", "8", "--seed", "--gather"));
  EXPECT_THAT(read_file(path("asked")), HasSubstr("--array=0-3\n"));
  // Edits of the case do not reach the tasks.
  put_text(path("case.toml"), "no case");
  for (const std::string task : {"0", "2", "3"}) {
    const auto done =
        run_process({"sh", path("rows.csv.slurm/task.sh")}, {"SLURM_ARRAY_TASK_ID=" + task});
    EXPECT_EQ(done.exit_status, 0) << done.output;
  }
  put_text(path("case.toml"), small_particles_case());
  expect_done(submit());
  EXPECT_THAT(read_file(path("asked")), HasSubstr("--array=1\n"));
  expect_done(sweep(path("case.toml"), {"--draws", "8", "--task", "1/4"}));
  expect_done(sweep(path("case.toml"), {"--draws", "8", "--gather"}));
  expect_done(sweep(path("case.toml"), {"--draws", "8"}, "local.csv"));
  expect_same_tables("rows", "local");
}

}  // namespace
}  // namespace viscontact
