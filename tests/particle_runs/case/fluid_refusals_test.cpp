// Cases of particles in a fluid, or in a domain, that are refused, with the line of what is wrong.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <string>
#include <vector>

#include "tests/particle_runs/case/fluid_cases.hpp"

namespace viscontact::particles {
namespace {

/// A case with `from` replaced by `to`, the text at whose line the error is, its key, and names and
/// values in its message.
struct Refusal {
  std::string name;
  std::string_view text;
  std::string from, to, at, key;
  std::vector<std::string> names = {};
};
std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.name; }

TEST(RefusedEllipse, WithASolverThatKnowsDiscsOnly) {
  const auto text = changed(kDiscsInDisc, "radius = 1.0", "semi_axes = [1.0, 0.5]");
  expect_refused_at(changed(text, "viscosity = 2.0", "viscosity = 2.0\nsolver = [\"true\"]"),
                    "solver", "fluid.solver");
}

// A very viscous fluid has the inertia of its density.
TEST(RefusedBody, WithAMomentOfInertiaOfItsOwnByPenaltyInAFluidWithInertia) {
  const auto with = [](const std::string& fluid, const std::string& body) {
    return R"(title = "A body"
[space]
dimension = 2
[fluid]
viscosity = 1.0
density = 1.0
)" + fluid +
           R"([domain]
box = { from = [0.0, 0.0], to = [8.0, 8.0] }
[viscous_contact]
time_step = 0.1
end_time = 1.0
[[particle]]
centre = [2.0, 4.0]
radius = 1.0
mass = 2.0
[[particle]]
centre = [5.0, 4.0]
radius = 1.0
mass = 2.0
[[body]]
particles = [0, 1]
)" + body;
  };
  // 2 (1/2 + 1.5^2) for each disc.
  for (const std::string allowed : {"", "moment_of_inertia = 11.0\n"})
    EXPECT_EQ(read_particles_text(with("", allowed)).particles.bodies.count(), 1U);
  EXPECT_EQ(read_particles_text(with("constraint = \"rigid\"\n", "moment_of_inertia = 12.0\n"))
                .particles.bodies.count(),
            1U);
  expect_refused_at(with("", "moment_of_inertia = 12.0\n"), "moment_of_inertia",
                    "body[0].moment_of_inertia", {"11"});
}

TEST(RefusedVelocity, AtTheStartOfAStokesFlow) {
  const auto text = changed(kDiscsInDisc, "viscosity = 2.0",
                            "viscosity = 2.0\ndensity = 1.0\nstart = \"stokes\"");
  const auto moving = changed(text, "force = [0.0, -1.0]", "mass = 1.0\nVELOCITY");
  for (const auto* velocity : {"velocity = [1.0, 0.0]", "angular_velocity = 1.0"})
    expect_refused_at(changed(moving, "VELOCITY", velocity), "[[particle]]", "", {"fluid.start"});
  EXPECT_NO_THROW((void)read_particles_text(changed(moving, "VELOCITY\n", "")));
}

class RefusedFluid : public ::testing::TestWithParam<Refusal> {};

TEST_P(RefusedFluid, NamesTheLineTheKeyAndWhatIsAllowed) {
  const auto& r = GetParam();
  expect_refused_at(changed(r.text, r.from, r.to), r.at, r.key, r.names);
}

std::string name_of(const ::testing::TestParamInfo<Refusal>& info) { return info.param.name; }

/// A refused line after `viscosity` in [fluid].
Refusal in_fluid(const std::string& name, std::string_view text, const std::string& line,
                 const std::string& key, const std::vector<std::string>& names = {}) {
  return {name, text, "viscosity = 2.0", "viscosity = 2.0\n" + line, line, key, names};
}

