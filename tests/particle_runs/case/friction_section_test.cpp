// [friction], rotation and the scheme of a case of many particles: what is read and what is
// refused.
#include <gmock/gmock.h>

#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"

namespace viscontact::particles {
namespace {

using ::testing::ElementsAre;

class FrictionSection : public ::testing::Test {
 protected:
  /// A case with these lines in [viscous_contact], in sections of their own, and in the particle.
  ParticlesCase read(const std::string& contact, const std::string& sections,
                     const std::string& particle, int dimension = 2) const {
    const bool space = dimension == 3;
    return read_particles_case(folder_.file(
        "case.toml", "title = \"Friction\"\n[space]\ndimension = " + std::to_string(dimension) +
                         "\n[viscous_contact]\ntime_step = 0.1\nend_time = 1.0\n" + contact + "\n" +
                         sections +
                         "\n[[particle]]\ncentre = " + (space ? "[0.0, 0.0, 0.0]" : "[0.0, 0.0]") +
                         "\nradius = 0.5\nmass = 2.0\n[[particle]]\ncentre = " +
                         (space ? "[3.0, 0.0, 0.0]" : "[3.0, 0.0]") +
                         "\nradius = 1.0\nmass = 2.0\n" + particle + "\n"));
  }
  Error refused(const std::string& contact, const std::string& sections,
                const std::string& particle, int dimension = 2) const {
    return bad_input([&] { read(contact, sections, particle, dimension); });
  }
  TemporaryFolder folder_;
};

TEST_F(FrictionSection, MakesParticlesTurn) {
  const auto c = read("gamma_min = -1.0", "[friction]\ncoefficient = 0.3", "");
  ASSERT_TRUE(c.setting.laws.friction.has_value());
  EXPECT_EQ(c.setting.laws.friction->coefficient, 0.3);
  EXPECT_EQ(c.setting.laws.friction->method, FrictionMethod::kCoulomb);
  EXPECT_THAT(c.particles.inertias, ElementsAre(0.25, 1));
  EXPECT_THAT(c.particles.angular_velocities, ElementsAre(0, 0));
  const auto convex =
      read("gamma_min = 0", "[friction]\ncoefficient = 0.0\nmethod = \"convex\"", "", 3);
  EXPECT_EQ(convex.setting.laws.friction->method, FrictionMethod::kConvex);
  EXPECT_THAT(convex.particles.inertias, ElementsAre(0.2, 0.8));
}

TEST_F(FrictionSection, CoulombsLawHasAFormerWordThatIsAWarning) {
  const auto with = [&](const std::string& method) {
    return read("gamma_min = -1.0", "[friction]\ncoefficient = 0.3\nmethod = " + method, "");
  };
  const auto now = with("\"coulomb\""), before = with("\"fixed_point\"");
  EXPECT_EQ(now.setting.laws.friction->method, FrictionMethod::kCoulomb);
  EXPECT_EQ(before.setting.laws.friction->method, FrictionMethod::kCoulomb);
  EXPECT_TRUE(now.warnings.empty());
  EXPECT_EQ(before.warnings.size(), 1U);
}

TEST_F(FrictionSection, WithoutItParticlesTurnOnlyIfAKeyAsksForIt) {
  EXPECT_FALSE(read("", "", "").particles.turn());
  const auto disc = read("", "", "angular_velocity = 2.0\nangle = 0.5\nmoment_of_inertia = 7.0");
  EXPECT_THAT(disc.particles.angular_velocities, ElementsAre(0, 2));
  EXPECT_THAT(disc.particles.angles, ElementsAre(0, 0.5));
  EXPECT_THAT(disc.particles.inertias, ElementsAre(0.25, 7));
  const auto sphere =
      read("", "", "angular_velocity = [1.0, 2.0, 3.0]\ntorque = [0.0, 4.0, 0.0]", 3);
  EXPECT_THAT(sphere.particles.angular_velocities, ElementsAre(0, 0, 0, 1, 2, 3));
  EXPECT_THAT(sphere.particles.orientations, ElementsAre(1, 0, 0, 0, 1, 0, 0, 0));
  EXPECT_THAT(sphere.setting.torques.at(1).mean(0, 1), ElementsAre(0, 4, 0));
}

TEST_F(FrictionSection, InAFluidIsThatOfDiscsThatDoNotRebound) {
  const std::string fluid =
      "[fluid]\nviscosity = 1.0\nthreshold_gap = 0.02\n"
      "[domain]\nbox = { from = [-3.0, -3.0], to = [6.0, 3.0] }\n";
  const std::string friction = "[friction]\ncoefficient = 0.3\n";
  EXPECT_EQ(read("gamma_min = 0.0", fluid + friction, "").setting.laws.friction->coefficient, 0.3);
  EXPECT_THAT(refused("gamma_min = 0.0", fluid + friction + "method = \"convex\"\n", ""),
              IsAt("case.toml:15", "friction.method"));
  EXPECT_THAT(refused("gamma_min = 0.0\nrestitution = 0.5", fluid + friction, ""),
              IsAt("case.toml:15", "friction.coefficient"));
}

TEST_F(FrictionSection, WrongValuesAreRefusedWithTheirLines) {
  EXPECT_THAT(refused("gamma_min = 0", "[friction]\ncoefficient = -0.1", ""),
              IsAt("case.toml:9", "friction.coefficient"));
  EXPECT_THAT(refused("gamma_min = 0", "[friction]\nmethod = \"convex\"", ""),
              IsAt("case.toml:8", "friction.coefficient"));
  EXPECT_THAT(refused("gamma_min = 0", "[friction]\ncoefficient = 0.1\nmethod = \"fast\"", ""),
              IsAt("case.toml:10", "friction.method"));
  EXPECT_THAT(refused("", "[friction]\ncoefficient = 0.1", ""),
              IsAt("case.toml:9", "friction.coefficient"));
  EXPECT_THAT(refused("", "", "moment_of_inertia = 0.0"),
              IsAt("case.toml:17", "particle[1].moment_of_inertia"));
  EXPECT_THAT(refused("", "", "angle = 1.0", 3), IsAt("case.toml:17", "particle[1].angle"));
}

TEST_F(FrictionSection, RestitutionIsAShareAndNeedsSolidContact) {
  EXPECT_EQ(read("gamma_min = 0", "", "").setting.laws.restitution.coefficient, 0);
  EXPECT_EQ(read("gamma_min = 0\nrestitution = 0.97", "", "").setting.laws.restitution.coefficient,
            0.97);
  EXPECT_FALSE(read("restitution = 0.0", "", "").setting.laws.restitution.is_on());
  EXPECT_THAT(refused("gamma_min = 0\nrestitution = 1.01", "", ""),
              IsAt("case.toml:8", "viscous_contact.restitution"));
  EXPECT_THAT(refused("restitution = 0.5", "", ""),
              IsAt("case.toml:7", "viscous_contact.restitution"));
}

TEST_F(FrictionSection, TheSchemeIsEulerUnlessGiven) {
  EXPECT_EQ(read("", "", "").setting.scheme, Scheme::kEuler);
  EXPECT_EQ(read("scheme = \"leapfrog\"", "", "").setting.scheme, Scheme::kLeapfrog);
  EXPECT_THAT(refused("scheme = \"verlet\"", "", ""),
              IsAt("case.toml:7", "viscous_contact.scheme"));
}

TEST_F(FrictionSection, MeansOverTimeBeginBeforeTheEnd) {
  EXPECT_EQ(read("", "", "").average_from, 0);
  EXPECT_EQ(read("", "[output]\naverage_from = 0.25", "").average_from, 0.25);
  EXPECT_THAT(refused("", "[output]\naverage_from = 1e9", ""),
              IsAt("case.toml:9", "output.average_from"));
}

/// The tables that [output] asks for, in a case of two discs.
TEST_F(FrictionSection, TablesThatACaseCannotHaveAreRefused) {
  EXPECT_THAT(read("", "[output]\ntables = [\"contacts\", \"motion\"]", "").tables,
              ElementsAre("contacts", "motion"));
  EXPECT_THAT(refused("", "[output]\ntables = [\"forces\"]", ""),
              IsAt("case.toml:9", "output.tables"));
  EXPECT_THAT(refused("", "[output]\ntables = [\"walls\"]", ""),
              IsAt("case.toml:9", "output.tables"));
  EXPECT_THAT(refused("", "[output]\ntables = [\"stress\"]", ""),
              IsAt("case.toml:9", "output.tables"));
}

TEST_F(FrictionSection, ColumnsThatStepsDoNotHaveAreRefused) {
  EXPECT_THAT(read("", "", "").step_columns, ElementsAre());
  EXPECT_THAT(read("", "[output]\nstep_columns = [\"solver_stages\"]", "").step_columns,
              ElementsAre("solver_stages"));
  EXPECT_THAT(refused("", "[output]\nstep_columns = [\"residual\"]", ""),
              IsAt("case.toml:9", "output.step_columns"));
}

}  // namespace
}  // namespace viscontact::particles
