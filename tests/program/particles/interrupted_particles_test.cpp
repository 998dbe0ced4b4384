// A run of many particles that was interrupted continues by the same command, and becomes the run
// that it would have been without the interrupt.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Three discs that fall onto a floor and onto each other, one of them pushed by its id. So many
/// steps that an interrupt comes between two of the twenty frames.
const std::string kLongCase = discs_on_a_floor("1e-4", "10.0", R"([output]
every = 0.5
[[force]]
particles = [7]
value = [ { until = 5.0, value = [0.7, -0.7] }, { until = 10.0, value = [-0.7, 0.7] } ]
)");
const std::string kFallingDiscs =
    "id,x,y,vx,vy,radius,mass\n3,3,1,0,0,1,1\n12,6.5,4,0,-1,0.5,0.25\n7,0,2,0,0,1,1\n";

/// Interrupts a run as soon as it has written the frame `frame`.
struct Interrupt {
  std::string signal;
  int frame = 0;
};

class InterruptedParticles : public ParticlesCommand {
 protected:
  InterruptedParticles() {
    folder_.file("discs.csv", kFallingDiscs);
    put_case(kLongCase);
  }

  ProgramResult run(const std::string& folder, const Interrupt& interrupt = {}) const {
    const auto shell =
        interrupt.signal.empty()
            ? std::string()
            : fmt::format(
                  "(while [ ! -e '{}/particles_{:05}.vtp' ]; do sleep 0.01; done; kill -{} "
                  "$$) &",
                  path(folder), interrupt.frame, interrupt.signal);
    return run_viscontact({"particles", path("case.toml"), "-o", path(folder)}, {}, shell);
  }

  /// A run that ends early with a state to go on from.
  void run_half(const std::string& folder) const {
    const auto result = run(folder, {"INT", 4});
    ASSERT_EQ(result.exit_status, results::exit_code_of(ErrorKind::kInterrupted)) << result.errors;
  }
};

TEST_F(InterruptedParticles, GoOnByTheSameCommandToTheSameFilesAsWithoutAnInterrupt) {
  expect_done(run("whole"));
  // Two interrupts, and a death that saves nothing: after it the run continues from the second
  // interrupt.
  for (const auto& [signal, frame] : {Interrupt{"INT", 3}, {"TERM", 8}, {"KILL", 13}}) {
    const auto result = run("parts", {signal, frame});
    const int status = signal == "KILL" ? 128 + 9 : results::exit_code_of(ErrorKind::kInterrupted);
    ASSERT_EQ(result.exit_status, status) << signal << result.errors;
    EXPECT_EQ(result.errors.find("continues from t = ") != std::string::npos, frame > 3)
        << result.errors;
  }
  const auto last = run("parts");
  expect_done(last);
  EXPECT_THAT(last.errors, Continues());
  expect_same_files(path("whole"), path("parts"));
  const auto record = nlohmann::json::parse(read_file(path("parts/run.json")));
  EXPECT_EQ(record["steps"], 100000);
  EXPECT_EQ(record["from_time"], 0);
}

TEST_F(InterruptedParticles, ListEachReboundOnce) {
  std::string text = kLongCase;
  const std::string film = "gamma_min = -2.0\n";
  text.replace(text.find(film), film.size(), "gamma_min = 0.0\nrestitution = 0.9\n");
  put_case(text);
  expect_done(run("whole"));
  for (const auto& [signal, frame] : {Interrupt{"INT", 3}, {"KILL", 8}})
    (void)run("parts", {signal, frame});
  expect_done(run("parts"));
  expect_same_files(path("whole"), path("parts"));
  const auto rebounds = read_file(path("whole/rebounds.csv"));
  // The disc 12 falls on the floor.
  EXPECT_THAT(rebounds, HasSubstr(",12,-1,"));
}

TEST_F(InterruptedParticles, ThatAreFinishedAreUpToDate) {
  put_case(replaced(kLongCase, "1e-4", "1e-2"));
  expect_done(run("out"));
  const auto before = files_below(path("out"));
  const auto again = run("out");
  expect_done(again);
  EXPECT_THAT(again.errors, IsUpToDate("out"));
  EXPECT_EQ(files_below(path("out")), before);
  const auto json = run_viscontact({"particles", path("case.toml"), "-o", path("out"), "--json"});
  EXPECT_EQ(nlohmann::json::parse(json.output)["steps"], 1000);
}

