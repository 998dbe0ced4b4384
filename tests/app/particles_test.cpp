// viscontact particles as its users meet it: what it writes, what it refuses, and how it goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <ostream>
#include <regex>
#include <sstream>

#include "tests/app/program.hpp"
#include "tests/app/sample_files.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locked_folder.hpp"
#include "viscontact/particles/io/particle_file.hpp"
#include "viscontact/particles/io/restart.hpp"
#include "viscontact/results/exit_code.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The example of docs/case-file.md: three discs on a floor, two of them in a file, the last pushed and pulled.
constexpr const char* kCase = R"(title = "Three discs on a floor"

[space]
dimension = 2
gravity = [0.0, -1.0]

[viscous_contact]
time_step = 0.05
end_time = 10.0
gamma_min = -2.0

[solver]
tolerance = 1e-6
max_iterations = 10000

[output]
every = 0.5

[[plane]]
point = [0.0, 0.0]
normal = [0.0, 1.0]

[particles]
file = "discs.csv"

[[particle]]
centre = [0.0, 2.0]
radius = 1.0
mass = 1.0
velocity = [0.0, 0.0]
force = [ { until = 5.0, value = [0.7, -0.7] }, { until = 10.0, value = [-0.7, 0.7] } ]
)";
constexpr const char* kDiscs = "x,y,vx,vy,radius,mass\n3,1,0,0,1,1\n6.5,4,0,-1,0.5,0.25\n";

class ParticlesCommand : public ::testing::Test {
 protected:
  ParticlesCommand() { folder_.file("discs.csv", kDiscs); }
  fs::path put_case(const std::string& text, const std::string& name = "case.toml") const {
    return folder_.file(name, text);
  }
  fs::path out(const std::string& name = "out") const { return folder_.path() / name; }
  static ProgramResult run(const fs::path& file, const fs::path& out,
                           std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"particles", file.string(), "-o", out.string()});
    return run_viscontact(more);
  }
  /// Lines of a text that are no comments.
  static std::string content(const fs::path& file) {
    return std::regex_replace(read_file(file), std::regex("#[^\n]*\n"), "");
  }
  TemporaryFolder folder_;
};

TEST_F(ParticlesCommand, WritesWhatTheInterfacePromises) {
  expect_done(run(put_case(kCase), out()));
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(out())) names.push_back(entry.path().filename());
  std::vector<std::string> expected = {
      "particles.pvd",      "particles.html", "particles.svg", "final_particles.csv",
      "final_contacts.csv", "steps.csv",      "restart.bin",   "run.json"};
  for (int frame = 0; frame <= 20; ++frame)
    expected.push_back("particles_000" + std::string(frame < 10 ? "0" : "") +
                       std::to_string(frame) + ".vtp");
  EXPECT_THAT(names, ::testing::UnorderedElementsAreArray(expected));

  const auto record = nlohmann::json::parse(read_file(out() / "run.json"));
  EXPECT_EQ(record["steps"], 200);
  EXPECT_EQ(record["unconverged_steps"], 0);
  EXPECT_LE(record["largest_residual"], 1e-6);
  EXPECT_LE(record["final_overlap"], 1e-6);
  EXPECT_GT(record["peak_memory_mebibytes"], 1);
  EXPECT_TRUE(record.contains("provenance"));

  const auto end = particles::read_particles(out() / "final_particles.csv", 2).particles;
  ASSERT_EQ(end.count(), 3U);
  EXPECT_THAT(end.radii, ElementsAre(1, 0.5, 1));  // the file's, then the table's
  // All lie on the floor, as well as the tolerance says.
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(end.position(k)[1], end.radii[k], 1e-6);
  EXPECT_THAT(content(out() / "final_contacts.csv"), HasSubstr("0,-1,"));
  // Glued since they fell: gravity and push have given the floor all that it remembers.
  EXPECT_THAT(content(out() / "final_contacts.csv"),
              ::testing::ContainsRegex("2,-1,[^,]*,-2,[^,]*\n"));
}

