// Runs of `viscontact particles` that a signal ends or that start from a restart file.
#include "viscontact/particle_runs/io/restart.hpp"

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
using ::testing::HasSubstr;

TEST_F(ParticlesCommand, ARestartContinuesBitForBit) {
  const std::string half = replaced(kCase, "end_time = 10.0", "end_time = 4.35");
  expect_done(run(put_case(kCase), out("whole")));
  expect_done(run(put_case(half, "half.toml"), out("half")));
  expect_done(run(put_case(kCase), out("rest"),
                  {"--restart", (out("half") / "restart.bin").string(), "-j", "3"}));
  for (const auto* file : {"final_particles.csv", "final_contacts.csv", "restart.bin"})
    EXPECT_EQ(content(out("whole") / file), content(out("rest") / file)) << file;
  const auto record = nlohmann::json::parse(read_file(out("rest") / "run.json"));
  EXPECT_DOUBLE_EQ(record["from_time"], 4.35);
}

/// A ball that hits the floor in the step to 1.4.
const std::string kBall = R"(title = "A ball"
[space]
dimension = 2
gravity = [0.0, -1.0]
[viscous_contact]
time_step = 0.1
end_time = 2.1
gamma_min = 0.0
restitution = 0.9
[output]
every = 0.7
tables = ["walls"]
[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
[[particle]]
centre = [0.0, 2.0]
radius = 1.0
mass = 1.0
)";

TEST_F(ParticlesCommand, ARestartHasTheForcesOfTheImpactsOfTheStepBefore) {
  expect_done(run(put_case(kBall), out("whole")));
  expect_done(
      run(put_case(replaced(kBall, "end_time = 2.1", "end_time = 1.4"), "half.toml"), out("half")));
  expect_done(
      run(put_case(kBall), out("rest"), {"--restart", (out("half") / "restart.bin").string()}));
  const auto rows = [&](const std::string& folder) {
    const auto text = read_file(out(folder) / "walls.csv");
    return text.substr(text.find("\n1.4"));
  };
  EXPECT_THAT(rows("whole"), HasSubstr(",-1,0,-26."));
  EXPECT_EQ(rows("rest"), rows("whole"));
}

TEST_F(ParticlesCommand, ThatContinuesAfterItsLastStepHasTheForcesOfItsImpacts) {
  // No frame is due at the end, so that the frame there is written again without a step.
  const auto file = put_case(
      replaced(replaced(kBall, "end_time = 2.1", "end_time = 1.4"), "every = 0.7", "every = 0.9"));
  expect_done(run(file, out()));
  const auto before = read_file(out() / "walls.csv");
  EXPECT_THAT(before, HasSubstr(",-1,0,-26."));
  fs::remove(out() / "particles.html");
  expect_done(run(file, out()));
  EXPECT_EQ(read_file(out() / "walls.csv"), before);
}

TEST_F(ParticlesCommand, ARestartDoesNotReplaceTheRunThatItContinues) {
  expect_done(run(put_case(replaced(kCase, "end_time = 10.0", "end_time = 4.35")), out()));
  const auto before = files_below(out());
  expect_refusal(run(put_case(kCase), out(), {"--restart", (out() / "restart.bin").string()}),
                 ErrorKind::kBadInput, Names(out().string()));
  EXPECT_EQ(files_below(out()), before);
}

class SignalledParticles : public ParticlesCommand,
                           public ::testing::WithParamInterface<std::string> {};

TEST_P(SignalledParticles, KeepWhatTheyHaveAndARestartGoesOn) {
  // Long enough that the signal comes in the middle of it: a hundred million steps are minutes.
  const auto endless =
      put_case(replaced(replaced(replaced(kCase, "time_step = 0.05", "time_step = 1e-7"),
                                 "every = 0.5", "every = 1e-5"),
                        "tolerance = 1e-6", "tolerance = 1e-3"),
               "long.toml");
  const auto result = run_viscontact({"particles", endless.string(), "-o", out().string()}, {},
                                     "(sleep 1; kill -" + GetParam() + " $$) &");
  EXPECT_EQ(result.exit_status, results::exit_code_of(ErrorKind::kInterrupted)) << result.errors;
  EXPECT_THAT(result.errors, Says("the same command continues"));
  const auto state = particles::read_restart(out() / "restart.bin");
  EXPECT_GT(state.steps, 0);
  EXPECT_LT(state.time, 10);
  const auto record = nlohmann::json::parse(read_file(out() / "run.json"));
  EXPECT_EQ(record["to_time"], state.time);
  // Every frame that is on disk is in the list of frames, too.
  const std::string list = read_file(out() / "particles.pvd");
  int frames = 0;
  for (const auto& entry : fs::directory_iterator(out())) {
    if (entry.path().extension() != ".vtp") continue;
    ++frames;
    EXPECT_THAT(list, HasSubstr(entry.path().filename().string()));
  }
  EXPECT_GT(frames, 1);
  expect_done(run(put_case(kCase), out("rest"), {"--restart", (out() / "restart.bin").string()}));
}

// HUP is what the loss of the terminal or of the connection sends.
INSTANTIATE_TEST_SUITE_P(Signals, SignalledParticles, ::testing::Values("INT", "HUP"),
                         [](const auto& test) { return test.param; });

