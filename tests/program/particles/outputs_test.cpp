// What `viscontact particles` writes, and when it writes it again.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
              ::testing::ContainsRegex("2,-1,[^,]*,-2,[^,]*,[^,]*,0,0\n"));
}

TEST_F(ParticlesCommand, ShowsAnEllipseAndTheDiscsThatASourceAdds) {
  expect_done(run(put_case(R"(title = "An ellipse and a source"
[space]
dimension = 2
[viscous_contact]
time_step = 0.1
end_time = 1.0
gamma_min = 0.0
[[particle]]
centre = [0.0, 0.0]
semi_axes = [1.0, 0.5]
angle = 0.5
mass = 1.0
[[source]]
radius = 0.3
mass = 1.0
rate = 2.0
region = { from = [5.0, 0.0], to = [9.0, 4.0] }
)"),
                  out()));
  // The names, the ellipse, and the discs of the times 0, 0.5 and 1.
  const auto table = content(out() / "final_particles.csv");
  EXPECT_THAT(table, HasSubstr("semi_axis_1,semi_axis_2"));
  EXPECT_EQ(std::ranges::count(table, '\n'), 5);
  const auto page = content(out() / "particles.html");
  EXPECT_THAT(page, HasSubstr("semiAxes"));
  EXPECT_THAT(page, HasSubstr("1 ellipse, 3 discs, t = 0"));
}

TEST_F(ParticlesCommand, WritesNoMessageIntoItsFilesIfItHasNoStandardStreams) {
  const std::vector<std::string> arguments = {"particles", put_case(kCase).string(), "-o",
                                              out().string()};
  expect_done(run_viscontact(arguments, {}, "exec <&- >&- 2>&-;"));
  for (const auto* name : {"steps.csv", "final_particles.csv", "final_contacts.csv"})
    EXPECT_THAT(read_file(out() / name), ::testing::StartsWith("# provenance: ")) << name;
}

TEST_F(ParticlesCommand, WarnsThatItsPagesCannotHaveLengthsBeyondSinglePrecision) {
  const auto text =
      "title = \"t\"\n[space]\ndimension = 2\n[viscous_contact]\ntime_step = 0.1\n"
      "end_time = 0.2\ngamma_min = 0.0\n[[particle]]\ncentre = [0.0, 0.0]\nmass = 1.0\n"
      "radius = ";
  for (const auto& [radius, is_shown] : {std::pair("1e38", true), std::pair("1e39", false)}) {
    const auto result = run(put_case(std::string(text) + radius + "\n"), out());
    expect_done(result);
    EXPECT_EQ(result.errors.find("show nothing, because a radius") == std::string::npos, is_shown);
  }
}

TEST_F(ParticlesCommand, PictureOfASceneFarFromTheOriginIsThatOfTheSceneAtIt) {
  const auto text = [](double x, double y) {
    return fmt::format(
        "title = \"t\"\n[space]\ndimension = 2\n[viscous_contact]\ntime_step = 0.1\n"
        "end_time = 0.2\ngamma_min = 0.0\n[[plane]]\npoint = [{0:.1f}, {2:.1f}]\n"
        "normal = [0.0, 1.0]\n[[particle]]\ncentre = [{0:.1f}, {1:.1f}]\nmass = 1.0\n"
        "radius = 1.0\nvelocity = [0.0, -1.0]\n[[particle]]\ncentre = [{3:.1f}, {1:.1f}]\n"
        "mass = 1.0\nradius = 1.0\n",
        x, y, y - 4, x + 3);
  };
  expect_done(run(put_case(text(0, 0)), out("near")));
  // Single precision has errors of 8 there.
  expect_done(run(put_case(text(-134217728, 134217728)), out("far")));
  EXPECT_EQ(rest_of(out("far") / "particles.svg"), rest_of(out("near") / "particles.svg"));
  EXPECT_THAT(read_file(out("far") / "particles.html"),
              HasSubstr("Places are relative to (-134217728, 134217728)"));
}

TEST_F(ParticlesCommand, FramesOfALongerRunDoNotStay) {
  expect_done(run(put_case(kCase), out()));
  put_text(out() / "particles_mine.vtp", "a user's own");
  expect_done(run(put_case(replaced(kCase, "every = 0.5", "every = 5.0")), out()));
  EXPECT_FALSE(fs::exists(out() / "particles_00003.vtp"));
  EXPECT_TRUE(fs::exists(out() / "particles_00002.vtp"));
  EXPECT_TRUE(fs::exists(out() / "particles_mine.vtp"));
}

TEST_F(ParticlesCommand, FramesMoreOftenThanStepsAreFramesOfEachStep) {
  expect_done(run(put_case(replaced(replaced(kCase, "every = 0.5", "every = 1e-9"),
                                    "end_time = 10.0", "end_time = 1.0")),
                  out()));
  EXPECT_TRUE(fs::exists(out() / "particles_00020.vtp"));
  EXPECT_FALSE(fs::exists(out() / "particles_00021.vtp"));
}