TEST_F(InterruptedParticles, WhoseStepsDidNotConvergeSayItAgain) {
  // A stack that needs more than an iteration.
  put_case(replaced(kLongCase, "1e-4", "1e-2") + "[solver]\nmax_iterations = 1\n");
  put_text(path("discs.csv"), kFallingDiscs + "20,0.1,4.1,0,0,1,1\n21,0.2,6.2,0,0,1,1\n");
  expect_refusal(run("out"), ErrorKind::kNotConverged);
  const auto again = run("out");
  expect_refusal(again, ErrorKind::kNotConverged);
  EXPECT_THAT(again.errors, IsUpToDate(""));
}

TEST_F(InterruptedParticles, FinishedOneOfWhichAFileIsMissingIsCompletedWithoutAStep) {
  put_case(replaced(kLongCase, "1e-4", "1e-2"));
  expect_done(run("out"));
  const auto before = without_costs(path("out"));
  fs::remove(path("out/particles.html"));
  const auto again = run("out");
  expect_done(again);
  EXPECT_THAT(again.errors, AllOf(Continues(), Names("t = 10")));
  EXPECT_EQ(without_costs(path("out")), before);
}

TEST_F(InterruptedParticles, OfAnotherCaseAreReplacedAndItIsSaid) {
  run_half("out");
  put_case(replaced(kLongCase, "1e-4", "1e-2"));
  const auto changed = run("out");
  expect_done(changed);
  EXPECT_THAT(changed.errors, Names(path("case.toml")));
  expect_done(run("fresh"));
  expect_same_files(path("fresh"), path("out"));
  put_text(path("discs.csv"), replaced(kFallingDiscs, "6.5,4", "6.5,5"));
  EXPECT_THAT(run("out").errors, Names(path("discs.csv")));
}

TEST_F(InterruptedParticles, WithADamagedFileBeginAgainAndSayWhy) {
  run_half("half");
  const auto cut = [](const std::string& text) { return text.substr(0, text.size() * 2 / 3); };
  // A spreadsheet writes other line ends.
  const auto resaved = [](const std::string& text) { return replaced_matches(text, "\n", "\r\n"); };
  for (const std::string name :
       {"restart.bin", "steps.csv", "particles.pvd", "particles_00002.vtp"})
    for (const std::string damage : {"missing", "cut", "resaved"}) {
      if (damage == "missing" && name == "restart.bin") continue;  // then there was no run
      if (damage == "resaved" && name != "steps.csv") continue;
      SCOPED_TRACE(name + " " + damage);
      fs::remove_all(path("out"));
      fs::copy(path("half"), path("out"));
      const auto text = read_file(path("out/" + name));
      damage == "missing"
          ? void(fs::remove(path("out/" + name)))
          : put_text(path("out/" + name), damage == "cut" ? cut(text) : resaved(text));
      const auto again = run("out", {"INT", 7});
      EXPECT_THAT(again.errors, AllOf(Names(name), Not(HasSubstr("after step"))));
      // Frame 7 is of the new run: the half had come to frame 5 at most.
      EXPECT_EQ(again.exit_status, results::exit_code_of(ErrorKind::kInterrupted)) << again.errors;
    }
}

TEST_F(InterruptedParticles, KilledOnesCanBeDrawn) {
  ASSERT_EQ(run("out", {"KILL", 4}).exit_status, 128 + 9);
  EXPECT_FALSE(fs::exists(path("out/particles.html")));
  expect_done(run_viscontact({"report", path("out")}));
  EXPECT_TRUE(fs::exists(path("out/particles.html")));
  EXPECT_TRUE(fs::exists(path("out/particles.svg")));
}

TEST_F(InterruptedParticles, KilledBetweenTwoFilesGoOnFromTheOlderRestart) {
  run_half("out");
  const auto older = read_file(path("out/restart.bin"));
  ASSERT_EQ(run("out", {"INT", 9}).exit_status, results::exit_code_of(ErrorKind::kInterrupted));
  // As if the process had been killed while it appended to its tables, before it wrote restart.bin.
  put_text(path("out/restart.bin"), older);
  put_text(path("out/steps.csv"), read_file(path("out/steps.csv")) + "45001,4.5");
  put_text(path("out/particles.pvd"), read_file(path("out/particles.pvd")) + "<Data");
  const auto last = run("out");
  expect_done(last);
  EXPECT_THAT(last.errors, Continues());
  expect_done(run("whole"));
  expect_same_files(path("whole"), path("out"));
}

}  // namespace
}  // namespace viscontact
