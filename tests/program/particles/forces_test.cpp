// Forces by number, moving planes, and the forms of a case that `viscontact particles` accepts.
#include <gmock/gmock.h>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/program.hpp"
#include "tests/program/sample_files.hpp"
#include "tests/program/undisturbed.hpp"
#include "viscontact/particle_runs/io/particle_file.hpp"

namespace viscontact {
namespace {

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

}  // namespace
}  // namespace viscontact
