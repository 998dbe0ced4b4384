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

/// A case with `from` replaced by `to`, the text at whose line the error is, and its words.
struct Refusal {
  std::string name;
  std::string_view text;
  std::string from, to, at, words;
};
std::ostream& operator<<(std::ostream& out, const Refusal& refusal) { return out << refusal.name; }

TEST(RefusedEllipse, InABodyOrWithASolverThatKnowsDiscsOnly) {
  const auto text = changed(kDiscsInDisc, "radius = 1.0", "semi_axes = [1.0, 0.5]");
  expect_refused_at(
      changed(text, "viscosity = 2.0", "viscosity = 2.0\n[[body]]\nparticles = [0, 1]"),
      "[[particle]]", "is an ellipse; the particles of a case with bodies or links");
  expect_refused_at(changed(text, "viscosity = 2.0", "viscosity = 2.0\nsolver = [\"true\"]"),
                    "solver", "is a program of the user's own, which knows discs only");
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
                    "is 12; in a fluid with a density and constraint = \"penalty\" it must be that "
                    "of uniform particles, 11, or the constraint \"rigid\"");
}

TEST(RefusedVelocity, AtTheStartOfAStokesFlow) {
  const auto text = changed(kDiscsInDisc, "viscosity = 2.0",
                            "viscosity = 2.0\ndensity = 1.0\nstart = \"stokes\"");
  const auto moving = changed(text, "force = [0.0, -1.0]", "mass = 1.0\nVELOCITY");
  for (const auto* velocity : {"velocity = [1.0, 0.0]", "angular_velocity = 1.0"})
    expect_refused_at(
        changed(moving, "VELOCITY", velocity), "[[particle]]",
        "has a velocity at time 0, which has no effect with fluid.start = \"stokes\"");
  EXPECT_NO_THROW((void)read_particles_text(changed(moving, "VELOCITY\n", "")));
}

class RefusedFluid : public ::testing::TestWithParam<Refusal> {};

TEST_P(RefusedFluid, NamesTheLineTheKeyAndWhatIsAllowed) {
  const auto& r = GetParam();
  expect_refused_at(changed(r.text, r.from, r.to), r.at, r.words);
}

std::string name_of(const ::testing::TestParamInfo<Refusal>& info) { return info.param.name; }

/// A refused line after `viscosity` in [fluid].
Refusal in_fluid(const std::string& name, std::string_view text, const std::string& line,
                 const std::string& words) {
  return {name, text, "viscosity = 2.0", "viscosity = 2.0\n" + line, line, words};
}

