// Cases that `viscontact particles` refuses, and runs that it cannot finish.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"
#include "viscontact/particle_runs/io/restart.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

TEST_F(ParticlesCommand, StepsThatDoNotConvergeAreReportedAndAllIsWritten) {
  // A stack of five on the floor needs more than an iteration.
  std::string text = replaced(kCase, "max_iterations = 10000", "max_iterations = 1");
  for (int k = 1; k < 5; ++k)
    text += "\n[[particle]]\ncentre = [0.3, " + std::to_string(2 + 2.2 * k) +
            "]\nradius = 1.0\nmass = 1.0\n";
  const auto result = run(put_case(text), out());
  expect_refusal(result, ErrorKind::kNotConverged);
  EXPECT_THAT(result.errors, Names("warning"));
  const auto record = nlohmann::json::parse(read_file(out() / "run.json"));
  EXPECT_GT(record["unconverged_steps"], 0);
  EXPECT_GT(record["failed_steps"], 0);
  EXPECT_GT(record["largest_residual"], 1e-6);
  EXPECT_THAT(read_file(out() / "steps.csv"), ::testing::ContainsRegex(",0\n"));
  EXPECT_TRUE(fs::exists(out() / "particles.html"));
}

TEST_F(ParticlesCommand, StepsThatNearlyConvergeAreAWarning) {
  std::string text = replaced(kCase, "max_iterations = 10000", "max_iterations = 8");
  for (int k = 1; k < 5; ++k)
    text += "\n[[particle]]\ncentre = [0.3, " + std::to_string(2 + 2.2 * k) +
            "]\nradius = 1.0\nmass = 1.0\n";
  run(put_case(text), out());
  const double missed =
      nlohmann::json::parse(read_file(out() / "run.json"))["largest_residual"].get<double>();
  // Half of the tolerance is allowed, so that the largest residual exceeds it by a factor of four.
  text = replaced(text, "tolerance = 1e-6",
                  fmt::format("impulse_tolerance = 0.1\ntolerance = {}", missed / 2));
  const auto result = run(put_case(text), out("near"));
  expect_done(result);
  EXPECT_THAT(result.errors, Names("10", "steps.csv"));
  const auto record = nlohmann::json::parse(read_file(out("near") / "run.json"));
  EXPECT_GT(record["unconverged_steps"], 0);
  EXPECT_EQ(record["failed_steps"], 0);
}

