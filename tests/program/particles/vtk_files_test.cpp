// VTK, and so ParaView, reads the frames that `viscontact particles` writes, with the numbers of
// the other results.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "tests/program/particles/particles_command.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

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
  // Vertices of the three on the floor, then the lines between those that came off in the last
  // step, and between those that touch; as in final_contacts.csv.
  EXPECT_EQ(frame.at("vtkVertex"), (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(frame.at("vtkLine"), (std::vector<double>{0, 1, 0, 2}));
  EXPECT_EQ(frame.at("i"), (std::vector<double>{0, 1, 2, 0, 0}));
  EXPECT_EQ(frame.at("j"), (std::vector<double>{-1, -1, -1, 1, 2}));
  EXPECT_EQ(frame.at("gamma").size(), 5U);
  EXPECT_EQ(frame.at("gap").size(), 5U);
  const auto series = read_file(out() / "particles.pvd");
  EXPECT_THAT(series, AllOf(HasSubstr("timestep=\"0\""), HasSubstr("timestep=\"10\""),
                            HasSubstr("file=\"particles_00020.vtp\"")));
}

// Two discs of a body on a hinge, and a disc on an arm between them and a fixed place of another.
TEST_F(ParticlesCommand, VtkReadsBodiesFrictionAndLinks) {
  expect_done(run(put_case(R"(title = "A body that hangs"
[space]
dimension = 2
gravity = [0.0, -1.0]
[viscous_contact]
time_step = 0.01
end_time = 0.1
gamma_min = 0.0
[friction]
coefficient = 0.5
[[plane]]
point = [0.0, -1.0]
normal = [0.0, 1.0]
)" + disc("0.0, 5.0", "1.0", "1.0") +
                           disc("0.0, 3.0", "1.0", "3.0") +
                           disc("3.0, 0.0", "1.0", "1.0", "velocity = [1.0, 0.0]\n") +
                           disc("9.0, 0.0", "1.0", "1.0") + R"([[body]]
particles = [0, 1]
[[hinge]]
body = 0
at = [0.0, 5.5]
[[arm]]
between = [2, 3]
length = 6.0
)"),
                  out()));
  const auto frame = read_by_vtk(out() / "particles_00010.vtp");
  EXPECT_EQ(frame.at("body"), (std::vector<double>{0, 0, -1, -1}));
  EXPECT_EQ(frame.at("angle").size(), 4U);
  // Both discs on the floor slide: they start without spin.
  EXPECT_EQ(frame.at("friction"), (std::vector<double>{2, 2}));
  const auto links = read_by_vtk(out() / "links_00010.vtp");
  EXPECT_EQ(links.at("kind"), (std::vector<double>{0, 2}));
  EXPECT_EQ(links.at("id"), (std::vector<double>{0, 0}));
  const auto& force = links.at("force");
  ASSERT_EQ(force.size(), 6U);
  EXPECT_NEAR(force[1], 4, 1e-9);  // the weight of the body
  // Friction is the same on both ends of the arm, which go on together after the first step.
  EXPECT_NEAR(force[3], 0, 1e-9);
  EXPECT_EQ(links.at("points").size(), 9U);
}

// One disc that is driven along x in a round container.
TEST_F(ParticlesCommand, VtkReadsTheFlow) {
  expect_done(run(put_case(R"(title = "A driven disc"
[space]
dimension = 2
[viscous_contact]
time_step = 0.1
end_time = 0.1
[fluid]
viscosity = 1.0
edges_per_particle = 12
[domain]
disc = { radius = 4.0 }
[[particle]]
centre = [0.0, 0.0]
radius = 1.0
mass = 0.0
velocity_given = { value = [1.0, 0.0] }
)"),
                  out()));
  const auto flow = read_flow(out() / "flow_00000.vtu");
  const auto read = read_by_vtk(out() / "flow_00000.vtu");
  const auto nodes = flow.x.size();
  ASSERT_EQ(read.at("points").size(), 3 * nodes);
  std::size_t on_disc = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    EXPECT_EQ(read.at("points")[3 * k], flow.x[k]);
    EXPECT_EQ(read.at("points")[3 * k + 1], flow.y[k]);
    EXPECT_EQ(read.at("velocity")[3 * k], flow.velocity_x[k]);
    EXPECT_EQ(read.at("velocity")[3 * k + 1], flow.velocity_y[k]);
    EXPECT_EQ(read.at("pressure")[k], flow.pressure[k]);
    if (std::hypot(flow.x[k], flow.y[k]) > 1.001) continue;
    ++on_disc;
    EXPECT_NEAR(read.at("velocity")[3 * k], 1, 1e-12);
  }
  EXPECT_GE(on_disc, 12U);
  EXPECT_EQ(read.at("vtkQuadraticTriangle").size(), 6 * flow.triangles.size());
  // The domain is covered once. VTK measures each triangle by four straight ones, which leave out
  // 0.04 at the wall; without the disc the area would be smaller by pi.
  double area = 0;
  for (const double part : read.at("areas")) area += part;
  EXPECT_NEAR(area, 16 * std::acos(-1.0), 0.1);
}

}  // namespace
}  // namespace viscontact