TEST_F(ParticlesCommand, ARestartIsOfTheSameParticles) {
  expect_done(run(put_case(kCase), out()));
  const auto restart = (out() / "restart.bin").string();
  const auto longer = replaced(replaced(kCase, "end_time = 10.0", "end_time = 11.0"),
                               "until = 10.0", "until = 11.0");
  const auto refused = [&](const std::string& text, const std::string& said,
                           const std::string& file) {
    expect_refusal(run(put_case(text, "other.toml"), out("no"), {"--restart", file}),
                   ErrorKind::kBadInput, Names(said));
    EXPECT_FALSE(fs::exists(out("no")));
  };
  refused(kCase, "time 10", restart);
  refused(replaced(longer, "\nmass = 1.0", "\nmass = 2.0"), "masses", restart);
  refused(replaced(longer, "radius = 1.0", "radius = 1.01"), "radii", restart);
  refused(replaced(longer, "[particles]\nfile = \"discs.csv\"\n", ""), "3 particles", restart);
  refused(replaced(longer, "[[plane]]\npoint = [0.0, 0.0]\nnormal = [0.0, 1.0]\n", ""),
          "obstacle -1", restart);
  refused(longer, "discs.csv", (folder_.path() / "discs.csv").string());
  auto bytes = read_file(restart);
  refused(longer, "half.bin",
          folder_.file("half.bin", bytes.substr(0, bytes.size() - 100)).string());
  bytes[bytes.size() - 50] = static_cast<char>(bytes[bytes.size() - 50] + 1);
  refused(longer, "bit.bin", folder_.file("bit.bin", bytes).string());
}

/// A source that the case of these tests may have, with other values of its keys if they are given.
std::string source(const std::string& rate = "1.0", const std::string& more = "") {
  return "[[source]]\nradius = [0.3, 0.4]\nmass = 1.0\nrate = " + rate +
         "\nregion = { from = [-9.0, 8.0], to = [9.0, 12.0] }\n" + more;
}

TEST_F(ParticlesCommand, ARestartHasTheSourcesOfItsRunAndMayHaveMore) {
  const auto half = replaced(kCase, "end_time = 10.0", "end_time = 5.0");
  const auto run_half = [&](const std::string& sources, const std::string& folder) {
    expect_done(run(put_case(half + sources, "half.toml"), out(folder)));
    return (out(folder) / "restart.bin").string();
  };
  const auto restart = run_half(source(), "half");
  const auto refused = [&](const std::string& sources, const std::string& said) {
    expect_refusal(run(put_case(kCase + sources, "other.toml"), out("no"), {"--restart", restart}),
                   ErrorKind::kBadInput, Names(said));
  };
  refused("", "1 sources");
  refused(source("2.0"), "source[0]");
  refused(source("1.0", "seed = 3\n"), "seed");
  refused(source("1.0", "begin = 4.0\n"), "source[0]");
  refused(replaced(source(), "0.4]", "0.5]"), "radii");
  // Six have come at the times 0 to 5. The same source goes on; a new one begins at 5.
  const auto poured = [&](const std::string& sources, const std::string& from,
                          const std::string& folder) {
    expect_done(run(put_case(kCase + sources), out(folder), {"--restart", from}));
    const auto record = nlohmann::json::parse(read_file(out(folder) / "run.json"));
    return record["particles"].get<int>() - 3;
  };
  EXPECT_EQ(poured(source(), restart, "same"), 11);
  EXPECT_EQ(poured(source() + source("1.0", "seed = 3\n"), restart, "more"), 11 + 6);
  EXPECT_EQ(poured(source(), run_half("", "none"), "new"), 6);
}

// A disc of the radius 1 hangs on a hinge at its top and swings from the angle 0 to about 1; a
// restart with a stop at 0.5 would have to turn it back at once.
TEST_F(ParticlesCommand, ARestartIsNotBeyondAStop) {
  const std::string swing = R"(title = "Swing"
[space]
dimension = 2
[viscous_contact]
time_step = 0.01
end_time = 1.0
[[particle]]
centre = [0.0, 0.0]
radius = 1.0
mass = 1.0
angular_velocity = 1.0
velocity = [0.9, 0.0]
[[hinge]]
particle = 0
at = [0.0, 0.9]
)";
  expect_done(run(put_case(swing), out()));
  const auto restart = (out() / "restart.bin").string();
  const auto longer = replaced(swing, "end_time = 1.0", "end_time = 1.2");
  expect_refusal(run(put_case(longer + "highest_angle = 0.5\n", "stop.toml"), out("no"),
                     {"--restart", restart}),
                 ErrorKind::kBadInput, Names("0 turned", "highest_angle"));
  expect_done(run(put_case(longer + "highest_angle = 1.5\n", "far.toml"), out("far"),
                  {"--restart", restart}));
}

TEST_F(ParticlesCommand, RerunMakesTheSameAgain) {
  expect_done(run(put_case(kCase), out()));
  expect_done(run_viscontact(
      {"rerun", (out() / "particles_00007.vtp").string(), "-o", out("again").string()}));
  for (const auto* file : {"final_particles.csv", "final_contacts.csv"})
    EXPECT_EQ(content(out() / file), content(out("again") / file));
}

TEST_F(ParticlesCommand, FilesOfTheResultAreInputsAgain) {
  expect_done(run(put_case(kCase), out()));
  const auto file = put_case(replaced(kCase, "\"discs.csv\"", "\"out/final_particles.csv\""));
  const std::string text = read_file(file);
  expect_done(run(put_case(text.substr(0, text.find("[[particle]]"))), out("second")));
}

}  // namespace
}  // namespace viscontact
