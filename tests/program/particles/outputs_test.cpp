// What `viscontact particles` writes, and when it writes it again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/particles/io/particle_file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
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
              ::testing::ContainsRegex("2,-1,[^,]*,-2,[^,]*\n"));
}

/// What VTK reads, by name.
std::map<std::string, std::vector<double>> read_by_vtk(const fs::path& file) {
  // Debian's python3, for which python3-vtk9 is.
  const std::string command = "/usr/bin/python3 " VISCONTACT_SOURCE_FOLDER
                              "/tests/program/particles/read_vtk.py " +
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
  // Vertices of the three on the floor, then the line between those that touch; as in
  // final_contacts.csv.
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

TEST_F(ParticlesCommand, PrintsItsRecordAsJson) {
  const auto result = run(put_case(kCase), out(), {"--json"});
  expect_done(result);
  EXPECT_EQ(nlohmann::json::parse(result.output)["steps"], 200);
}

TEST_F(ParticlesCommand, PictureOfATitleThatNoXmlMayHoldIsWellFormed) {
  expect_done(run(put_case(replaced(kCase, "Three discs", "Three\\u0001 <discs>")), out()));
  EXPECT_THAT(read_file(out() / "particles.svg"), HasSubstr("Three\uFFFD &lt;discs&gt;"));
}

}  // namespace
}  // namespace viscontact