INSTANTIATE_TEST_SUITE_P(
    Fluid, RefusedFluid,
    ::testing::Values(
        Refusal{"Viscosity", kDiscsInDisc, "viscosity = 2.0", "viscosity = 0.0", "viscosity",
                "fluid.viscosity"},
        in_fluid("NegativeDensity", kDiscsInDisc, "density = -1.0", "fluid.density"),
        Refusal{"MasslessDiscWithInertiaOfTheFluid", kDiscsInDisc, "viscosity = 2.0",
                "viscosity = 2.0\ndensity = 1.0", "[[particle]]", ""},
        in_fluid("AdvectionOfStokesFlow", kDiscsInDisc, "advection = \"characteristics\"",
                 "fluid.advection"),
        Refusal{"OwnSolverWithInertia", kDiscsInDisc, "viscosity = 2.0",
                "viscosity = 2.0\ndensity = 1.0\nsolver = [\"true\"]", "solver", "fluid.solver"},
        in_fluid("GradientInADisc", kDiscsInDisc, "pressure_gradient = [1.0, 0.0]",
                 "fluid.pressure_gradient"),
        in_fluid("GradientInACylinder", kSpheresOnAxis, "pressure_gradient = [1.0, 0.0]",
                 "fluid.pressure_gradient"),
        in_fluid("GradientInAClosedBox", kDiscsInBox, "pressure_gradient = [1.5, 0.0]",
                 "fluid.pressure_gradient"),
        Refusal{"GradientInACellOfStokesFlow", kDiscsInBox,
                "viscosity = 2.0\n[domain]\nbox = { from = [0.0, 0.0], to = [2.0, 6.0] }",
                "viscosity = 2.0\npressure_gradient = [1.5, 0.0]\n[domain]\nbox = { from = [0.0, "
                "0.0], to = [2.0, 6.0], periodic = [true, true] }",
                "pressure_gradient", "fluid.pressure_gradient"},
        in_fluid("GradientThatPulsatesInStokesFlow", kDiscsInBox,
                 "pressure_gradient = { value = [1.0, 0.0], period = 1.0, amplitude = 0.5 }",
                 "fluid.pressure_gradient"),
        in_fluid("GradientAndOwnSolver", kDiscsInBox,
                 "pressure_gradient = [1.0, 0.0]\nsolver = [\"true\"]", "fluid.pressure_gradient"),
        in_fluid("PeriodOfStokesFlow", kDiscsInBox,
                 "velocity = { left = { parabolic = 1.0, period = 2.0 }, right = \"open\" }",
                 "fluid.velocity"),
        Refusal{
            "FluxThatDependsOnTime", kDiscsInBox, "viscosity = 2.0",
            "viscosity = 2.0\ndensity = 1.0\nvelocity = { left = { parabolic = 1.0, period = 2.0 "
            "}, right = { parabolic = -1.0 } }",
            "velocity", "fluid.velocity"},
        Refusal{"AmplitudeWithoutPeriod", kDiscsInBox, "viscosity = 2.0",
                "viscosity = 2.0\ndensity = 1.0\nvelocity = { left = { parabolic = 1.0, amplitude "
                "= 2.0 "
                "}, right = \"open\" }",
                "velocity", "fluid.velocity.left.amplitude"},
        Refusal{"DensityAndMass", kDiscsInDisc, "mass = 2.0", "mass = 2.0\ndensity = 1.0",
                "mass = 2.0", "particle[1].mass"},
        Refusal{"NoDensityWithoutFluid", kDryDiscs, "mass = ", "density = 0.0 # ", "density",
                "particle[0].density"},
        in_fluid("Constraint", kDiscsInDisc, "constraint = \"stiff\"", "fluid.constraint"),
        in_fluid("SmallPenalty", kDiscsInDisc, "penalty = 1e-13", "fluid.penalty"),
        Refusal{"SmallPenaltyOfABody", kDiscsInDisc, "viscosity = 2.0",
                "viscosity = 2.0\npenalty = 9e-11\n[[body]]\nparticles = [0, 1]", "penalty",
                "fluid.penalty"},
        in_fluid("LargePenalty", kDiscsInDisc, "penalty = 1.5", "fluid.penalty"),
        in_fluid("Mesh", kDiscsInDisc, "mesh = \"fine\"", "fluid.mesh"),
        in_fluid("RigidOnFixedMesh", kDiscsInDisc, "mesh = \"fixed\"\nconstraint = \"rigid\"",
                 "fluid.mesh"),
        in_fluid("FewEdges", kDiscsInDisc, "edges_per_particle = 5", "fluid.edges_per_particle"),
        in_fluid("ManyEdges", kDiscsInDisc, "edges_per_particle = 401", "fluid.edges_per_particle"),
        in_fluid("Coupling", kDiscsInDisc, "coupling = \"loose\"", "fluid.coupling"),
        in_fluid("SplittingWithoutMass", kDiscsInDisc, "coupling = \"splitting\"",
                 "fluid.coupling"),
        in_fluid("NegativeThresholdGap", kDiscsInDisc, "threshold_gap = -0.1",
                 "fluid.threshold_gap"),
        in_fluid("Solver", kDiscsInDisc, "solver = \"python3\"", "fluid.solver"),
        in_fluid("EmptySolver", kDiscsInDisc, "solver = [\"\"]", "fluid.solver"),
        in_fluid("UnknownKey", kDiscsInDisc, "treshold_gap = 0.1", ""),
        Refusal{"WithoutDomain", kDiscsInDisc,
                "[domain]\ndisc = { centre = [0.5, 0.0], radius = 8.0 }\n", "", "[fluid]", "fluid"},
        Refusal{"ThreeDimensions", kDiscsInDisc,
                "dimension = 2\n[fluid]\nviscosity = 2.0\n[domain]\ndisc = { centre = [0.5, 0.0], "
                "radius = 8.0 }",
                "dimension = 3\n[fluid]\nviscosity = 2.0", "dimension = 3", "space.dimension"},
        Refusal{"Dimension",
                kSpheresOnAxis,
                "\"axisymmetric\"",
                "\"axial\"",
                "dimension",
                "space.dimension",
                {"3"}},
        Refusal{"DimensionFour",
                kSpheresOnAxis,
                "\"axisymmetric\"",
                "4",
                "dimension",
                "space.dimension",
                {"axisymmetric"}},
        Refusal{"DimensionWithPoint", kSpheresOnAxis, "\"axisymmetric\"", "2.0", "dimension",
                "space.dimension"},
        Refusal{"AxisWithoutFluid", kSpheresOnAxis, "[fluid]\nviscosity = 2.0\n", "", "dimension",
                "space.dimension"},
        Refusal{"TwoSourcesOfGammaMin", kDiscsInDisc, "end_time = 1.0",
                "end_time = 1.0\ngamma_min = -1.0\nroughness = 1e-3", "roughness",
                "viscous_contact.roughness"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Velocity, RefusedFluid,
    ::testing::Values(
        in_fluid("NoTable", kDiscsInBox, "velocity = 1.0", "fluid.velocity"),
        in_fluid("Unknown", kDiscsInBox, "velocity = { shear = 1.0 }", "fluid.velocity.shear"),
        in_fluid("ShearAndStrain", kDiscsInBox,
                 "velocity = { shear_rate = 1.0, strain_rate = 1.0 }",
                 "fluid.velocity.strain_rate"),
        in_fluid("ShearAndSide", kDiscsInBox, "velocity = { shear_rate = 1.0, top = \"open\" }",
                 "fluid.velocity.shear_rate"),
        in_fluid("Side", kDiscsInBox, "velocity = { top = 1.0 }", "fluid.velocity.top"),
        in_fluid("Word", kDiscsInBox, "velocity = { top = \"closed\" }", "fluid.velocity.top"),
        in_fluid("SideOfDisc", kDiscsInDisc, "velocity = { top = \"open\" }", "fluid.velocity.top"),
        in_fluid("Cylinder", kSpheresOnAxis, "velocity = { shear_rate = 1.0 }", "fluid.velocity"),
        in_fluid("NetFlux", kDiscsInBox, "velocity = { left = [1.0, 0.0] }", "fluid.velocity",
                 {"6"}),
        in_fluid("NetFluxOfParabola", kDiscsInBox,
                 "velocity = { left = { parabolic = 1.0 }, right = [1.0, 0.0] }", "fluid.velocity",
                 {"-2"}),
        in_fluid("OnlyOpenSides", kDiscsInBox,
                 "velocity = { left = \"open\", right = \"open\", bottom = \"open\", top = "
                 "\"open\" }",
                 "fluid.velocity")),
    name_of);

/// A refused line after `viscosity` in [fluid] of a box with periods.
Refusal in_period(const std::string& name, const std::string& periodic, const std::string& line,
                  const std::string& key, const std::vector<std::string>& names = {}) {
  static const std::string kX = changed(kDiscsInBox, "6.0] }", "6.0], periodic = [true, false] }");
  static const std::string kY = changed(kDiscsInBox, "6.0] }", "6.0], periodic = [false, true] }");
  static const std::string kXy = changed(kDiscsInBox, "6.0] }", "6.0], periodic = [true, true] }");
  return in_fluid(name, periodic == "x" ? kX : periodic == "y" ? kY : kXy, line, key, names);
}

/// The refusal is at the line of `line` in place of the changed one.
Refusal at(const std::string& line, Refusal refusal) {
  refusal.at = line;
  return refusal;
}

INSTANTIATE_TEST_SUITE_P(
    Period, RefusedFluid,
    ::testing::Values(
        in_period("Shear", "y", "velocity = { shear_rate = 1.0 }", "fluid.velocity.shear_rate"),
        in_period("StrainX", "x", "velocity = { strain_rate = 1.0 }", "fluid.velocity.strain_rate"),
        in_period("StrainY", "y", "velocity = { strain_rate = 1.0 }", "fluid.velocity.strain_rate"),
        in_period("SideX", "x", "velocity = { left = [0.0, 1.0] }", "fluid.velocity.left"),
        in_period("SideY", "y", "velocity = { top = \"open\" }", "fluid.velocity.top"),
        in_period("SideBoth", "xy", "velocity = { right = [0.0, 0.0] }", "fluid.velocity.right"),
        at("end_time", in_period("ShearFor100Steps", "xy", "velocity = { shear_rate = 1.0 }",
                                 "viscous_contact.end_time")),
        in_period("ShearOnFixedMesh", "xy", "mesh = \"fixed\"\nvelocity = { strain_rate = 1.0 }",
                  "fluid.mesh"),
        in_period("Flux", "x", "velocity = { top = [0.0, 1.0] }", "fluid.velocity", {"-2"}),
        in_period("Open", "x", "velocity = { top = \"open\", bottom = \"open\" }",
                  "fluid.velocity")),
    name_of);

Refusal in_domain(const std::string& name, const std::string& to, const std::string& key,
                  const std::vector<std::string>& names = {}) {
  return {name, kDiscsInBox, "box = { from = [0.0, 0.0], to = [2.0, 6.0] }", to, to, key, names};
}

INSTANTIATE_TEST_SUITE_P(
    Domain, RefusedFluid,
    ::testing::Values(
        Refusal{"Empty", kDiscsInBox, "box = { from = [0.0, 0.0], to = [2.0, 6.0] }", "",
                "[domain]", "domain.box"},
        in_domain("Unknown", "ball = { radius = 1.0 }", "domain.ball"),
        in_domain("Two", "box = { from = [0.0, 0.0], to = [2.0, 6.0] }\ndisc = { radius = 9.0 }",
                  "domain.box"),
        in_domain("Cylinder", "cylinder = { radius = 5.0, height = 5.0 }", "domain.cylinder"),
        in_domain("Corners", "box = { from = [0.0, 0.0], to = [2.0, 0.0] }", "domain.box.to"),
        in_domain("Periods", "box = { from = [0.0, 0.0], to = [2.0, 6.0], periodic = true }",
                  "domain.box.periodic"),
        in_domain("OnePeriod", "box = { from = [0.0, 0.0], to = [2.0, 6.0], periodic = [true] }",
                  "domain.box.periodic"),
        in_domain("RadiusOfDisc", "disc = { centre = [0.0, 0.0], radius = -1.0 }",
                  "domain.disc.radius"),
        Refusal{"BoxOnAxis", kSpheresOnAxis, "cylinder = { radius = 5.0, height = 10.0 }",
                "box = { from = [0.0, 0.0], to = [2.0, 6.0] }", "box", "domain.box"},
        Refusal{"DiscInSpace", kDryDiscs, "dimension = 2",
                "dimension = 3\n[domain]\ndisc = { radius = 9.0 }", "disc = ", "domain.disc"}),
    name_of);

Refusal in_particle(const std::string& name, std::string_view text, const std::string& line,
                    const std::string& key, const std::vector<std::string>& names = {}) {
  return {name, text, "radius = 1.0\n", "radius = 1.0\n" + line + "\n", line, key, names};
}

INSTANTIATE_TEST_SUITE_P(
    Particle, RefusedFluid,
    ::testing::Values(
        in_particle("FixedAndGiven", kDiscsInDisc,
                    "velocity_given = { value = [1.0, 0.0] }\nfixed = true",
                    "particle[0].velocity_given"),
        Refusal{"ForceOnFixed", kDiscsInDisc, "radius = 1.0\n", "radius = 1.0\nfixed = true\n",
                "force = ", "particle[0].force"},
        Refusal{"TorqueOnGiven", kDiscsInDisc, "force = [0.0, -1.0]",
                "velocity_given = { value = [1.0, 0.0] }\ntorque = 1.0", "torque",
                "particle[0].torque"},
        Refusal{"VelocityOfFixed", kDiscsInDisc, "force = [0.0, -1.0]",
                "fixed = true\nvelocity = [1.0, 0.0]", "velocity = ", "particle[0].velocity"},
        Refusal{"ForceByIdOnFixed", kDiscsInDisc, "force = [0.0, -1.0]",
                "fixed = true\n[[force]]\nvalue = [1.0, 0.0]\nparticles = [0]",
                "particles = ", "force[0].particles"},
        in_particle("Fixed", kDiscsInDisc, "fixed = 1", "particle[0].fixed"),
        in_particle("GivenWithoutValue", kDiscsInDisc,
                    "velocity_given = { angular_velocity = 1.0 }",
                    "particle[0].velocity_given.value"),
        in_particle("PiecesOfTorque", kDiscsInDisc, "torque = [ { until = 0.5, value = 1.0 } ]",
                    "particle[0].torque"),
        in_particle("VectorTorque", kDiscsInDisc, "torque = [1.0, 0.0]", "particle[0].torque"),
        in_particle("NegativeMass", kDiscsInDisc, "mass = -1.0", "particle[0].mass"),
        in_particle("NegativeInertia", kDiscsInDisc, "moment_of_inertia = -1.0",
                    "particle[0].moment_of_inertia"),
        Refusal{"EllipseWithRadius", kDiscsInDisc, "radius = 1.0",
                "radius = 1.0\nsemi_axes = [2.0, 1.0]", "radius = 1.0", "particle[0].radius"},
        in_particle("EllipseOnAxis", kSpheresOnAxis, "semi_axes = [2.0, 1.0]",
                    "particle[0].semi_axes"),
        Refusal{"OneSemiAxis", kDiscsInDisc, "radius = 1.0", "semi_axes = [1.0]", "semi_axes",
                "particle[0].semi_axes"},
        Refusal{"SlenderEllipse",
                kDiscsInDisc,
                "radius = 1.0",
                "semi_axes = [1.0, 0.001]",
                "semi_axes",
                "particle[0].semi_axes",
                {"1000"}},
        in_particle("TorqueOnAxis", kSpheresOnAxis, "torque = 1.0", "particle[0].torque"),
        in_particle("GivenRotationOnAxis", kSpheresOnAxis,
                    "velocity_given = { value = [1.0], angular_velocity = 1.0 }",
                    "particle[0].velocity_given.angular_velocity"),
        Refusal{"TwoNumbersOnAxis", kSpheresOnAxis, "centre = [2.0]", "centre = [2.0, 0.0]",
                "centre", "particle[0].centre"},
        Refusal{"MassWithoutFluid", kDryDiscs, "mass = 1.0", "mass = 0.0", "mass",
                "particle[0].mass"},
        Refusal{"NoInertiaWithoutFluid", kDryDiscs, "mass = 1.0",
                "mass = 1.0\nmoment_of_inertia = 0.0", "moment_of_inertia",
                "particle[0].moment_of_inertia"}),
    name_of);

/// The first [[particle]] of the box elsewhere.
Refusal at_start(const std::string& name, std::string_view text, const std::string& centre,
                 const std::string& key, const std::vector<std::string>& names = {}) {
  return {name, text, "[0.5, 1.0]", centre, "[[particle]]", key, names};
}

/// The first [[particle]] of a box that is periodic along y elsewhere.
Refusal at_start_of_period(const std::string& name, const std::string& centre,
                           const std::string& key, const std::vector<std::string>& names = {}) {
  static const std::string kText =
      changed(kDiscsInBox, "6.0] }", "6.0], periodic = [false, true] }");
  return at_start(name, kText, centre, key, names);
}

INSTANTIATE_TEST_SUITE_P(
    Start, RefusedFluid,
    ::testing::Values(
        at_start("Outside", kDiscsInBox, "[-0.5, 1.0]", "", {"-0.5", "0.25"}),
        at_start("InWall", kDiscsInBox, "[0.2, 1.0]", "", {"0.05"}),
        at_start("AtWall", kDiscsInBox, "[0.5, 0.2501]", "", {"0.5", "0.2501", "0.0001"}),
        Refusal{"OutsideDisc",
                kDiscsInDisc,
                "[0.0, 0.0]\nradius",
                "[-8.0, 0.0]\nradius",
                "[[particle]]",
                "",
                {"0.5"}},
        Refusal{"InWallOfDisc",
                kDiscsInDisc,
                "[0.0, 0.0]\nradius",
                "[-7.0, 0.0]\nradius",
                "[[particle]]",
                "",
                {"0.5"}},
        Refusal{"Overlap",
                kDiscsInDisc,
                "[3.0, 0.0]",
                "[1.4, 0.0]",
                "[[particle]]\ncentre = [1.4",
                "",
                {"0.1"}},
        Refusal{"Touching", kDiscsInDisc, "[3.0, 0.0]", "[1.5001, 0.0]",
                "[[particle]]\ncentre = [1.5001", ""},
        Refusal{"BelowThreshold",
                kDiscsInDisc,
                "viscosity = 2.0\n[domain]\ndisc = { centre = [0.5, 0.0], radius = 8.0 }",
                "viscosity = 2.0\nthreshold_gap = 1.6\n[domain]\ndisc = { centre = [0.5, 0.0], "
                "radius = 8.0 }",
                "[[particle]]\ncentre = [3.0",
                "",
                {"fluid.threshold_gap", "1.5", "1.6"}},
        Refusal{"RoughBelowThreshold",
                kDiscsInDisc,
                "end_time = 1.0",
                "end_time = 1.0\nroughness = 0.8",
                "[[particle]]\ncentre = [3.0",
                "",
                {"fluid.threshold_gap", "viscous_contact.roughness", "1.6"}},
        Refusal{"OutsideCylinder",
                kSpheresOnAxis,
                "[6.0]",
                "[11.0]",
                "[[particle]]\ncentre = [11",
                "",
                {"10"}},
        Refusal{"InLid",
                kSpheresOnAxis,
                "[6.0]",
                "[9.75]",
                "[[particle]]\ncentre = [9.75",
                "",
                {"0.25"}},
        Refusal{"WideSphere", kSpheresOnAxis, "radius = 5.0", "radius = 1.0", "[[particle]]", ""},
        Refusal{"NarrowCylinder", kSpheresOnAxis, "radius = 5.0", "radius = 1.0001", "[[particle]]",
                ""},
        at_start_of_period("OutsidePeriod", "[0.5, 6.5]", ""),
        Refusal{"OwnImage",
                kDiscsInBox,
                "from = [0.0, 0.0], to = [2.0, 6.0] }",
                "from = [0.25, 0.0], to = [0.75, 6.0], "
                "periodic = [true, false] }",
                "[[particle]]",
                "",
                {"0.5"}}),
    name_of);

TEST(RefusedFluidTest, ImageOfAParticleOverlapsAnother) {
  const auto text =
      changed(changed(changed(kDiscsInBox, "6.0] }", "6.0], periodic = [false, true] }"),
                      "[0.5, 1.0]", "[0.5, 0.2]"),
              "[1.2, 3.0]", "[0.5, 5.8]");
  expect_refused_at(text, "[[particle]]\ncentre = [0.5, 5.8]", "", {"0.1"});
}

/// A fluid with three discs of the radius 1 that are one body, with centres at these x, y.
std::string with_body(const std::vector<std::array<double, 2>>& centres,
                      const std::string& constraint = "rigid") {
  std::string text =
      "title = \"Body\"\n[space]\ndimension = 2\n[fluid]\nviscosity = 1.0\nconstraint = \"" +
      constraint +
      "\"\n[domain]\ndisc = { centre = [0.0, 0.0], radius = 9.0 }\n"
      "[viscous_contact]\ntime_step = 0.1\nend_time = 1.0\n";
  for (const auto& [x, y] : centres)
    text += fmt::format("[[particle]]\ncentre = [{}, {}]\nradius = 1.0\n", x, y);
  return text + "[[body]]\nparticles = [0, 1, 2]\n";
}

TEST(RefusedFluidTest, DiscsOfABodyThatOverlapInAWayThatTheMeshDoesNotResolve) {
  const auto row = with_body({{-1.5, 0}, {0, 0}, {1.5, 0}});
  EXPECT_EQ(read_particles_text(row).setting.fluid->cut_areas.size(), 3U);
  EXPECT_TRUE(
      read_particles_text(with_body({{-3, 0}, {0, 0}, {3, 0}})).setting.fluid->cut_areas.empty());
  expect_refused_at(with_body({{-1.5, 0}, {0, 0}, {1.5, 0}}, "penalty"),
                    "[[particle]]\ncentre = [0", "", {"fluid.constraint"});
  expect_refused_at(with_body({{-2, 0}, {0, 0}, {1.5, 0}}), "[[particle]]\ncentre = [0", "",
                    {"thousandth"});
  expect_refused_at(with_body({{-1.99, 0}, {0, 0}, {1.5, 0}}), "[[particle]]\ncentre = [-1.99", "",
                    {"11.5", "20"});
  expect_refused_at(with_body({{-0.9, 0}, {0.9, 0}, {0, 1.2}}), "[[particle]]\ncentre = [-0.9", "",
                    {"circles"});
  expect_refused_at(changed(row, "viscosity = 1.0", "viscosity = 1.0\nsolver = [\"true\"]"),
                    "solver", "fluid.solver");
  expect_refused_at(with_body({{-0.95, 0}, {0.95, 0}, {0, 1.65}}),
                    "[[particle]]\ncentre = [0, 1.65", "", {"ring"});
}

TEST(RefusedFluidTest, ThresholdGapBelowTheGapAtWhichTheSolidsTouch) {
  const auto text =
      changed(changed(kDiscsInDisc, "viscosity = 2.0", "viscosity = 2.0\nthreshold_gap = 0.1"),
              "end_time = 1.0", "end_time = 1.0\nroughness = 0.06");
  expect_refused_at(text, "threshold_gap", "fluid.threshold_gap", {"0.1", "0.12"});
}

TEST(RefusedFluidTest, RestitutionWithoutMassOrWithBodiesLinksOrSplitting) {
  const auto with = [](const std::string& more) {
    return changed(kDiscsInDisc, "end_time = 1.0",
                   "end_time = 1.0\ngamma_min = 0\nrestitution = 0.9") +
           more;
  };
  expect_refused_at(with("[[spring]]\nbetween = [0, 1]\nstiffness = 1.0\n"), "restitution",
                    "viscous_contact.restitution");
  expect_refused_at(with("[[arm]]\nbetween = [0, 1]\nlength = 3.0\n"), "restitution",
                    "viscous_contact.restitution");
  expect_refused_at(with("[[body]]\nparticles = [0, 1]\n"), "restitution",
                    "viscous_contact.restitution");
  expect_refused_at(with(""), "[[particle]]", "", {"viscous_contact.restitution"});
  const auto heavy = changed(with(""), "radius = 1.0", "radius = 1.0\nmass = 1.0");
  EXPECT_EQ(read_particles_text(heavy).setting.laws.restitution.coefficient, 0.9);
  EXPECT_EQ(read_particles_text(heavy + "[[hinge]]\nparticle = 1\nat = [3.0, 0.0]\n")
                .setting.laws.restitution.coefficient,
            0.9);
  const auto split = changed(heavy, "viscosity = 2.0", "viscosity = 2.0\ncoupling = \"splitting\"");
  EXPECT_EQ(read_particles_text(split).setting.laws.restitution.coefficient, 0.9);
  expect_refused_at(changed(split, "viscosity = 2.0", "viscosity = 2.0\ndensity = 1.0"),
                    "restitution", "viscous_contact.restitution");
}

TEST(RefusedFluidTest, PlatesThatAreNone) {
  const auto with = [](const std::string& more) {
    return changed(kDiscsInBox, "radius = 0.25\n[[particle]]",
                   "radius = 0.25\n" + more + "\n[[particle]]");
  };
  expect_refused_at(with("length = 0.5"), "length", "particle[0].length");
  expect_refused_at(changed(kDiscsInBox, "radius = 0.25\n[[particle]]",
                            "semi_axes = [0.3, 0.2]\nlength = 1.0\n[[particle]]"),
                    "length", "particle[0].length");
}

TEST(RefusedFluidTest, ProbesThatDoNotGoFromWallToWall) {
  const auto with = [](const std::string& name, const std::string& from, const std::string& to) {
    return std::string(kDiscsInBox) + "[[probe]]\nname = \"" + name + "\"\nfrom = " + from +
           "\nto = " + to + "\n";
  };
  EXPECT_NO_THROW((void)read_particles_text(with("a", "[0.5, 0.0]", "[0.5, 6.0]")));
  expect_refused_at(with("a,b", "[0.5, 0.0]", "[0.5, 6.0]"), "name = \"a,b\"", "probe[0].name");
  expect_refused_at(with("a", "[0.5, 0.1]", "[0.5, 6.0]"), "from = [0.5, 0.1]", "probe[0].from");
  expect_refused_at(with("a", "[0.5, 0.0]", "[0.7, 0.0]"), "to = [0.7, 0.0]", "probe[0].to");
  // From corner to corner along each wall, and from a wall to its end.
  for (const auto& [from, to] : {std::pair("[0.0, 0.0]", "[2.0, 0.0]"),
                                 {"[2.0, 0.0]", "[2.0, 6.0]"},
                                 {"[2.0, 6.0]", "[0.0, 6.0]"},
                                 {"[0.0, 6.0]", "[0.0, 0.0]"},
                                 {"[0.0, 3.0]", "[0.0, 6.0]"},
                                 {"[0.5, 0.5]", "[0.5, 0.5]"}})
    EXPECT_ANY_THROW((void)read_particles_text(with("a", from, to))) << from << to;
  EXPECT_NO_THROW((void)read_particles_text(with("a", "[0.0, 0.0]", "[2.0, 6.0]")));
  expect_refused_at(with("a", "[0.5, 0.0]", "[0.5, 6.0]") +
                        "[[probe]]\nname = \"a\"\nfrom = [0.6, 0.0]\nto = [0.6, 6.0]\n",
                    "name = \"a\"\nfrom = [0.6", "probe[1].name");
  const auto in_disc =
      std::string(kDiscsInDisc) + "[[probe]]\nname = \"a\"\nfrom = [0.5, 0.0]\nto = [0.5, 6.0]\n";
  expect_refused_at(in_disc, "name = \"a\"", "probe[0].name");
}

TEST(RefusedFluidTest, PlaneAcrossAPeriod) {
  const auto text = changed(kDiscsInBox, "6.0] }", "6.0], periodic = [false, true] }") +
                    "[[plane]]\npoint = [0.0, 0.1]\nnormal = [0.0, 1.0]\n";
  expect_refused_at(text, "normal", "plane[0].normal");
}

}  // namespace
}  // namespace viscontact::particles
