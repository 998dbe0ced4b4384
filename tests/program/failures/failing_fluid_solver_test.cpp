// A fluid solver that fails in the middle of a run: exit code 5, its last lines, everything up to
// then is kept, and the same command continues the run when the solver works again.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/common/regular_expressions.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;

constexpr const char* kFallingDisc = R"(title = "A disc falls"
[space]
dimension = 2
[fluid]
viscosity = 1.0
[domain]
disc = { radius = 8.0 }
[viscous_contact]
time_step = 0.1
end_time = 1.0
[output]
every = 0.1
[[particle]]
centre = [0.0, 2.0]
radius = 1.0
force = [0.5, -1.0]
)";

class FailingFluidSolver : public ::testing::Test {
 protected:
  FailingFluidSolver() { scratch_.file("case.toml", kFallingDisc); }

  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }

  /// Runs the case with a program in FreeFEM's place that answers as examples/stokes_drag.py does.
  /// `at_failure` is what it does, in Python, in place of answering with velocities in the seventh
  /// step, for the eighth time: the first step asks twice, because it estimates errors.
  ProgramResult run(const std::string& folder, const std::string& at_failure = "") const {
    const auto fake = scratch_.file("freefem", R"(#!/usr/bin/python3
import runpy
import sys

solver = runpy.run_path(")" VISCONTACT_SOURCE_FOLDER R"(/examples/stokes_drag.py")
times = 0
def failing(solve):
    def answer(*arguments):
        global times
        times += 1
        if times == 8:
            )" + (at_failure.empty() ? "pass" : at_failure) +
                                                   R"(
        return solve(*arguments)
    return answer
StokesDrag = solver["StokesDrag"]
StokesDrag.solve = failing(StokesDrag.solve)
StokesDrag(solver["words"]()).run()
)");
    make_executable(fake);
    return run_viscontact({"particles", path("case.toml"), "-o", path(folder)},
                          {"VISCONTACT_FREEFEM=" + fake.string()});
  }

  /// Rows of steps.csv, without the line of names.
  static std::ptrdiff_t steps_in(const std::string& file) {
    const auto rows = replaced_matches(read_file(file), "#[^\n]*\n", "");
    return std::ranges::count(rows, '\n') - 1;
  }

  /// What a run computes: final_particles.csv and motion.csv without comments.
  std::string results_in(const std::string& folder) const {
    return replaced_matches(
        read_file(path(folder + "/final_particles.csv")) + read_file(path(folder + "/motion.csv")),
        "#[^\n]*\n", "");
  }

  TemporaryFolder scratch_;
};

TEST_F(FailingFluidSolver, IsNamedAndTheRunUpToThenIsKeptAndContinued) {
  expect_done(run("undisturbed"));
  ASSERT_EQ(steps_in(path("undisturbed/steps.csv")), 10);
  struct Way {
    std::string folder, at_failure;
    std::vector<std::string> said;
  };
  for (const auto& [folder, at_failure, said] :
       {Way{"dies",
            R"(print("no memory", file=sys.stderr); sys.exit(3))",
            {"status 3", "its last lines: ", "no memory"}},
        Way{"answers_nan",
            R"(print("velocities nan 0 0", flush=True); sys.stdin.read())",
            {"it answered 'nan' in place of a finite number"}}}) {
    SCOPED_TRACE(folder);
    const auto result = run(folder, at_failure);
    EXPECT_EQ(result.exit_status, 5);
    EXPECT_THAT(result.errors, Names("'solve'"));
    for (const auto& part : said) EXPECT_THAT(result.errors, Names(part));
    EXPECT_EQ(steps_in(path(folder + "/steps.csv")), 6);
    EXPECT_TRUE(std::filesystem::exists(path(folder + "/restart.bin")));
    EXPECT_TRUE(std::filesystem::exists(path(folder + "/particles_00006.vtp")));
    expect_done(run(folder));
    EXPECT_EQ(steps_in(path(folder + "/steps.csv")), 10);
    EXPECT_EQ(results_in(folder), results_in("undisturbed"));
  }
}

TEST_F(FailingFluidSolver, LeavesTheColumnsOfTheFluidEmptyIfNoStepWasComputed) {
  // The fake of run() fails in a step; here each placement does.
  put_text(
      path("case.toml"),
      replaced(kFallingDisc, "viscosity = 1.0",
               "viscosity = 1.0\nsolver = [\"sh\", \"-c\", \"echo ready places; read line\"]"));
  EXPECT_EQ(run_viscontact({"particles", path("case.toml"), "-o", path("out")}).exit_status, 5);
  EXPECT_THAT(read_file(path("out/final_particles.csv")),
              HasSubstr("fluid_torque_error_estimate\n0,0,2,0,0,1,0,0,0,,,,,\n"));
}

TEST_F(FailingFluidSolver, ThatIsMissingIsSaidWithWhatToDo) {
  const auto result = run_viscontact({"particles", path("case.toml"), "-o", path("out")},
                                     {"VISCONTACT_FREEFEM=no-such-freefem"});
  expect_refusal(result, ErrorKind::kExternalProgram,
                 Names("no-such-freefem", "apt-get install freefem++"));
}

}  // namespace
}  // namespace viscontact
