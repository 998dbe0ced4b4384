// What the sections [fluid] and [domain], and particles in a fluid, give.
#include <gmock/gmock.h>

#include <numbers>
#include <variant>

#include "tests/common/temporary_folder.hpp"
#include "tests/particle_runs/case/fluid_cases.hpp"

namespace viscontact::particles {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(FluidCase, HasTheDefaultsOfTheDocumentation) {
  const auto c = read_particles_text(std::string(kDiscsInDisc));
  ASSERT_TRUE(c.setting.fluid);
  const auto& fluid = *c.setting.fluid;
  EXPECT_EQ(fluid.viscosity, 2);
  EXPECT_EQ(fluid.density, 0);
  EXPECT_EQ(fluid.constraint, RigidConstraint::kPenalty);
  EXPECT_EQ(fluid.penalty, 1e-7);
  EXPECT_EQ(fluid.mesh, FluidMesh::kFitted);
  EXPECT_EQ(fluid.edges_per_particle, 24);
  EXPECT_EQ(fluid.coupling, Coupling::kConstrained);
  EXPECT_EQ(fluid.threshold_gap, 0.05 * 0.5);
  EXPECT_THAT(std::get<LinearFlow>(fluid.boundary).gradient, ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(fluid.solver, IsEmpty());
  const auto& disc = std::get<DiscDomain>(c.setting.domain);
  EXPECT_THAT(disc.centre, ElementsAre(0.5, 0, 0));
  EXPECT_EQ(disc.radius, 8);
}

TEST(FluidCase, ReadsEachKeyOfTheFluid) {
  const auto c = read_particles_text(changed(kDiscsInDisc, "viscosity = 2.0", R"(viscosity = 2.0
density = 0.0
constraint = "rigid"
penalty = 1e-4
edges_per_particle = 48
coupling = "constrained"
threshold_gap = 0.125
velocity = { shear_rate = 3.0 })"));
  const auto& fluid = *c.setting.fluid;
  EXPECT_EQ(fluid.constraint, RigidConstraint::kRigid);
  EXPECT_EQ(fluid.penalty, 1e-4);
  EXPECT_EQ(fluid.edges_per_particle, 48);
  EXPECT_EQ(fluid.threshold_gap, 0.125);
  EXPECT_THAT(std::get<LinearFlow>(fluid.boundary).gradient, ElementsAre(0, 3, 0, 0));
  const auto strained = read_particles_text(
      changed(kDiscsInDisc, "viscosity = 2.0",
              "viscosity = 2.0\nmesh = \"fixed\"\nvelocity = { strain_rate = 3.0 }"));
  EXPECT_EQ(strained.setting.fluid->mesh, FluidMesh::kFixed);
  EXPECT_THAT(std::get<LinearFlow>(strained.setting.fluid->boundary).gradient,
              ElementsAre(3, 0, 0, -3));
}

TEST(FluidCase, TakesPenaltiesThatSufficeForWhatHoldsTheParticles) {
  const auto read = [](const std::string& lines) {
    (void)read_particles_text(
        changed(kDiscsInDisc, "viscosity = 2.0", "viscosity = 2.0\n" + lines));
  };
  EXPECT_NO_THROW(read("penalty = 1e-10\n[[body]]\nparticles = [0, 1]"));
  EXPECT_NO_THROW(read("penalty = 1e-12\n[[body]]\nparticles = [1]"));  // nothing to hold
  EXPECT_NO_THROW(read("penalty = 1e-12\nconstraint = \"rigid\"\n[[body]]\nparticles = [0, 1]"));
}

TEST(FluidCase, ReadsTheVelocityOfEachSide) {
  const auto c = read_particles_text(changed(
      kDiscsInBox, "viscosity = 2.0",
      "viscosity = 2.0\nvelocity = { top = [1.0, 0.0], bottom = [-1.0, 0.0], right = \"open\", "
      "left = { parabolic = 1.5 } }"));
  const auto& sides = std::get<SideVelocities>(c.setting.fluid->boundary);
  EXPECT_EQ(sides[0].kind, WallVelocity::Kind::kParabolic);
  EXPECT_EQ(sides[0].value[0], 1.5);
  EXPECT_EQ(sides[1].kind, WallVelocity::Kind::kOpen);
  EXPECT_THAT(sides[2].value, ElementsAre(-1, 0));
  EXPECT_EQ(sides[3].kind, WallVelocity::Kind::kConstant);
  EXPECT_THAT(sides[3].value, ElementsAre(1, 0));
}

TEST(FluidCase, ReadsAFluidWithInertia) {
  const auto text =
      changed(changed(kDiscsInBox, "viscosity = 2.0", R"(viscosity = 2.0
density = 1.5
advection = "characteristics"
start = "stokes"
pressure_gradient = [-3.0, 0.5]
velocity = { left = { parabolic = 1.5, period = 2.0, amplitude = 0.5 }, right = "open", top = { constant = [ { until = 0.5, value = [1.0, 0.0] }, { until = 0.75, value = [2.0, 0.0] } ] } })"),
              "radius = 0.25\n[[particle]]", "radius = 0.25\ndensity = 4.0\n[[particle]]") +
      "density = 2.0\n";
  const auto c = read_particles_text(text);
  const auto& fluid = *c.setting.fluid;
  EXPECT_TRUE(fluid.has_inertia());
  EXPECT_EQ(fluid.density, 1.5);
  EXPECT_EQ(fluid.advection, particles::Advection::kCharacteristics);
  EXPECT_EQ(fluid.start, particles::FlowStart::kStokes);
  EXPECT_THAT(fluid.pressure_gradient, ElementsAre(-3, 0.5));
  const auto& sides = std::get<particles::SideVelocities>(fluid.boundary);
  EXPECT_EQ(sides[0].kind, WallVelocity::Kind::kParabolic);
  EXPECT_EQ(sides[0].at(0)[0], 1.5);
  EXPECT_DOUBLE_EQ(sides[0].at(0.5)[0], 1.5 * 1.5);  // a quarter of the period
  EXPECT_THAT(sides[3].at(0.25), ElementsAre(1, 0));
  EXPECT_THAT(sides[3].at(2), ElementsAre(2, 0));  // after the last piece
  const double area = 3.141592653589793 * 0.25 * 0.25;
  EXPECT_THAT(c.particles.masses, ElementsAre(4 * area, 2 * area));
}

TEST(ParticlesCase, DensityGivesTheMassOfADiscWithoutAFluid) {
  const auto c =
      read_particles_text(changed(std::string(kDryDiscs), "mass = 1.0", "density = 3.0"));
  EXPECT_DOUBLE_EQ(c.particles.masses[0], 3.0 * std::numbers::pi * 0.25 * 0.25);
  EXPECT_EQ(c.particles.masses[1], 1.0);
}

TEST(FluidCase, ReadsAGradientThatPulsates) {
  const auto c = read_particles_text(
      changed(changed(changed(kDiscsInBox, "6.0] }", "6.0], periodic = [true, true] }"),
                      "viscosity = 2.0",
                      "viscosity = 2.0\ndensity = 1.0\npressure_gradient = { value = [2.0, -1.0], "
                      "period = 4.0, amplitude = 0.5 }"),
              "radius = 0.25\n[[particle]]", "radius = 0.25\ndensity = 4.0\n[[particle]]") +
      "density = 2.0\n");
  EXPECT_THAT(c.setting.fluid->pressure_gradient_at(0), ElementsAre(2, -1));
  EXPECT_THAT(c.setting.fluid->pressure_gradient_at(1), ElementsAre(3, -1.5));
}

TEST(FluidCase, ReadsAGradientOfStokesFlowAlongAPeriodAndBesideAnOpenSide) {
  for (const auto& [periodic, gradient, velocity] :
       {std::array{"true, false", "[-3.0, 0.0]", ""},
        {"false, true", "[0.0, 2.0]", ""},
        {"false, false", "[1.0, 2.0]", "velocity = { left = \"open\" }\n"},
        {"true, false", "[1.0, 2.0]", "velocity = { top = \"open\" }\n"},
        {"false, false", "[0.0, 0.0]", ""}})
    EXPECT_NO_THROW((void)read_particles_text(changed(
        changed(kDiscsInBox, "6.0] }", std::string("6.0], periodic = [") + periodic + "] }"),
        "viscosity = 2.0",
        std::string("viscosity = 2.0\n") + velocity + "pressure_gradient = " + gradient)))
        << periodic << gradient;
}

TEST(FluidCase, ReadsPlatesAndProbes) {
  const auto c = read_particles_text(
      changed(kDiscsInBox, "radius = 0.25\n[[particle]]",
              "radius = 0.25\nlength = 1.5\nangle = 1.5\ndensity = 2.0\n[[particle]]") +
      "[[probe]]\nname = \"in-1\"\nfrom = [0.5, 0.0]\nto = [1.0, 6.0]\n");
  const auto& fluid = *c.setting.fluid;
  EXPECT_EQ(c.particles.shape(0), Shape::plate(0.75, 0.25));
  EXPECT_EQ(c.particles.shape(1), Shape::disc(c.particles.radii[1]));
  EXPECT_EQ(c.particles.radii[0], 0.75);
  EXPECT_DOUBLE_EQ(c.particles.masses[0], 2 * (3.141592653589793 / 16 + 0.5));
  EXPECT_DOUBLE_EQ(c.particles.inertias[0],
                   Shape::plate(0.75, 0.25).inertia(c.particles.masses[0]));
  ASSERT_EQ(fluid.probes.size(), 1U);
  EXPECT_EQ(fluid.probes[0].name, "in-1");
  EXPECT_THAT(fluid.probes[0].to, ElementsAre(1, 6));
}

TEST(FluidCase, FluxesThatBalanceNeedNoOpenSide) {
  // In through the left by a parabola: 2/3 1.5 6 = 6; out through the bottom: 3 times 2.
  const auto c = read_particles_text(
      changed(kDiscsInBox, "viscosity = 2.0",
              "viscosity = 2.0\nvelocity = { left = { parabolic = 1.5 }, bottom = [0.0, -3.0] }"));
  EXPECT_TRUE(std::holds_alternative<SideVelocities>(c.setting.fluid->boundary));
}

TEST(FluidCase, ReadsParticlesWithTheirRotationAndGivenMotions) {
  const auto text =
      changed(changed(kDiscsInDisc, "force = [0.0, -1.0]",
                      "torque = [ { until = 0.25, value = 2.0 }, { until = 1.0, value = -1.0 } ]\n"
                      "force = [0.0, -1.0]\nangle = 0.5\nangular_velocity = 0.75\nmass = 3.0"),
              "mass = 2.0",
              "mass = 2.0\nmoment_of_inertia = 0.125\n"
              "velocity_given = { value = [1.0, 2.0], angular_velocity = 3.0 }");
  const auto c = read_particles_text(text + "[[particle]]\ncentre = [-4.0, 0.0]\nradius = 1.0\n" +
                                     "fixed = true\n");
  const auto& p = c.particles;
  EXPECT_THAT(p.masses, ElementsAre(3, 2, 0));
  EXPECT_THAT(p.angles, ElementsAre(0.5, 0, 0));
  EXPECT_THAT(p.angular_velocities, ElementsAre(0.75, 3, 0));
  EXPECT_THAT(p.inertias, ElementsAre(1.5, 0.125, 0));
  EXPECT_THAT(p.velocities, ElementsAre(0, 0, 1, 2, 0, 0));
  EXPECT_EQ(c.setting.torques.size(), 1U);
  EXPECT_THAT(c.setting.torques.at(0).mean(0, 0.25), ElementsAre(0, 0, 2));
  EXPECT_THAT(c.setting.torques.at(0).mean(0.5, 1), ElementsAre(0, 0, -1));
  EXPECT_EQ(c.setting.given_motions.size(), 2U);
  EXPECT_THAT(c.setting.given_motions.at(1).velocity.mean(0, 1), ElementsAre(1, 2, 0));
  EXPECT_THAT(c.setting.given_motions.at(1).angular_velocity.mean(0, 1), ElementsAre(0, 0, 3));
  EXPECT_THAT(c.setting.given_motions.at(2).velocity.mean(0, 1), ElementsAre(0, 0, 0));
}

TEST(FluidCase, SpheresOnAnAxisHaveOneNumberEach) {
  for (const auto* gravity : {"gravity = [-1.0]", "gravity = -1.0"}) {
    const auto c = read_particles_text(changed(kSpheresOnAxis, "gravity = [-1.0]", gravity));
    const auto& p = c.particles;
    EXPECT_EQ(p.dimension, 1);
    EXPECT_THAT(c.setting.gravity, ElementsAre(-1, 0, 0));
    EXPECT_THAT(p.positions, ElementsAre(2, 6));
    EXPECT_THAT(p.velocities, ElementsAre(0, -0.5));
    EXPECT_THAT(p.masses, ElementsAre(1, 0));
    EXPECT_THAT(p.angles, IsEmpty());
    EXPECT_THAT(p.inertias, IsEmpty());
    EXPECT_THAT(c.setting.forces.at(1).mean(0.5, 1), ElementsAre(3, 0, 0));
    const auto& cylinder = std::get<CylinderDomain>(c.setting.domain);
    EXPECT_EQ(cylinder.radius, 5);
    EXPECT_EQ(cylinder.height, 10);
  }
}

TEST(FluidCase, ParticlesOfAFileGetTheInertiaOfDiscs) {
  const TemporaryFolder folder;
  folder.file("discs.csv", "x,y,radius,mass,angle\n1,1,0.5,4,0.25\n1,4,0.5,0,0\n");
  const auto text = std::string(kDiscsInBox);
  const auto c =
      read_particles_case(folder.file("case.toml", text.substr(0, text.find("[[particle]]")) +
                                                       "[particles]\nfile = \"discs.csv\""));
  EXPECT_THAT(c.particles.masses, ElementsAre(4, 0));
  EXPECT_THAT(c.particles.angles, ElementsAre(0.25, 0));
  EXPECT_THAT(c.particles.inertias, ElementsAre(0.5, 0));
}

TEST(FluidCase, ContactLawHasTheViscosityOfTheFluid) {
  const auto with = [](const char* law) {
    return read_particles_text(
               changed(kDiscsInDisc, "end_time = 1.0", std::string("end_time = 1.0\n") + law))
        .setting.laws.film;
  };
  EXPECT_EQ(with("roughness = 1e-3").viscosity, 2.0);
  EXPECT_EQ(with("roughness = 1e-3\nviscosity = 5.0").viscosity, 5.0);
  EXPECT_FALSE(with("gamma_min = -1.0").viscosity);
  EXPECT_FALSE(with("").viscosity);
}

TEST(FluidCase, DefaultThresholdGapIsAtMostHalfOfTheSmallestGap) {
  // Between the discs of radii 1 and 0.5 remains a gap of 0.01.
  const auto c = read_particles_text(changed(kDiscsInDisc, "[3.0, 0.0]", "[1.51, 0.0]"));
  EXPECT_NEAR(c.setting.fluid->threshold_gap, 0.005, 1e-15);
  // Between the lower disc and the floor remains a gap of 0.02 of 0.0125 = 0.05 radii.
  const auto floor = read_particles_text(changed(kDiscsInBox, "[0.5, 1.0]", "[0.5, 0.27]"));
  EXPECT_NEAR(floor.setting.fluid->threshold_gap, 0.01, 1e-15);
  // The upper disc and the image of the lower one, beyond the top, have a gap of 0.004.
  const auto period = read_particles_text(
      changed(changed(changed(kDiscsInBox, "6.0] }", "6.0], periodic = [false, true] }"),
                      "[0.5, 1.0]", "[0.5, 0.25]"),
              "[1.2, 3.0]", "[0.5, 5.746]"));
  EXPECT_NEAR(period.setting.fluid->threshold_gap, 0.002, 1e-12);
}

TEST(FluidCase, DefaultThresholdGapIsAtLeastTheGapAtWhichTheSolidsTouch) {
  const auto rough = [](const char* roughness) {
    return read_particles_text(changed(kDiscsInDisc, "end_time = 1.0",
                                       std::string("end_time = 1.0\nroughness = ") + roughness))
        .setting.fluid->threshold_gap;
  };
  EXPECT_EQ(rough("0.01"), 0.025);
  EXPECT_EQ(rough("0.05"), 0.1);
}

TEST(FluidCase, PairMayStartInContactAtTheThresholdGap) {
  const auto c = read_particles_text(
      changed(changed(kDiscsInDisc, "viscosity = 2.0", "viscosity = 2.0\nthreshold_gap = 0.1"),
              "[3.0, 0.0]", "[1.6, 0.0]"));
  EXPECT_EQ(c.setting.fluid->threshold_gap, 0.1);
}

TEST(FluidCase, DrivenNeighboursMayBeCloserThanTheThresholdGap) {
  auto text = changed(changed(kDiscsInDisc, "force = [0.0, -1.0]", "fixed = true"), "mass = 2.0",
                      "fixed = true");
  text = changed(changed(text, "[3.0, 0.0]", "[1.51, 0.0]"), "viscosity = 2.0",
                 "viscosity = 2.0\nthreshold_gap = 0.1");
  EXPECT_EQ(read_particles_text(text).setting.given_motions.size(), 2U);
}

TEST(FluidCase, SplittingNeedsNoMassOfDrivenParticles) {
  const auto text = changed(changed(kDiscsInDisc, "force = [0.0, -1.0]", "fixed = true"),
                            "viscosity = 2.0", "viscosity = 2.0\ncoupling = \"splitting\"");
  EXPECT_EQ(read_particles_text(text).setting.fluid->coupling, Coupling::kSplitting);
}

TEST(FluidCase, LatticeOfOneLargeDiscIsAccepted) {
  // Area fraction 0.5 in the unit cell, strained as a lattice.
  auto text = changed(kDiscsInBox, "[2.0, 6.0]", "[1.0, 1.0], periodic = [true, true]");
  text = changed(text, "viscosity = 2.0", "viscosity = 2.0\nvelocity = { strain_rate = 1.0 }");
  text = changed(text, "end_time = 1.0", "end_time = 0.01");
  text = text.substr(0, text.find("[[particle]]")) +
         "[[particle]]\ncentre = [0.5, 0.5]\nradius = 0.3989\n";
  EXPECT_EQ(read_particles_text(text).particles.count(), 1U);
}

TEST(FluidCase, FilesOfTheSolverAreBesideTheCase) {
  const TemporaryFolder folder;
  folder.file("solver.py", "");
  const auto c = read_particles_case(folder.file(
      "case.toml", changed(kDiscsInBox, "viscosity = 2.0",
                           "viscosity = 2.0\nsolver = [\"python3\", \"solver.py\", \"--fast\"]")));
  EXPECT_THAT(c.setting.fluid->solver,
              ElementsAre("python3", (folder.path() / "solver.py").string(), "--fast"));
}

TEST(DomainCase, IsAllowedWithoutAFluid) {
  const auto c = read_particles_text(
      changed(kDryDiscs, "[viscous_contact]",
              "[domain]\nbox = { from = [0.0, 0.0], to = [2.0, 6.0], periodic = [true, false] }\n"
              "[viscous_contact]"));
  EXPECT_FALSE(c.setting.fluid);
  EXPECT_THAT(periods_of(c.setting.domain), ElementsAre(2, 0, 0));
  EXPECT_THAT(c.particles.angles, IsEmpty());
}

}  // namespace
}  // namespace viscontact::particles
