// Rigid bodies and links in a fluid with inertia (FreeFEM): half the step, energy, the penalty,
// other units, two ways to hold the same discs, and restarts bit for bit.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/sample_files.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A pendulum of two discs that falls from the horizontal, in units of length, time and mass.
struct PendulumCase {
  double time_step = 0.05, end_time = 0.4;
  double every = 1e10;  ///< the time between frames, over the unit of time
  std::string constraint = "rigid";
  int edges = 8;
  double length = 1, time = 1, mass = 1;

  std::string text() const {
    const double surface = mass / (length * length);  // a density of discs
    const auto l = [&](double x) { return fmt::format("{}", x * length); };
    std::string text = fmt::format(
        R"(title = "A pendulum"
[space]
dimension = 2
gravity = [0.0, {}]
[fluid]
viscosity = {}
density = {}
constraint = "{}"
edges_per_particle = {}
threshold_gap = {}
[domain]
box = {{ from = [{}, {}], to = [{}, {}] }}
[viscous_contact]
time_step = {}
end_time = {}
[output]
every = {}
)",
        -10 * length / (time * time), 0.05 * mass / time, surface, constraint, edges, l(0.01),
        l(-2), l(-2), l(2), l(1), time_step * time, end_time * time, every * time);
    for (const double x : {0.0, 0.7})
      text += fmt::format("[[particle]]\ncentre = [{}, {}]\nradius = {}\ndensity = {}\n", l(x),
                          l(0), l(0.3), 4 * surface);
    return text + fmt::format("[[body]]\nparticles = [0, 1]\n[[hinge]]\nbody = 0\nat = [{}, {}]\n",
                              l(-0.2), l(0));
  }
};

class ConstrainedInFlow : public ParticlesCommand {
 protected:
  /// The angle of body 0 at the end.
  double angle(const PendulumCase& pendulum) {
    compute(pendulum.text());
    return column("bodies.csv", "angle").back();
  }
};

// z = h F/(length 4 pi mu) = 1.99 of the disc that stands on the arm.
TEST_F(ConstrainedInFlow, AWarningNamesALinkThatPushesTooHard) {
  const auto text = [](double step) {
    return fmt::format(R"(title = "A disc on an arm"
[space]
dimension = 2
[fluid]
viscosity = 1.0
edges_per_particle = 8
[domain]
box = {{ from = [0.0, 0.0], to = [4.0, 4.0] }}
[viscous_contact]
time_step = {}
end_time = 0.3
[output]
every = 0.3
[[particle]]
centre = [2.0, 1.0]
radius = 0.3
fixed = true
[[particle]]
centre = [2.0, 2.2]
radius = 0.3
force = [0.0, -100.0]
[[arm]]
between = [0, 1]
length = 1.2
)",
                       step);
  };
  auto result = run(put_case(text(0.3)), out());
  EXPECT_EQ(result.exit_status, 0) << result.errors;
  EXPECT_THAT(result.errors, Names("1 of 1"));
  EXPECT_THAT(result.errors, Names("time_step", "0.15"));
  EXPECT_THAT(read_file(out() / "run.json"), HasSubstr("\"buckling_steps\": 1"));
  result = run(put_case(text(0.15)), out());
  EXPECT_EQ(result.exit_status, 0) << result.errors;
  EXPECT_THAT(result.errors, Not(HasSubstr("pushes")));
}