/// What VTK reads, by name.
std::map<std::string, std::vector<double>> read_by_vtk(const fs::path& file) {
  // Debian's python3, for which python3-vtk9 is.
  const std::string command = "/usr/bin/python3 " VISCONTACT_SOURCE_FOLDER
                              "/tests/app/read_vtk.py " +
                              file.string() + " > " + file.string() + ".txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << read_file(file.string() + ".txt");
  std::map<std::string, std::vector<double>> read;
  std::istringstream lines(read_file(file.string() + ".txt"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, kind;
    words >> name;
    if (name == "cell") {
      words >> kind;
      name = kind;
    }
    auto& values = read[name];
    for (double value = 0; words >> value;) values.push_back(value);
  }
  return read;
}

TEST_F(ParticlesCommand, VtkReadsTheFrames) {
  expect_done(run(put_case(kCase), out()));
  const auto end = particles::read_particles(out() / "final_particles.csv", 2).particles;
  const auto frame = read_by_vtk(out() / "particles_00020.vtp");
  EXPECT_EQ(frame.at("radius"), end.radii);
  EXPECT_EQ(frame.at("id"), (std::vector<double>{0, 1, 2}));
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_EQ(frame.at("points")[3 * k + d], end.position(k)[d]);
      EXPECT_EQ(frame.at("velocity")[3 * k + d], end.velocity(k)[d]);
    }
  // Vertices of the three on the floor, then the line between those that touch; as in final_contacts.csv.
  EXPECT_EQ(frame.at("vtkVertex"), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(frame.at("vtkLine"), (std::vector<double>{0, 2}));
  EXPECT_EQ(frame.at("i"), (std::vector<double>{0, 1, 2, 0}));
  EXPECT_EQ(frame.at("j"), (std::vector<double>{-1, -1, -1, 2}));
  EXPECT_EQ(frame.at("gamma").size(), 4U);
  EXPECT_EQ(frame.at("gap").size(), 4U);
  const auto series = read_file(out() / "particles.pvd");
  EXPECT_THAT(series, AllOf(HasSubstr("timestep=\"0\""), HasSubstr("timestep=\"10\""),
                            HasSubstr("file=\"particles_00020.vtp\"")));
}

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

TEST_F(ParticlesCommand, ARestartDoesNotReplaceTheRunThatItContinues) {
  expect_done(run(put_case(replaced(kCase, "end_time = 10.0", "end_time = 4.35")), out()));
  const auto before = files_below(out());
  expect_refusal(run(put_case(kCase), out(), {"--restart", (out() / "restart.bin").string()}),
                 ErrorKind::kBadInput, HasSubstr("choose another folder"));
  EXPECT_EQ(files_below(out()), before);
}

class InterruptedParticles : public ParticlesCommand,
                             public ::testing::WithParamInterface<std::string> {};

TEST_P(InterruptedParticles, KeepWhatTheyHaveAndARestartGoesOn) {
  // Long enough that the signal comes in the middle of it: a hundred million steps are minutes.
  const auto endless =
      put_case(replaced(replaced(replaced(kCase, "time_step = 0.05", "time_step = 1e-7"),
                                 "every = 0.5", "every = 1e-5"),
                        "tolerance = 1e-6", "tolerance = 1e-3"),
               "long.toml");
  const auto result = run_viscontact({"particles", endless.string(), "-o", out().string()}, {},
                                     "(sleep 1; kill -" + GetParam() + " $$) &");
  EXPECT_EQ(result.exit_status, exit_code_of(ErrorKind::kInterrupted)) << result.errors;
  EXPECT_THAT(result.errors, HasSubstr("goes on"));
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
INSTANTIATE_TEST_SUITE_P(Signals, InterruptedParticles, ::testing::Values("INT", "HUP"),
                         [](const auto& test) { return test.param; });

TEST_F(ParticlesCommand, ARestartIsOfTheSameParticles) {
  expect_done(run(put_case(kCase), out()));
  const auto restart = (out() / "restart.bin").string();
  const auto longer = replaced(replaced(kCase, "end_time = 10.0", "end_time = 11.0"),
                               "until = 10.0", "until = 11.0");
  const auto refused = [&](const std::string& text, const std::string& said,
                           const std::string& file) {
    expect_refusal(run(put_case(text, "other.toml"), out("no"), {"--restart", file}),
                   ErrorKind::kBadInput, HasSubstr(said));
    EXPECT_FALSE(fs::exists(out("no")));
  };
  refused(kCase, "nothing is left to do", restart);
  refused(replaced(longer, "\nmass = 1.0", "\nmass = 2.0"), "other masses", restart);
  refused(replaced(longer, "radius = 1.0", "radius = 1.01"), "other radii", restart);
  refused(replaced(longer, "[particles]\nfile = \"discs.csv\"\n", ""), "3, not 1", restart);
  refused(replaced(longer, "[[plane]]\npoint = [0.0, 0.0]\nnormal = [0.0, 1.0]\n", ""),
          "at plane 1, which is not there", restart);
  refused(longer, "is not a restart file", (folder_.path() / "discs.csv").string());
  auto bytes = read_file(restart);
  refused(longer, "cut short",
          folder_.file("half.bin", bytes.substr(0, bytes.size() - 100)).string());
  bytes[bytes.size() - 50] = static_cast<char>(bytes[bytes.size() - 50] + 1);
  refused(longer, "cut short", folder_.file("bit.bin", bytes).string());
}

TEST_F(ParticlesCommand, StepsThatDoNotConvergeAreReportedAndAllIsWritten) {
  // A stack of five on the floor needs more than an iteration.
  std::string text = replaced(kCase, "max_iterations = 10000", "max_iterations = 1");
  for (int k = 1; k < 5; ++k)
    text += "\n[[particle]]\ncentre = [0.3, " + std::to_string(2 + 2.2 * k) +
            "]\nradius = 1.0\nmass = 1.0\n";
  const auto result = run(put_case(text), out());
  expect_refusal(result, ErrorKind::kNotConverged, HasSubstr("All results are written"));
  EXPECT_THAT(result.errors, HasSubstr("warning"));
  const auto record = nlohmann::json::parse(read_file(out() / "run.json"));
  EXPECT_GT(record["unconverged_steps"], 0);
  EXPECT_GT(record["largest_residual"], 1e-6);
  EXPECT_THAT(read_file(out() / "steps.csv"), ::testing::ContainsRegex(",0\n"));
  EXPECT_TRUE(fs::exists(out() / "particles.html"));
}

TEST_F(ParticlesCommand, FramesOfALongerRunDoNotStay) {
  expect_done(run(put_case(kCase), out()));
  put_text(out() / "particles_mine.vtp", "a user's own");
  expect_done(run(put_case(replaced(kCase, "every = 0.5", "every = 5.0")), out()));
  EXPECT_FALSE(fs::exists(out() / "particles_00003.vtp"));
  EXPECT_TRUE(fs::exists(out() / "particles_00002.vtp"));
  EXPECT_TRUE(fs::exists(out() / "particles_mine.vtp"));
}

TEST_F(ParticlesCommand, RerunMakesTheSameAgain) {
  expect_done(run(put_case(kCase), out()));
  expect_done(run_viscontact(
      {"rerun", (out() / "particles_00007.vtp").string(), "-o", out("again").string()}));
  for (const auto* file : {"final_particles.csv", "final_contacts.csv"})
    EXPECT_EQ(content(out() / file), content(out("again") / file));
}

TEST_F(ParticlesCommand, ForcesByNumberAndTurningPlanesAndSpheres) {
  const auto file = put_case(R"(title = "A sphere in a corner that turns"
[space]
dimension = 3
gravity = [0.0, 0.0, -1.0]
[viscous_contact]
time_step = 0.01
end_time = 1.0
viscosity = 0.1
roughness = 1e-3
[[plane]]
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 2.0]
angular_velocity = [0.0, 0.1, 0.0]
pivot = [0.0, 0.0, 0.0]
[[particle]]
centre = [0.0, 0.0, 1.0]
radius = 1.0
mass = 2.0
[[force]]
particles = [0]
value = [0.0, 1.0, 0.0]
)");
  expect_done(run(file, out()));
  const auto end = particles::read_particles(out() / "final_particles.csv", 3).particles;
  // 1/2 mean to the end of each step: h = 0.01 adds a half of h.
  EXPECT_NEAR(end.position(0)[1], 0.5 * 1.0 / 2 * (1 + 0.01), 1e-12);
  EXPECT_NEAR(end.velocity(0)[1], 0.5, 1e-12);
  // It slides down the plane that has turned by 0.1, and stays on it.
  EXPECT_GT(end.position(0)[0], 0);
  EXPECT_NEAR(end.position(0)[0] * std::sin(0.1) + end.position(0)[2] * std::cos(0.1), 1, 1e-6);
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
  expect_refusal(run(file, out()), ErrorKind::kBadInput, HasSubstr(bad.said));
  EXPECT_FALSE(fs::exists(out()));
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadParticlesCase,
    ::testing::ValuesIn(std::vector<BadParticles>{
        {"NanInTheFile", "3,1,", "nan,1,", "discs.csv:2: x is not a finite number"},
        {"InfinityInTheFile", "3,1,", "3,inf,", "discs.csv:2: y is not a finite number"},
        {"ZeroMassInTheFile", "0.5,0.25", "0.5,0", "discs.csv:3: mass is 0; it must be > 0"},
        {"NegativeRadiusInTheFile", "0.5,0.25", "-0.5,0.25", "discs.csv:3: radius is -0.5"},
        {"HugePosition", "3,1,", "3e200,1,", "discs.csv:2: x is 3e+200"},
        {"NoColumn", "radius,mass", "radius,weight", "column 'mass' is missing"},
        {"ThirdDimension", "x,y,vx,vy,radius,mass\n3,1,0,0,1,1\n6.5,4,0,-1,0.5,0.25",
         "x,y,z,vx,vy,vz,radius,mass\n3,1,0,0,0,0,1,1",
         "discs.csv:2: has a value in a column of the third dimension"},
        {"Overlap", "6.5,4,0", "3.5,2,0", "overlap by"},
        {"Twice", "6.5,4,0", "3,1,0", "discs.csv:3: particle 0"},
        {"BehindThePlane", "6.5,4,0", "6.5,-4,0", "plane 1"},
        {"InThePlane", "6.5,4,0", "6.5,0.4,0", "discs.csv:3: particle 1"},
        {"OtherDimension", "dimension = 2", "dimension = 3",
         "contains 2 numbers; it must contain 3"},
        {"NoDimension", "dimension = 2", "dimension = 4", "from 2 to 3"},
        {"NoNormal", "normal = [0.0, 1.0]", "normal = [0.0, 0.0]",
         "it must be a vector that points into the free side"},
        {"LongStep", "time_step = 0.05", "time_step = 50", "must be at most end_time"},
        {"ManySteps", "time_step = 0.05", "time_step = 1e-12", "at most 1e+09 are allowed"},
        {"PositiveGamma", "gamma_min = -2.0", "gamma_min = 2.0", "must be a number <= 0"},
        {"BothLaws", "gamma_min = -2.0", "gamma_min = -2.0\nviscosity = 1.0\nroughness = 0.1",
         "must be left out where gamma_min is given"},
        {"ViscosityAlone", "gamma_min = -2.0", "viscosity = 1.0",
         "roughness is missing; a case with a viscosity needs both"},
        {"ForceEndsEarly", "until = 10.0", "until = 9.0", "ends at 9; it must reach"},
        {"ForceBackwards", "until = 10.0", "until = 4.0", "where the piece before ends"},
        {"ForceOfThreeNumbers", "value = [0.7, -0.7]", "value = [0.7, -0.7, 0]",
         "contains 3 numbers; it must contain 2"},
        {"ZeroMass", "\nmass = 1.0", "\nmass = 0.0", "case.toml"},
        {"Tolerance", "tolerance = 1e-6", "tolerance = 1e-20", "between 1e-12 and 0.1"},
        {"Method", "tolerance = 1e-6", "method = \"magic\"", "must be one of"},
        {"TinyInterval", "every = 0.5", "every = 1e-300", "output.every"},
        {"MisspeltVelocity", "x,y,vx,vy,", "x,y,Vx,Vy,", "has a column 'Vx'"},
        {"HalfAVelocity", "x,y,vx,vy,radius,mass\n3,1,0,0,1,1\n6.5,4,0,-1,0.5,0.25",
         "x,y,vx,radius,mass\n3,1,0,1,1", "has some of the columns vx, vy, vz"},
        {"TooSmallForTheTolerance", "0.5,0.25", "1e-6,0.25", "too small for solver.tolerance"},
        {"TooFar", "6.5,4,0", "6.5,4e12,0", "too far from the origin"},
        {"DenormalMass", "0.5,0.25", "0.5,1e-310", "at least 1e-100"},
        {"PieceThatIsNone",
         "force = [ { until = 5.0, value = [0.7, -0.7] }, { until = 10.0, value = [-0.7, 0.7] } ]",
         "force = { until = 10.0, value = [0.0, 0.0] }", "a list of pieces"},
        {"PivotOfNothing", "normal = [0.0, 1.0]", "normal = [0.0, 1.0]\npivot = [0.0, 0.0]",
         "must be left out, because this plane has no angular_velocity"},
        {"UnknownKey", "every = 0.5", "evry = 0.5", "every"},
        {"NoFile", "file = \"discs.csv\"", "file = \"discs\"", "discs"},
        {"ForceOnNobody", "[output]", "[[force]]\nparticles = [3]\nvalue = [0.0, 0.0]\n[output]",
         "the particles are numbered from 0 to 2"},
        {"ForceTwice", "[output]", "[[force]]\nparticles = [2]\nvalue = [0.0, 0.0]\n[output]",
         "a second time; each particle must have one force"},
    }),
    [](const auto& test) { return test.param.name; });

TEST_F(ParticlesCommand, BlankLinesAtTheEndOfTheFileAreNoParticles) {
  folder_.file("discs.csv", std::string(kDiscs) + "\n,,,,,\n\n");
  expect_done(run(put_case(kCase), out()));
  EXPECT_EQ(particles::read_particles(out() / "final_particles.csv", 2).particles.count(), 3U);
}

TEST_F(ParticlesCommand, FramesMoreOftenThanStepsAreFramesOfEachStep) {
  expect_done(run(put_case(replaced(replaced(kCase, "every = 0.5", "every = 1e-9"),
                                    "end_time = 10.0", "end_time = 1.0")),
                  out()));
  EXPECT_TRUE(fs::exists(out() / "particles_00020.vtp"));
  EXPECT_FALSE(fs::exists(out() / "particles_00021.vtp"));
}

TEST_F(ParticlesCommand, AStepThatCannotBeComputedLeavesWhatWasBefore) {
  const auto result =
      run(put_case(replaced(kCase, "value = [-0.7, 0.7]", "value = [-1e90, 0.7]")), out());
  expect_refusal(result, ErrorKind::kNotConverged, HasSubstr("beyond what can be computed with"));
  EXPECT_EQ(nlohmann::json::parse(read_file(out() / "run.json"))["to_time"], 5.0);
  EXPECT_DOUBLE_EQ(particles::read_restart(out() / "restart.bin").time, 5.0);
}

TEST_F(ParticlesCommand, WallsThatMeetEndTheRunAndKeepWhatWasBefore) {
  // The ceiling comes down at 1 on discs of height 4 to 5, and stands still if the case says so.
  const auto with_ceiling = [&](const std::string& velocity) {
    return kCase + ("[[plane]]\npoint = [0.0, 6.0]\nnormal = [0.0, -1.0]\nvelocity = " + velocity);
  };
  const auto result = run(put_case(with_ceiling("[0.0, -1.0]\n")), out());
  expect_refusal(result, ErrorKind::kNotConverged, AllOf(HasSubstr("plane"), HasSubstr("overlap")));
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
  expect_refusal(run(file, folder_.path()), ErrorKind::kBadInput, HasSubstr("overwritten"));
  EXPECT_EQ(read_file(folder_.path() / "final_particles.csv"), kDiscs);
}

TEST_F(ParticlesCommand, NoParticleIsRefused) {
  const std::string text = kCase;
  expect_refusal(run(put_case(text.substr(0, text.find("[particles]"))), out()),
                 ErrorKind::kBadInput, HasSubstr("has no particle"));
}

TEST_F(ParticlesCommand, PrintsItsRecordAsJson) {
  const auto result = run(put_case(kCase), out(), {"--json"});
  expect_done(result);
  EXPECT_EQ(nlohmann::json::parse(result.output)["steps"], 200);
}

TEST_F(ParticlesCommand, FilesOfTheResultAreInputsAgain) {
  expect_done(run(put_case(kCase), out()));
  const auto file = put_case(replaced(kCase, "\"discs.csv\"", "\"out/final_particles.csv\""));
  const std::string text = read_file(file);
  expect_done(run(put_case(text.substr(0, text.find("[[particle]]"))), out("second")));
}

TEST_F(ParticlesCommand, ReplacesNothingThatItDidNotWrite) {
  const auto file = put_case(kCase);
  fs::create_directory(out());
  for (const auto* name : {"steps.csv", "particles.svg", "particles_00000.vtp"}) {
    put_text(out() / name, "my notes\n");
    expect_refusal(run(file, out()), ErrorKind::kBadInput,
                   AllOf(HasSubstr(name), HasSubstr("remove it first")));
    EXPECT_EQ(read_file(out() / name), "my notes\n");
    fs::remove(out() / name);
  }
}

TEST_F(ParticlesCommand, FolderIntoWhichAnotherWritesIsRefused) {
  const auto file = put_case(kCase);
  const LockedFolder ours(out(), "");
  expect_refusal(run(file, out()), ErrorKind::kBadInput,
                 HasSubstr("another viscontact writes into it"));
}

TEST_F(ParticlesCommand, PictureOfATitleThatNoXmlMayHoldIsWellFormed) {
  expect_done(run(put_case(replaced(kCase, "Three discs", "Three\\u0001 <discs>")), out()));
  EXPECT_THAT(read_file(out() / "particles.svg"), HasSubstr("Three\uFFFD &lt;discs&gt;"));
}

}  // namespace
}  // namespace viscontact