INSTANTIATE_TEST_SUITE_P(
    Fluid, RefusedFluid,
    ::testing::Values(
        Refusal{"Viscosity", kDiscsInDisc, "viscosity = 2.0", "viscosity = 0.0", "viscosity",
                "fluid.viscosity is 0; it must be a number from 1e-100 to 1e100"},
        in_fluid("NegativeDensity", kDiscsInDisc, "density = -1.0", "0, or from 1e-100 to 1e100"),
        Refusal{"MasslessDiscWithInertiaOfTheFluid", kDiscsInDisc, "viscosity = 2.0",
                "viscosity = 2.0\ndensity = 1.0", "[[particle]]",
                "has no mass; in a fluid with a density it must have a density (or mass) > 0"},
        in_fluid("AdvectionOfStokesFlow", kDiscsInDisc, "advection = \"characteristics\"",
                 "fluid.advection has no effect on Stokes flow; fluid.density must be > 0"),
        Refusal{"OwnSolverWithInertia", kDiscsInDisc, "viscosity = 2.0",
                "viscosity = 2.0\ndensity = 1.0\nsolver = [\"true\"]", "solver",
                "which computes Stokes flow; it must be left out if fluid.density is > 0"},
        in_fluid("GradientInADisc", kDiscsInDisc, "pressure_gradient = [1.0, 0.0]",
                 "fluid.pressure_gradient has no effect in a closed disc"),
        in_fluid("GradientInACylinder", kSpheresOnAxis, "pressure_gradient = [1.0, 0.0]",
                 "fluid.pressure_gradient has no effect in a closed cylinder"),
        in_fluid("GradientInAClosedBox", kDiscsInBox, "pressure_gradient = [1.5, 0.0]",
                 "fluid.pressure_gradient is 1.5 along x, where it has no effect"),
        Refusal{"GradientInACellOfStokesFlow", kDiscsInBox,
                "viscosity = 2.0\n[domain]\nbox = { from = [0.0, 0.0], to = [2.0, 6.0] }",
                "viscosity = 2.0\npressure_gradient = [1.5, 0.0]\n[domain]\nbox = { from = [0.0, "
                "0.0], to = [2.0, 6.0], periodic = [true, true] }",
                "pressure_gradient", "has no effect on Stokes flow in a box that is periodic both"},
        in_fluid("GradientThatPulsatesInStokesFlow", kDiscsInBox,
                 "pressure_gradient = { value = [1.0, 0.0], period = 1.0, amplitude = 0.5 }",
                 "depends on time, which Stokes flow does not know"),
        in_fluid("GradientAndOwnSolver", kDiscsInBox,
                 "pressure_gradient = [1.0, 0.0]\nsolver = [\"true\"]",
                 "is not known to fluid.solver"),
        in_fluid("PeriodOfStokesFlow", kDiscsInBox,
                 "velocity = { left = { parabolic = 1.0, period = 2.0 }, right = \"open\" }",
                 "depends on time, which Stokes flow does not know"),
        Refusal{
            "FluxThatDependsOnTime", kDiscsInBox, "viscosity = 2.0",
            "viscosity = 2.0\ndensity = 1.0\nvelocity = { left = { parabolic = 1.0, period = 2.0 "
            "}, right = { parabolic = -1.0 } }",
            "velocity", "has a flux into the domain that depends on time; a side must be \"open\""},
        Refusal{"AmplitudeWithoutPeriod", kDiscsInBox, "viscosity = 2.0",
                "viscosity = 2.0\ndensity = 1.0\nvelocity = { left = { parabolic = 1.0, amplitude "
                "= 2.0 "
                "}, right = \"open\" }",
                "velocity", "amplitude has no effect without a period > 0"},
        Refusal{"DensityAndMass", kDiscsInDisc, "mass = 2.0", "mass = 2.0\ndensity = 1.0",
                "mass = 2.0", "must be left out, because density gives the mass of this particle"},
        Refusal{"NoDensityWithoutFluid", kDryDiscs, "mass = ", "density = 0.0 # ", "density",
                "density is 0; a particle without a fluid must have a mass"},
        in_fluid("Constraint", kDiscsInDisc, "constraint = \"stiff\"",
                 "fluid.constraint is 'stiff'; it must be \"penalty\" or \"rigid\""),
        in_fluid("SmallPenalty", kDiscsInDisc, "penalty = 1e-13",
                 "fluid.penalty is 1e-13; it must be a number from 1e-12 to 1"),
        Refusal{"SmallPenaltyOfABody", kDiscsInDisc, "viscosity = 2.0",
                "viscosity = 2.0\npenalty = 9e-11\n[[body]]\nparticles = [0, 1]", "penalty",
                "fluid.penalty is 9e-11; in a case with bodies or links it must be at least 1e-10"},
        in_fluid("LargePenalty", kDiscsInDisc, "penalty = 1.5", "from 1e-12 to 1"),
        in_fluid("Mesh", kDiscsInDisc, "mesh = \"fine\"", "\"fitted\" or \"fixed\""),
        in_fluid("RigidOnFixedMesh", kDiscsInDisc, "mesh = \"fixed\"\nconstraint = \"rigid\"",
                 "fluid.mesh is 'fixed'; it must be \"fitted\" with constraint = \"rigid\""),
        in_fluid("FewEdges", kDiscsInDisc, "edges_per_particle = 5",
                 "is 5; it must be a whole number from 6 to 400"),
        in_fluid("ManyEdges", kDiscsInDisc, "edges_per_particle = 401", "from 6 to 400"),
        in_fluid("Coupling", kDiscsInDisc, "coupling = \"loose\"",
                 "\"constrained\" or \"splitting\""),
        in_fluid("SplittingWithoutMass", kDiscsInDisc, "coupling = \"splitting\"",
                 "the mass of particle 0 (centre 0, 0, radius 1) is 0"),
        in_fluid("NegativeThresholdGap", kDiscsInDisc, "threshold_gap = -0.1",
                 "fluid.threshold_gap is -0.1; it must be a number from 0"),
        in_fluid("Solver", kDiscsInDisc, "solver = \"python3\"", "at least one text in quotes"),
        in_fluid("EmptySolver", kDiscsInDisc, "solver = [\"\"]", "begins with an empty text"),
        in_fluid("UnknownKey", kDiscsInDisc, "treshold_gap = 0.1", "is not a key that is known"),
        Refusal{"WithoutDomain", kDiscsInDisc,
                "[domain]\ndisc = { centre = [0.5, 0.0], radius = 8.0 }\n", "", "[fluid]",
                "without a section [domain]; the case must have one"},
        Refusal{"ThreeDimensions", kDiscsInDisc,
                "dimension = 2\n[fluid]\nviscosity = 2.0\n[domain]\ndisc = { centre = [0.5, 0.0], "
                "radius = 8.0 }",
                "dimension = 3\n[fluid]\nviscosity = 2.0", "dimension = 3",
                "space.dimension is 3; in a case with [fluid] it must be 2"},
        Refusal{"Dimension", kSpheresOnAxis, "\"axisymmetric\"", "\"axial\"", "dimension",
                "is 'axial'; it must be 2, 3 or \"axisymmetric\""},
        Refusal{"DimensionFour", kSpheresOnAxis, "\"axisymmetric\"", "4", "dimension",
                "is 4; it must be 2, 3 or \"axisymmetric\""},
        Refusal{"DimensionWithPoint", kSpheresOnAxis, "\"axisymmetric\"", "2.0", "dimension",
                "is 2.0; it must be a whole number"},
        Refusal{"AxisWithoutFluid", kSpheresOnAxis, "[fluid]\nviscosity = 2.0\n", "", "dimension",
                "the case must have sections [fluid] and [domain]"},
        Refusal{"TwoSourcesOfGammaMin", kDiscsInDisc, "end_time = 1.0",
                "end_time = 1.0\ngamma_min = -1.0\nroughness = 1e-3", "roughness",
                "must be left out, because gamma_min is given"}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Velocity, RefusedFluid,
    ::testing::Values(
        in_fluid("NoTable", kDiscsInBox, "velocity = 1.0", "is 1; it must be a table"),
        in_fluid("Unknown", kDiscsInBox, "velocity = { shear = 1.0 }",
                 "is not a key that is known here; the known keys are: bottom, left, right, "
                 "shear_rate, strain_rate, top"),
        in_fluid("ShearAndStrain", kDiscsInBox,
                 "velocity = { shear_rate = 1.0, strain_rate = 1.0 }",
                 "fluid.velocity.strain_rate must be left out, because shear_rate is given"),
        in_fluid("ShearAndSide", kDiscsInBox, "velocity = { shear_rate = 1.0, top = \"open\" }",
                 "because the velocities of single sides are given"),
        in_fluid("Side", kDiscsInBox, "velocity = { top = 1.0 }",
                 "fluid.velocity.top is 1; it must be a velocity [u, v], \"open\", or a table"),
        in_fluid("Word", kDiscsInBox, "velocity = { top = \"closed\" }", "is 'closed'; it must be"),
        in_fluid("SideOfDisc", kDiscsInDisc, "velocity = { top = \"open\" }", "belongs to a box"),
        in_fluid("Cylinder", kSpheresOnAxis, "velocity = { shear_rate = 1.0 }",
                 "the walls of a cylinder are at rest"),
        in_fluid("NetFlux", kDiscsInBox, "velocity = { left = [1.0, 0.0] }",
                 "fluid.velocity gives a net flux of 6 into the domain; it must be 0"),
        in_fluid("NetFluxOfParabola", kDiscsInBox,
                 "velocity = { left = { parabolic = 1.0 }, right = [1.0, 0.0] }",
                 "net flux of -2 into"),
        in_fluid("OnlyOpenSides", kDiscsInBox,
                 "velocity = { left = \"open\", right = \"open\", bottom = \"open\", top = "
                 "\"open\" }",
                 "at least one side must be a wall")),
    name_of);

/// A refused line after `viscosity` in [fluid] of a box with periods.
Refusal in_period(const std::string& name, const std::string& periodic, const std::string& line,
                  const std::string& words) {
  static const std::string kX = changed(kDiscsInBox, "6.0] }", "6.0], periodic = [true, false] }");
  static const std::string kY = changed(kDiscsInBox, "6.0] }", "6.0], periodic = [false, true] }");
  static const std::string kXy = changed(kDiscsInBox, "6.0] }", "6.0], periodic = [true, true] }");
  return in_fluid(name, periodic == "x" ? kX : periodic == "y" ? kY : kXy, line, words);
}

/// The refusal names the line of `key` in place of the changed one.
Refusal at(const std::string& key, Refusal refusal) {
  refusal.at = key;
  return refusal;
}

INSTANTIATE_TEST_SUITE_P(
    Period, RefusedFluid,
    ::testing::Values(
        in_period("Shear", "y", "velocity = { shear_rate = 1.0 }",
                  "fluid.velocity.shear_rate does not fit a box that is periodic along y only"),
        in_period("StrainX", "x", "velocity = { strain_rate = 1.0 }",
                  "fluid.velocity.strain_rate does not fit a box that is periodic along x only"),
        in_period("StrainY", "y", "velocity = { strain_rate = 1.0 }", "periodic along y only"),
        in_period("SideX", "x", "velocity = { left = [0.0, 1.0] }",
                  "fluid.velocity.left must be left out"),
        in_period("SideY", "y", "velocity = { top = \"open\" }", "periodic along y"),
        in_period("SideBoth", "xy", "velocity = { right = [0.0, 0.0] }", "periodic along x"),
        at("end_time", in_period("ShearFor100Steps", "xy", "velocity = { shear_rate = 1.0 }",
                                 "viscous_contact.end_time is 1; it must be at most time_step")),
        in_period("ShearOnFixedMesh", "xy", "mesh = \"fixed\"\nvelocity = { strain_rate = 1.0 }",
                  "fluid.mesh is 'fixed'; it must be \"fitted\""),
        in_period("Flux", "x", "velocity = { top = [0.0, 1.0] }", "net flux of -2"),
        in_period("Open", "x", "velocity = { top = \"open\", bottom = \"open\" }",
                  "at least one side must be a wall")),
    name_of);

Refusal in_domain(const std::string& name, const std::string& to, const std::string& words) {
  return {name, kDiscsInBox, "box = { from = [0.0, 0.0], to = [2.0, 6.0] }", to, to, words};
}

INSTANTIATE_TEST_SUITE_P(
    Domain, RefusedFluid,
    ::testing::Values(
        Refusal{"Empty", kDiscsInBox, "box = { from = [0.0, 0.0], to = [2.0, 6.0] }", "",
                "[domain]", "[domain] must have one of disc, box and cylinder"},
        in_domain("Unknown", "ball = { radius = 1.0 }", "the known keys are: box, cylinder, disc"),
        in_domain("Two", "box = { from = [0.0, 0.0], to = [2.0, 6.0] }\ndisc = { radius = 9.0 }",
                  "must be left out, because disc is given"),
        in_domain("Cylinder", "cylinder = { radius = 5.0, height = 5.0 }",
                  "domain.cylinder belongs to a case with dimension \"axisymmetric\""),
        in_domain("Corners", "box = { from = [0.0, 0.0], to = [2.0, 0.0] }",
                  "domain.box.to contains 0; it must be greater than 0"),
        in_domain("Periods", "box = { from = [0.0, 0.0], to = [2.0, 6.0], periodic = true }",
                  "is true; it must be a list of 2 values, each true or false"),
        in_domain("OnePeriod", "box = { from = [0.0, 0.0], to = [2.0, 6.0], periodic = [true] }",
                  "it must be a list of 2 values"),
        in_domain("RadiusOfDisc", "disc = { centre = [0.0, 0.0], radius = -1.0 }",
                  "domain.disc.radius is -1"),
        Refusal{"BoxOnAxis", kSpheresOnAxis, "cylinder = { radius = 5.0, height = 10.0 }",
                "box = { from = [0.0, 0.0], to = [2.0, 6.0] }", "box",
                "it must be a cylinder = { radius, height }"},
        Refusal{"DiscInSpace", kDryDiscs, "dimension = 2",
                "dimension = 3\n[domain]\ndisc = { radius = 9.0 }",
                "disc = ", "it must be a box = { from, to, periodic }"}),
    name_of);

Refusal in_particle(const std::string& name, std::string_view text, const std::string& line,
                    const std::string& words) {
  return {name, text, "radius = 1.0\n", "radius = 1.0\n" + line + "\n", line, words};
}

INSTANTIATE_TEST_SUITE_P(
    Particle, RefusedFluid,
    ::testing::Values(
        in_particle("FixedAndGiven", kDiscsInDisc,
                    "velocity_given = { value = [1.0, 0.0] }\nfixed = true",
                    "particle[0].velocity_given must be left out, because fixed = true"),
        Refusal{"ForceOnFixed", kDiscsInDisc, "radius = 1.0\n", "radius = 1.0\nfixed = true\n",
                "force = ", "particle[0].force has no effect, because fixed gives the motion"},
        Refusal{"TorqueOnGiven", kDiscsInDisc, "force = [0.0, -1.0]",
                "velocity_given = { value = [1.0, 0.0] }\ntorque = 1.0", "torque",
                "particle[0].torque has no effect, because velocity_given gives the motion"},
        Refusal{"VelocityOfFixed", kDiscsInDisc, "force = [0.0, -1.0]",
                "fixed = true\nvelocity = [1.0, 0.0]", "velocity = ", "has no effect"},
        Refusal{"ForceByIdOnFixed", kDiscsInDisc, "force = [0.0, -1.0]",
                "fixed = true\n[[force]]\nvalue = [1.0, 0.0]\nparticles = [0]",
                "particles = ", "contains particle 0, whose motion is given"},
        in_particle("Fixed", kDiscsInDisc, "fixed = 1", "is 1; it must be true or false"),
        in_particle("GivenWithoutValue", kDiscsInDisc,
                    "velocity_given = { angular_velocity = 1.0 }",
                    "particle[0].velocity_given.value is missing"),
        in_particle("PiecesOfTorque", kDiscsInDisc, "torque = [ { until = 0.5, value = 1.0 } ]",
                    "particle[0].torque ends at 0.5; it must reach"),
        in_particle("VectorTorque", kDiscsInDisc, "torque = [1.0, 0.0]", "it must be a number"),
        in_particle("NegativeMass", kDiscsInDisc, "mass = -1.0",
                    "is -1; it must be a number 0, or from 1e-100 to 1e100"),
        in_particle("NegativeInertia", kDiscsInDisc, "moment_of_inertia = -1.0",
                    "it must be a number 0, or from 1e-100"),
        Refusal{"EllipseWithRadius", kDiscsInDisc, "radius = 1.0",
                "radius = 1.0\nsemi_axes = [2.0, 1.0]", "radius = 1.0",
                "particle[0].radius must be left out, because semi_axes makes this"},
        in_particle("EllipseOnAxis", kSpheresOnAxis, "semi_axes = [2.0, 1.0]",
                    "particle[0].semi_axes belongs to an ellipse in a fluid in the plane"),
        Refusal{"EllipseWithoutFluid", kDryDiscs, "mass = 1.0",
                "mass = 1.0\nsemi_axes = [2.0, 1.0]", "semi_axes",
                "particle[0].semi_axes belongs to an ellipse in a fluid in the plane"},
        Refusal{"OneSemiAxis", kDiscsInDisc, "radius = 1.0", "semi_axes = [1.0]", "semi_axes",
                "contains 1 numbers; it must contain the 2 semi-axes"},
        Refusal{"SlenderEllipse", kDiscsInDisc, "radius = 1.0", "semi_axes = [1.0, 0.001]",
                "semi_axes", "has a larger semi-axis 1000 times the smaller one; at most 100"},
        in_particle("TorqueOnAxis", kSpheresOnAxis, "torque = 1.0",
                    "a sphere on the axis does not turn"),
        in_particle("GivenRotationOnAxis", kSpheresOnAxis,
                    "velocity_given = { value = [1.0], angular_velocity = 1.0 }",
                    "velocity_given.angular_velocity must be left out"),
        Refusal{"TwoNumbersOnAxis", kSpheresOnAxis, "centre = [2.0]", "centre = [2.0, 0.0]",
                "centre", "contains 2 numbers; it must contain 1, along the axis"},
        Refusal{"MassWithoutFluid", kDryDiscs, "mass = 1.0", "mass = 0.0", "mass",
                "is 0; it must be a number from 1e-100 to 1e100 (0 is allowed only in a case with "
                "[fluid]"},
        Refusal{"NoInertiaWithoutFluid", kDryDiscs, "mass = 1.0",
                "mass = 1.0\nmoment_of_inertia = 0.0", "moment_of_inertia",
                "it must be a number from 1e-100 to 1e100"}),
    name_of);

/// The first [[particle]] of the box elsewhere.
Refusal at_start(const std::string& name, std::string_view text, const std::string& centre,
                 const std::string& words) {
  return {name, text, "[0.5, 1.0]", centre, "[[particle]]", words};
}

/// The first [[particle]] of a box that is periodic along y elsewhere.
Refusal at_start_of_period(const std::string& name, const std::string& centre,
                           const std::string& words) {
  static const std::string kText =
      changed(kDiscsInBox, "6.0] }", "6.0], periodic = [false, true] }");
  return at_start(name, kText, centre, words);
}

INSTANTIATE_TEST_SUITE_P(
    Start, RefusedFluid,
    ::testing::Values(
        at_start("Outside", kDiscsInBox, "[-0.5, 1.0]",
                 "particle 0 (centre -0.5, 1, radius 0.25) is outside the domain; x of its centre "
                 "must be from 0 to 2"),
        at_start("InWall", kDiscsInBox, "[0.2, 1.0]",
                 "is 0.05 into the left side of the box at the start"),
        at_start("AtWall", kDiscsInBox, "[0.5, 0.2501]",
                 "the bottom of the box and particle 0 (centre 0.5, 0.2501, radius 0.25) have a "
                 "gap of 0.0001 at the start, which the mesh does not resolve"),
        Refusal{"OutsideDisc", kDiscsInDisc, "[0.0, 0.0]\nradius", "[-8.0, 0.0]\nradius",
                "[[particle]]", "its centre must be less than 8 from 0.5, 0"},
        Refusal{"InWallOfDisc", kDiscsInDisc, "[0.0, 0.0]\nradius", "[-7.0, 0.0]\nradius",
                "[[particle]]", "is 0.5 into the wall of the disc"},
        Refusal{"Overlap", kDiscsInDisc, "[3.0, 0.0]", "[1.4, 0.0]", "[[particle]]\ncentre = [1.4",
                "overlap by 0.1 at the start"},
        Refusal{"Touching", kDiscsInDisc, "[3.0, 0.0]", "[1.5001, 0.0]",
                "[[particle]]\ncentre = [1.5001", "it must be at least a thousandth of the"},
        Refusal{"BelowThreshold", kDiscsInDisc,
                "viscosity = 2.0\n[domain]\ndisc = { centre = [0.5, 0.0], radius = 8.0 }",
                "viscosity = 2.0\nthreshold_gap = 1.6\n[domain]\ndisc = { centre = [0.5, 0.0], "
                "radius = 8.0 }",
                "[[particle]]\ncentre = [3.0",
                "have a gap of 1.5 at the start, less than fluid.threshold_gap, 1.6"},
        Refusal{"RoughBelowThreshold", kDiscsInDisc, "end_time = 1.0",
                "end_time = 1.0\nroughness = 0.8", "[[particle]]\ncentre = [3.0",
                "less than fluid.threshold_gap, 1.6, at which contact is made; the gap must be "
                "larger or viscous_contact.roughness smaller"},
        Refusal{"OutsideCylinder", kSpheresOnAxis, "[6.0]", "[11.0]", "[[particle]]\ncentre = [11",
                "z of its centre must be between 0 and 10"},
        Refusal{"InLid", kSpheresOnAxis, "[6.0]", "[9.75]", "[[particle]]\ncentre = [9.75",
                "is 0.25 into the lid of the cylinder"},
        Refusal{"WideSphere", kSpheresOnAxis, "radius = 5.0", "radius = 1.0", "[[particle]]",
                "its radius must be less than that of the cylinder, 1"},
        Refusal{"NarrowCylinder", kSpheresOnAxis, "radius = 5.0", "radius = 1.0001", "[[particle]]",
                "to the side of the cylinder, which the mesh does not resolve"},
        at_start_of_period("OutsidePeriod", "[0.5, 6.5]",
                           "y of its centre must be from 0 to 6, which is one period"),
        Refusal{"OwnImage", kDiscsInBox, "from = [0.0, 0.0], to = [2.0, 6.0] }",
                "from = [0.25, 0.0], to = [0.75, 6.0], "
                "periodic = [true, false] }",
                "[[particle]]", "too large for the period of the domain, 0.5"}),
    name_of);

TEST(RefusedFluidTest, ImageOfAParticleOverlapsAnother) {
  const auto text =
      changed(changed(changed(kDiscsInBox, "6.0] }", "6.0], periodic = [false, true] }"),
                      "[0.5, 1.0]", "[0.5, 0.2]"),
              "[1.2, 3.0]", "[0.5, 5.8]");
  expect_refused_at(text, "[[particle]]\ncentre = [0.5, 5.8]", "overlap by 0.1 at the start");
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
                    "[[particle]]\ncentre = [0", "discs may also overlap");
  expect_refused_at(with_body({{-2, 0}, {0, 0}, {1.5, 0}}), "[[particle]]\ncentre = [0",
                    "must keep a gap of at least a thousandth");
  expect_refused_at(with_body({{-1.99, 0}, {0, 0}, {1.5, 0}}), "[[particle]]\ncentre = [-1.99",
                    "is a wedge of 11.5 degrees; the mesh needs at least 20");
  expect_refused_at(with_body({{-0.9, 0}, {0.9, 0}, {0, 1.2}}), "[[particle]]\ncentre = [-0.9",
                    "each two of the three circles meet outside the third one");
  expect_refused_at(changed(row, "viscosity = 1.0", "viscosity = 1.0\nsolver = [\"true\"]"),
                    "solver", "because discs of a body overlap");
  expect_refused_at(with_body({{-0.95, 0}, {0.95, 0}, {0, 1.65}}),
                    "[[particle]]\ncentre = [0, 1.65", "closes a ring of particles that overlap");
}