/// Discs without friction: steps without contact run no stage, all others gradients or Newton's
/// method.
TEST_F(ParticlesCommand, WritesTheStagesOfTheSolverOnRequest) {
  expect_done(run(
      put_case(replaced(kCase, "every = 0.5", "every = 0.5\nstep_columns = [\"solver_stages\"]")),
      out()));
  std::istringstream rows(read_file(out() / "steps.csv"));
  int solved = 0, empty = 0;
  for (std::string row; std::getline(rows, row);) {
    if (row.starts_with('#')) continue;
    const auto last = row.substr(row.rfind(',') + 1);
    if (row.starts_with("step,")) {
      EXPECT_EQ(last, "solver_stages");
    } else if (last.empty()) {
      ++empty;
    } else {
      ++solved;
      EXPECT_TRUE(last.starts_with("gradients:") || last.starts_with("newton:")) << row;
    }
  }
  EXPECT_EQ(solved + empty, 200);
  EXPECT_GT(solved, 0);
}

TEST_F(ParticlesCommand, PrintsItsRecordAsJson) {
  const auto result = run(put_case(kCase), out(), {"--json"});
  expect_done(result);
  EXPECT_EQ(nlohmann::json::parse(result.output)["steps"], 200);
}

TEST_F(ParticlesCommand, PictureOfATitleThatNoXmlMayHoldIsWellFormed) {
  expect_done(run(put_case(replaced(kCase, "Three discs", "Three\\u0001 <discs>")), out()));
  EXPECT_THAT(read_file(out() / "particles.svg"), HasSubstr("Three\uFFFD &lt;discs&gt;"));
}

/// A disc between two others on arms, of which one moves away from the time 1 on. No motion keeps
/// both arms then.
TEST_F(ParticlesCommand, KeepsAllStepsIfTheNextOneAfterTheEndHasNoSolution) {
  const auto text = [](const std::string& end) {
    return R"(title = "Arms that part"
[space]
dimension = 2
[fluid]
viscosity = 1.0
solver = ["python3", ")" VISCONTACT_SOURCE_FOLDER R"(/examples/stokes_drag.py"]
[domain]
disc = { radius = 8.0 }
[viscous_contact]
time_step = 0.1
end_time = )" +
           end + R"(
[output]
every = 0.1
[[particle]]
centre = [-3.0, 0.0]
radius = 1.0
velocity_given = { value = [0.0, 0.0] }
[[particle]]
centre = [3.0, 0.0]
radius = 1.0
velocity_given = { value = [ { until = 1.0, value = [0.0, 0.0] }, { until = 3.0, value = [1.0, 0.0] } ] }
[[particle]]
centre = [0.0, 0.0]
radius = 1.0
[[arm]]
between = [0, 2]
length = 3.0
[[arm]]
between = [1, 2]
length = 3.0
)";
  };
  const auto at_end = run(put_case(text("1.0")), out());
  expect_done(at_end);
  EXPECT_THAT(at_end.errors, Names("warning", "flow"));
  EXPECT_EQ(column("steps.csv", "step").size(), 10U);
  EXPECT_TRUE(fs::exists(out() / "particles.html"));
  EXPECT_EQ(nlohmann::json::parse(read_file(out() / "run.json"))["steps"], 10);

  const auto later = run(put_case(text("1.5")), out());
  EXPECT_EQ(later.exit_status, 4);
  EXPECT_EQ(column("steps.csv", "step").size(), 10U);
}

/// A disc in the corner of a wall and a floor that moves towards it. With mu_s > 1 friction locks
/// the disc between both, so that Coulomb's law has no solution.
TEST_F(ParticlesCommand, SaysHowManyStepsInAFluidHadGivenLoads) {
  const auto result = run(put_case(R"(title = "A disc that jams"
[space]
dimension = 2
[fluid]
viscosity = 1.0
threshold_gap = 0.05
velocity = { bottom = [1.0, 0.0] }
solver = ["python3", ")" VISCONTACT_SOURCE_FOLDER R"(/examples/stokes_drag.py"]
[domain]
box = { from = [-4.0, 0.0], to = [4.0, 7.0] }
[viscous_contact]
gamma_min = 0.0
time_step = 0.1
end_time = 0.5
[friction]
coefficient = 1.5
[[particle]]
centre = [2.95, 1.05]
radius = 1.0
force = [1.0, -5.0]
)"),
                          out());
  EXPECT_EQ(result.exit_status, 4);
  EXPECT_THAT(result.errors, Names("5 of 5", "gaps", "friction"));
  EXPECT_EQ(nlohmann::json::parse(read_file(out() / "run.json"))["steps_with_given_loads"], 5);
}

}  // namespace
}  // namespace viscontact