TEST_F(ConstrainedInFlow, APendulumFallsAndLosesEnergyToTheFluid) {
  PendulumCase pendulum{.end_time = 0.35, .every = 0.05};
  const double coarse = angle(pendulum);
  // The hinge is 0.55 from the centre of the body.
  const auto x = column("bodies.csv", "x"), y = column("bodies.csv", "y");
  const auto spin = column("bodies.csv", "angular_velocity");
  for (std::size_t n = 0; n < x.size(); ++n) EXPECT_NEAR(std::hypot(x[n] + 0.2, y[n]), 0.55, 1e-6);
  // What weight less buoyancy gives is in the body, in the fluid, and dissipated. A row of
  // steps.csv has the flow at the beginning of its step.
  constexpr double kArea = std::numbers::pi * 0.3 * 0.3;
  constexpr double kInertia = 4 * kArea * (0.3 * 0.3 + 0.2 * 0.2 + 0.9 * 0.9);
  const auto of_fluid = column("steps.csv", "kinetic_energy_fluid");
  const auto power = column("steps.csv", "dissipation");
  double dissipated = 0;
  for (std::size_t n = 1; n < of_fluid.size(); ++n) {
    dissipated += pendulum.time_step * (power[n - 1] + power[n]) / 2;
    const double energy = kInertia * spin[n] * spin[n] / 2 + of_fluid[n] + dissipated;
    // The fluid is set in motion at once, which the first steps do not resolve.
    if (n <= 5) continue;
    EXPECT_NEAR(energy / (-2 * kArea * (4 - 1) * 10 * y[n]), 1, 5e-3) << n;
  }
  pendulum.every = 1;
  pendulum.time_step /= 2;
  const double fine = angle(pendulum);
  pendulum.time_step /= 2;
  const double finest = angle(pendulum);
  // Steps are of second order; the first one, in which the fluid is set in motion at once, is of
  // first order in a layer thinner than an edge.
  EXPECT_LT(std::abs(fine - finest), 0.45 * std::abs(coarse - fine));
  EXPECT_NEAR(coarse / finest, 1, 0.02);
}

TEST_F(ConstrainedInFlow, APendulumIsTheSameByPenaltyAndInOtherUnits) {
  PendulumCase pendulum{.end_time = 0.2, .edges = 16};
  const double rigid = angle(pendulum);
  pendulum.constraint = "penalty";
  // The difference is that of the meshes with and without elements in the discs: 1.5e-4 with 16
  // edges,
  // 3.3e-3 with 8.
  EXPECT_NEAR(angle(pendulum) / rigid, 1, 5e-4);
  pendulum = {.end_time = 0.2, .edges = 16, .length = 1e-4, .time = 3e-3, .mass = 7e2};
  EXPECT_NEAR(angle(pendulum) / rigid, 1, 1e-3);
}

// One above the other in the middle of the box, discs of a body and discs on an arm fall alike:
// nothing turns them.
TEST_F(ConstrainedInFlow, DiscsOfABodyFallLikeDiscsOnAnArm) {
  const std::string discs = R"(title = "Two discs that fall together"
[space]
dimension = 2
gravity = [0.0, -10.0]
[fluid]
viscosity = 0.1
density = 1.0
constraint = "rigid"
edges_per_particle = 12
[domain]
box = { from = [-2.0, 0.0], to = [2.0, 6.0] }
[viscous_contact]
time_step = 0.05
end_time = 0.3
[output]
every = 0.3
[[particle]]
centre = [0.0, 4.0]
radius = 0.4
density = 1.5
[[particle]]
centre = [0.0, 5.0]
radius = 0.3
density = 3.0
)";
  compute(discs + "[[body]]\nparticles = [0, 1]\n");
  const auto of_body = column("motion.csv", "vy");
  compute(discs + "[[arm]]\nbetween = [0, 1]\nlength = 1.0\n");
  const auto on_arm = column("motion.csv", "vy");
  ASSERT_LT(of_body.back(), -0.5);
  // The mesh is not its own mirror image, so that discs on an arm turn by its error.
  EXPECT_NEAR(on_arm.back() / of_body.back(), 1, 1e-4);
  EXPECT_GT(column("arms.csv", "force").back(), 0) << "the heavier disc pushes the lower one";
}

TEST_F(ConstrainedInFlow, ContinuesWithTheSameBits) {
  PendulumCase pendulum{.end_time = 0.2};
  const double whole = angle(pendulum);
  const auto forces = column("hinges.csv", "force_y");
  // After the first step, whose mesh is new, and later, when it has moved.
  pendulum.end_time = 0.05;
  angle(pendulum);
  for (const double end : {0.15, 0.2}) {
    pendulum.end_time = end;
    continue_last_run(pendulum.text());
  }
  EXPECT_EQ(column("bodies.csv", "angle").back(), whole);
  EXPECT_EQ(column("hinges.csv", "force_y").back(), forces.back());
}

}  // namespace
}  // namespace viscontact