TEST(RefusedFluidTest, ThresholdGapBelowTheGapAtWhichTheSolidsTouch) {
  const auto text =
      changed(changed(kDiscsInDisc, "viscosity = 2.0", "viscosity = 2.0\nthreshold_gap = 0.1"),
              "end_time = 1.0", "end_time = 1.0\nroughness = 0.06");
  expect_refused_at(text, "threshold_gap",
                    "fluid.threshold_gap is 0.1; it must be at least twice "
                    "viscous_contact.roughness, 0.12, because the solids touch at that gap");
}

TEST(RefusedFluidTest, RestitutionWithoutMassOrWithBodiesLinksOrSplitting) {
  const auto with = [](const std::string& more) {
    return changed(kDiscsInDisc, "end_time = 1.0",
                   "end_time = 1.0\ngamma_min = 0\nrestitution = 0.9") +
           more;
  };
  const std::string kWords =
      "viscous_contact.restitution must be left out, because the case has a fluid and also bodies, "
      "springs or arms; in a fluid only single particles, also on hinges, may rebound";
  expect_refused_at(with("[[spring]]\nbetween = [0, 1]\nstiffness = 1.0\n"), "restitution", kWords);
  expect_refused_at(with("[[arm]]\nbetween = [0, 1]\nlength = 3.0\n"), "restitution", kWords);
  expect_refused_at(with("[[body]]\nparticles = [0, 1]\n"), "restitution", kWords);
  expect_refused_at(with(""), "[[particle]]",
                    "particle 0 (centre 0, 0, radius 1) has no mass, and the case has "
                    "viscous_contact.restitution");
  const auto heavy = changed(with(""), "radius = 1.0", "radius = 1.0\nmass = 1.0");
  EXPECT_EQ(read_particles_text(heavy).setting.laws.restitution.coefficient, 0.9);
  EXPECT_EQ(read_particles_text(heavy + "[[hinge]]\nparticle = 1\nat = [3.0, 0.0]\n")
                .setting.laws.restitution.coefficient,
            0.9);
  const auto split = changed(heavy, "viscosity = 2.0", "viscosity = 2.0\ncoupling = \"splitting\"");
  EXPECT_EQ(read_particles_text(split).setting.laws.restitution.coefficient, 0.9);
  expect_refused_at(changed(split, "viscosity = 2.0", "viscosity = 2.0\ndensity = 1.0"),
                    "restitution",
                    "because the fluid has a density and fluid.coupling is \"splitting\"");
}