TEST_F(ParticlesCommand, ParticlesThatWaitAtTheEndAreAWarning) {
  // 101 discs are due at one point, from which they fall; each leaves it in 2 to 3 units of time.
  const auto file = put_case(kCase + std::string(R"([[source]]
radius = [0.5, 0.75]
mass = 1.0
rate = 10.0
region = { from = [0.0, 20.0], to = [0.0, 20.0] }
)"));
  // The same command again finds the run finished, and says the same.
  for (int k = 0; k < 2; ++k) {
    const auto result = run(file, out());
    expect_done(result);
    EXPECT_THAT(result.errors, Names("warning", "source[0]"));
  }
  const auto record = nlohmann::json::parse(read_file(out() / "run.json"));
  EXPECT_GT(record["particles"], 3);
  EXPECT_LT(record["particles"], 20);
}

struct BadParticles {
  std::string name, from, to, said;
};
std::ostream& operator<<(std::ostream& out, const BadParticles& bad) { return out << bad.name; }

class BadParticlesCase : public ParticlesCommand,
                         public ::testing::WithParamInterface<BadParticles> {};

TEST_P(BadParticlesCase, IsRefusedBeforeAnythingIsWritten) {
  const auto& bad = GetParam();
  const bool in_file = std::string(kDiscs).find(bad.from) != std::string::npos;
  if (in_file) folder_.file("discs.csv", replaced(kDiscs, bad.from, bad.to));
  const auto file = put_case(in_file ? std::string(kCase) : replaced(kCase, bad.from, bad.to));
  expect_refusal(run(file, out()), ErrorKind::kBadInput, Names(bad.said));
  EXPECT_FALSE(fs::exists(out()));
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadParticlesCase,
    ::testing::ValuesIn(std::vector<BadParticles>{
        {"NanInTheFile", "3,1,", "nan,1,", "discs.csv:2: x"},
        {"InfinityInTheFile", "3,1,", "3,inf,", "discs.csv:2: y"},
        {"NegativeRadiusInTheFile", "0.5,0.25", "-0.5,0.25", "discs.csv:3: radius"},
        {"HugePosition", "3,1,", "3e200,1,", "discs.csv:2: x"},
        {"ThirdDimension", "x,y,vx,vy,radius,mass\n3,1,0,0,1,1\n6.5,4,0,-1,0.5,0.25",
         "x,y,z,vx,vy,vz,radius,mass\n3,1,0,0,0,0,1,1", "discs.csv:2"},
        {"Overlap", "6.5,4,0", "3.5,2,0", "overlap"},
        {"Twice", "6.5,4,0", "3,1,0", "discs.csv:3: particle 0"},
        {"BehindThePlane", "6.5,4,0", "6.5,-4,0", "plane 1"},
        {"InThePlane", "6.5,4,0", "6.5,0.4,0", "discs.csv:3: particle 1"},
        {"OtherDimension", "dimension = 2", "dimension = 3", "case.toml:5: space.gravity"},
        {"NoDimension", "dimension = 2", "dimension = 4", "space.dimension"},
        {"NoNormal", "normal = [0.0, 1.0]", "normal = [0.0, 0.0]", "plane[0].normal"},
        {"LongStep", "time_step = 0.05", "time_step = 50", "viscous_contact.time_step"},
        {"ManySteps", "time_step = 0.05", "time_step = 1e-12", "viscous_contact.time_step"},
        {"PositiveGamma", "gamma_min = -2.0", "gamma_min = 2.0", "viscous_contact.gamma_min"},
        {"BothLaws", "gamma_min = -2.0", "gamma_min = -2.0\nviscosity = 1.0\nroughness = 0.1",
         "viscous_contact.viscosity"},
        {"ViscosityAlone", "gamma_min = -2.0", "viscosity = 1.0", "viscous_contact.roughness"},
        {"ForceEndsEarly", "until = 10.0", "until = 9.0", "particle[0].force"},
        {"ForceBackwards", "until = 10.0", "until = 4.0", "particle[0].force"},
        {"ForceOfThreeNumbers", "value = [0.7, -0.7]", "value = [0.7, -0.7, 0]",
         "particle[0].force"},
        {"ZeroMass", "\nmass = 1.0", "\nmass = 0.0", "case.toml"},
        {"Tolerance", "tolerance = 1e-6", "tolerance = 1e-20", "solver.tolerance"},
        {"Method", "tolerance = 1e-6", "method = \"magic\"", "solver.method"},
        {"TinyInterval", "every = 0.5", "every = 1e-300", "output.every"},
        {"TooSmallForTheTolerance", "0.5,0.25", "1e-6,0.25", "solver.tolerance"},
        {"TooFar", "6.5,4,0", "6.5,4e12,0", "discs.csv:3"},
        {"DenormalMass", "0.5,0.25", "0.5,1e-310", "discs.csv:3: mass"},
        {"PieceThatIsNone",
         "force = [ { until = 5.0, value = [0.7, -0.7] }, { until = 10.0, value = [-0.7, 0.7] } ]",
         "force = { until = 10.0, value = [0.0, 0.0] }", "force"},
        {"PivotOfNothing", "normal = [0.0, 1.0]", "normal = [0.0, 1.0]\npivot = [0.0, 0.0]",
         "plane[0].pivot"},
        {"UnknownKey", "every = 0.5", "evry = 0.5", "every"},
        {"NoFile", "file = \"discs.csv\"", "file = \"discs\"", "discs"},
        {"ForceOnNobody", "[output]", "[[force]]\nparticles = [3]\nvalue = [0.0, 0.0]\n[output]",
         "force[0].particles"},
        {"ForceTwice", "[output]", "[[force]]\nparticles = [2]\nvalue = [0.0, 0.0]\n[output]",
         "force[0].particles"},
    }),
    [](const auto& test) { return test.param.name; });

TEST_F(ParticlesCommand, BlankLinesAtTheEndOfTheFileAreNoParticles) {
  folder_.file("discs.csv", std::string(kDiscs) + "\n,,,,,\n\n");
  expect_done(run(put_case(kCase), out()));
  EXPECT_EQ(particles::read_particles(out() / "final_particles.csv", 2).particles.count(), 3U);
}

TEST_F(ParticlesCommand, AStepThatCannotBeComputedLeavesWhatWasBefore) {
  const auto result =
      run(put_case(replaced(kCase, "value = [-0.7, 0.7]", "value = [-1e90, 0.7]")), out());
  expect_refusal(result, ErrorKind::kNotConverged);
  EXPECT_EQ(nlohmann::json::parse(read_file(out() / "run.json"))["to_time"], 5.0);
  EXPECT_DOUBLE_EQ(particles::read_restart(out() / "restart.bin").time, 5.0);
}

TEST_F(ParticlesCommand, WallsThatMeetEndTheRunAndKeepWhatWasBefore) {
  // The ceiling comes down at 1 on discs of height 4 to 5, and stands still if the case says so.
  const auto with_ceiling = [&](const std::string& velocity) {
    return kCase + ("[[plane]]\npoint = [0.0, 6.0]\nnormal = [0.0, -1.0]\nvelocity = " + velocity);
  };
  const auto result = run(put_case(with_ceiling("[0.0, -1.0]\n")), out());
  expect_refusal(result, ErrorKind::kNotConverged, Names("plane", "overlap"));
  const auto record = nlohmann::json::parse(read_file(out() / "run.json"));
  const double until = record["to_time"];
  EXPECT_GT(until, 2);
  EXPECT_LT(until, 6);
  const auto restart = (out() / "restart.bin").string();
  EXPECT_DOUBLE_EQ(particles::read_restart(restart).time, until);
  // The state that is kept is one to go on from.
  expect_done(
      run(put_case(with_ceiling("[0.0, 0.0]\n"), "calm.toml"), out("on"), {"--restart", restart}));
}

TEST_F(ParticlesCommand, ItsOwnInputIsNotWrittenOver) {
  folder_.file("final_particles.csv", kDiscs);
  const auto file = put_case(replaced(kCase, "discs.csv", "final_particles.csv"));
  expect_refusal(run(file, folder_.path()), ErrorKind::kBadInput, Names("overwritten"));
  EXPECT_EQ(read_file(folder_.path() / "final_particles.csv"), kDiscs);
}

TEST_F(ParticlesCommand, NoParticleIsRefused) {
  const std::string text = kCase;
  expect_refusal(run(put_case(text.substr(0, text.find("[particles]"))), out()),
                 ErrorKind::kBadInput, Names("[particles]"));
}

TEST_F(ParticlesCommand, ReplacesNothingThatItDidNotWrite) {
  const auto file = put_case(kCase);
  fs::create_directory(out());
  for (const auto* name : {"steps.csv", "particles.svg", "particles_00000.vtp"}) {
    put_text(out() / name, "my notes\n");
    expect_refusal(run(file, out()), ErrorKind::kBadInput, Names(name));
    EXPECT_EQ(read_file(out() / name), "my notes\n");
    fs::remove(out() / name);
  }
}

TEST_F(ParticlesCommand, FolderIntoWhichAnotherWritesIsRefused) {
  const auto file = put_case(kCase);
  const LockedFolder lock(out(), "");
  expect_refusal(run(file, out()), ErrorKind::kBadInput, Names(out().string()));
}

}  // namespace
}  // namespace viscontact
