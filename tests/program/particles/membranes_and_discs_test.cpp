// Rigid discs beside membranes in a fluid, computed with FreeFEM: a closed form, invariances, and
// contact.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "tests/program/particles/particles_command.hpp"

namespace viscontact {
namespace {

class MembranesAndDiscs : public ParticlesCommand {
 protected:
  /// The value of a column of a table in its last row but `before`.
  double last(const std::string& table, const std::string& name, std::size_t before = 0) const {
    const auto values = column(table, name);
    return values[values.size() - 1 - before];
  }
};

// A disc of radius a turns in the middle of a round vesicle of radius 1, whose fluid is five times
// as viscous, in a vessel of radius W. The membrane turns like a solid at the rate w, and the
// torque is the same on all circles:
//     T = 4 pi mu 5 (1 - w)/(1/a^2 - 1) = 4 pi mu w/(1 - 1/W^2).
// A reduced area of 0.999 has waves of the height 0.026 on the circle, which change both by the
// square of it.
TEST_F(MembranesAndDiscs, ADiscTurnsARoundVesicle) {
  compute(R"(title = "Couette"
[space]
dimension = 2
[domain]
disc = { centre = [0.0, 0.0], radius = 3.0 }
[fluid]
viscosity = 2.0
edges_per_particle = 24
[viscous_contact]
end_time = 0.02
time_step = 0.01
[[particle]]
centre = [0.0, 0.0]
radius = 0.4
velocity_given = { value = [0.0, 0.0], angular_velocity = 1.0 }
[[membrane]]
centre = [0.0, 0.0]
perimeter = 6.28633
reduced_area = 0.999
bending_rigidity = 1.0
inner_viscosity = 10.0
beads = 24
[output]
every = 0.02
)");
  const double inside = 5 / (1 / 0.16 - 1), outside = 1 / (1 - 1 / 9.0);
  const double rate = inside / (inside + outside);
  EXPECT_NEAR(last("membranes.csv", "membrane_speed"), rate, 2e-3 * rate);
  const double torque = 4 * std::numbers::pi * 2 * rate * outside;
  EXPECT_NEAR(last("final_particles.csv", "fluid_torque", 24), -torque, 5e-3 * torque);
  EXPECT_NEAR(last("final_particles.csv", "angle", 24), 0.02, 1e-12);
}

/// A disc inside a vesicle in shear flow, which a force pulls, and one outside, in a unit of length
/// and with a viscosity; mirrored, with the particles in the other order.
std::string scene(bool is_mirrored, double unit, double viscosity) {
  const double side = is_mirrored ? -1 : 1;
  const auto place = [&](double x, double y, double radius) {
    return fmt::format("[[particle]]\ncentre = [{}, {}]\nradius = {}\n", side * x * unit, y * unit,
                       radius * unit);
  };
  const auto inner =
      place(0.1, 0.05, 0.3) + fmt::format("force = [{}, 0.0]\n", side * 2 * viscosity * unit);
  const auto outer = place(2.3, 0.6, 0.4);
  return fmt::format(R"(title = "Discs beside a vesicle"
[space]
dimension = 2
[domain]
box = {{ from = [{0}, {1}], to = [{2}, {3}], periodic = [true, false] }}
[fluid]
viscosity = {4}
velocity = {{ shear_rate = {5} }}
edges_per_particle = 16
threshold_gap = {6}
[viscous_contact]
end_time = 0.3
time_step = 0.1
{7}{8}[[membrane]]
centre = [0.0, 0.0]
perimeter = {9}
reduced_area = 0.85
bending_rigidity = {10}
angle = {11}
beads = 14
[output]
every = 0.3
)",
                     -4 * unit, -3 * unit, 4 * unit, 3 * unit, viscosity, side, 0.02 * unit,
                     is_mirrored ? outer : inner, is_mirrored ? inner : outer, 6.6 * unit,
                     viscosity * unit * unit * unit, is_mirrored ? std::numbers::pi - 0.5 : 0.5);
}

// A mirrored mesh has other triangles, so that velocities differ by the errors of a coarse mesh.
TEST_F(MembranesAndDiscs, UnitsOrderAndSideDoNotMatter) {
  compute(scene(false, 1, 1));
  // The last rows of motion.csv are those of the discs, whose numbers come first, and of 14 beads.
  const auto values = [&] {
    std::vector<double> all = {last("membranes.csv", "x"), last("membranes.csv", "inclination")};
    for (const std::size_t disc : {15U, 14U})
      for (const auto* name : {"x", "y", "angle"}) all.push_back(last("motion.csv", name, disc));
    return all;
  };
  const auto one = values();
  const double unit = 1e-3;
  std::filesystem::remove_all(out());
  compute(scene(true, unit, 7));
  const auto other = values();
  EXPECT_NEAR(-other[0] / unit, one[0], 1e-4);
  EXPECT_NEAR(-other[1], one[1], 1e-3);
  for (std::size_t disc = 0; disc < 2; ++disc) {
    const std::size_t i = 2 + 3 * disc, j = 2 + 3 * (1 - disc);
    EXPECT_NEAR(-other[j] / unit, one[i], 1e-4);
    EXPECT_NEAR(other[j + 1] / unit, one[i + 1], 1e-4);
    EXPECT_NEAR(-other[j + 2], one[i + 2], 1e-3);
  }
}

// A force pushes a disc against the membrane from inside, and the vesicle against the wall of its
// vessel: the disc comes to rest, held by the films at the beads and at the wall, and does not
// cross.
TEST_F(MembranesAndDiscs, ADiscDoesNotCrossTheMembrane) {
  compute(R"(title = "Pushed"
[space]
dimension = 2
[domain]
disc = { centre = [0.0, 0.0], radius = 1.6 }
[fluid]
viscosity = 1.0
edges_per_particle = 12
threshold_gap = 0.02
[viscous_contact]
end_time = 1.0
time_step = 0.025
[[particle]]
centre = [0.3, 0.0]
radius = 0.3
force = [60.0, 10.0]
[[membrane]]
centre = [0.0, 0.0]
perimeter = 6.0
reduced_area = 0.9
bending_rigidity = 1.0
angle = 0.5
beads = 16
[output]
every = 1.0
)");
  const std::size_t disc = 16;
  const double x = last("motion.csv", "x", disc), y = last("motion.csv", "y", disc);
  // Without the membrane it moves at more than 5.
  EXPECT_LT(std::hypot(last("motion.csv", "vx", disc), last("motion.csv", "vy", disc)), 0.3);
  double least = 1e300;
  for (std::size_t k = 0; k < 16; ++k)
    least =
        std::min(least, std::hypot(last("motion.csv", "x", k) - x, last("motion.csv", "y", k) - y));
  // The beads have the radius 0.45 * 6/16.
  EXPECT_NEAR(least, 0.3 + 0.45 * 6 / 16 + 0.02, 2e-3);
  EXPECT_LT(std::hypot(x, y), 1.6 - 0.3 - 2 * 0.45 * 6 / 16);
  // Films at the beads and at the wall carry the force.
  double gamma = 0;
  for (const double of_contact : column("final_contacts.csv", "gamma")) gamma += of_contact;
  EXPECT_LT(gamma, -10);
  EXPECT_NEAR(last("membranes.csv", "perimeter"), 6, 1e-9);
}

}  // namespace
}  // namespace viscontact