TEST(RefusedFluidTest, PlatesThatAreNone) {
  const auto with = [](const std::string& more) {
    return changed(kDiscsInBox, "radius = 0.25\n[[particle]]",
                   "radius = 0.25\n" + more + "\n[[particle]]");
  };
  expect_refused_at(with("length = 0.5"), "length",
                    "particle[0].length is 0.5; it must be from 1.01 to 100 times the thickness of "
                    "the plate, 0.5");
  expect_refused_at(changed(kDiscsInBox, "radius = 0.25\n[[particle]]",
                            "semi_axes = [0.3, 0.2]\nlength = 1.0\n[[particle]]"),
                    "length", "must be left out, because semi_axes makes this particle an ellipse");
}

TEST(RefusedFluidTest, ProbesThatDoNotGoFromWallToWall) {
  const auto with = [](const std::string& name, const std::string& from, const std::string& to) {
    return std::string(kDiscsInBox) + "[[probe]]\nname = \"" + name + "\"\nfrom = " + from +
           "\nto = " + to + "\n";
  };
  EXPECT_NO_THROW((void)read_particles_text(with("a", "[0.5, 0.0]", "[0.5, 6.0]")));
  expect_refused_at(with("a,b", "[0.5, 0.0]", "[0.5, 6.0]"), "name = \"a,b\"", "is 'a,b'");
  expect_refused_at(with("a", "[0.5, 0.1]", "[0.5, 6.0]"), "from = [0.5, 0.1]",
                    "probe[0].from is (0.5, 0.1), which is on no wall of the box");
  expect_refused_at(with("a", "[0.5, 0.0]", "[0.7, 0.0]"), "to = [0.7, 0.0]",
                    "probe[0].to is (0.7, 0), on the same wall as from");
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
                    "name = \"a\"\nfrom = [0.6", "is 'a', the name of another probe");
  const auto in_disc =
      std::string(kDiscsInDisc) + "[[probe]]\nname = \"a\"\nfrom = [0.5, 0.0]\nto = [0.5, 6.0]\n";
  expect_refused_at(in_disc, "name = \"a\"", "belongs to a channel; the domain must be a box");
}

TEST(RefusedFluidTest, PlaneAcrossAPeriod) {
  const auto text = changed(kDiscsInBox, "6.0] }", "6.0], periodic = [false, true] }") +
                    "[[plane]]\npoint = [0.0, 0.1]\nnormal = [0.0, 1.0]\n";
  expect_refused_at(text, "normal",
                    "plane[0].normal belongs to a plane that turns or is not parallel to the "
                    "period of the domain along y");
}

}  // namespace
}  // namespace viscontact::particles
