// Cases of spheres with pairwise lubrication: what is read and what is refused.
#include <gmock/gmock.h>

#include <limits>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"

namespace viscontact::particles {
namespace {

using ::testing::ElementsAre;

const std::string kBox =
    "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [8.0, 9.0, 10.0], periodic = [true, true, "
    "true] }\n";
const std::string kSphere = "[[particle]]\ncentre = [2.0, 2.0, 2.0]\nradius = 1.0\n";
const std::string kShear = "velocity = { shear_rate = -4.0 }\n";
const std::string kTimes = "time_step = 0.1\nend_time = 1.0\n";

class LubricationSection : public ::testing::Test {
 protected:
  ParticlesCase read(const std::string& lubrication, const std::string& contact = kTimes,
                     const std::string& sections = kBox + kSphere, int dimension = 3) const {
    return read_particles_case(folder_.file(
        "case.toml", "title = \"Suspension\"\n[space]\ndimension = " + std::to_string(dimension) +
                         "\n[lubrication]\nviscosity = 2.0\n" + lubrication +
                         "[viscous_contact]\n" + contact + sections));
  }
  Error refused(const std::string& lubrication, const std::string& contact = kTimes,
                const std::string& sections = kBox + kSphere, int dimension = 3) const {
    return bad_input([&] { read(lubrication, contact, sections, dimension); });
  }
  TemporaryFolder folder_;
};

TEST_F(LubricationSection, HasTheDefaultsOfItsKeys) {
  const auto c = read("");
  const auto& pairs = c.setting.lubrication.value();
  EXPECT_EQ(pairs.viscosity, 2);
  EXPECT_EQ(pairs.pairs, PairTerms::kTables);
  EXPECT_EQ(pairs.range, 0.5);
  EXPECT_EQ(pairs.regularisation, 0);
  EXPECT_EQ(pairs.drag, 1);
  EXPECT_EQ(pairs.roughness, 0);
  EXPECT_FALSE(pairs.stress || pairs.repulsion || c.compares);
  EXPECT_EQ(c.particles.masses, std::vector{0.0});
  EXPECT_TRUE(c.particles.turn());
}

TEST_F(LubricationSection, GivesEachKeyItsPlace) {
  const auto c = read(
      "pairs = \"near_contact\"\nrange = 0.4\nregularisation = 1e-3\ndrag = 0.5\noffset = 1.5\n"
      "compare = true\n" +
          kShear,
      kTimes + "roughness = 2e-3\nrepulsion = { amplitude = 3.0, length = 0.02 }\n",
      kBox + kSphere + "mass = 5.0\n[friction]\ncoefficient = 0.5\n");
  const auto& pairs = c.setting.lubrication.value();
  EXPECT_EQ(pairs.pairs, PairTerms::kNearContact);
  EXPECT_EQ(pairs.range, 0.4);
  EXPECT_EQ(pairs.regularisation, 1e-3);
  EXPECT_EQ(pairs.drag, 0.5);
  EXPECT_EQ(pairs.offset, 1.5);
  EXPECT_TRUE(c.compares);
  EXPECT_EQ(pairs.roughness, 2e-3);
  EXPECT_EQ(pairs.repulsion.value().amplitude, 3);
  EXPECT_EQ(pairs.repulsion.value().length, 0.02);
  EXPECT_EQ(c.particles.masses, std::vector{5.0});
}

TEST_F(LubricationSection, GivesContactAloneTheFilmOfViscousContact) {
  const auto film_of = [&](const std::string& keys, const std::string& roughness) {
    return read(keys, kTimes + roughness,
                kSphere + "[[particle]]\ncentre = [6.0, 6.0, 6.0]\nradius = 2.0\n")
        .setting.laws.film;
  };
  const auto film = film_of("pairs = \"none\"\n", "roughness = 0.01\n");
  EXPECT_EQ(film.viscosity, 2);
  // The solids touch at the gap of 0.01 times the mean of the radii 1 and 2.
  EXPECT_DOUBLE_EQ(2 * film.roughness.value(), 0.015);
  EXPECT_DOUBLE_EQ(film.lowest_gamma(1, 2),
                   impulse_of_film(FilmShape::kSpheres, 2, 1, 2, 2.0 / 3, 0.015));
  EXPECT_EQ(film_of("pairs = \"none\"\n", "").lowest_gamma(1, 2),
            -std::numeric_limits<double>::infinity());
  EXPECT_FALSE(film_of("", "roughness = 0.01\n").viscosity);
}

TEST_F(LubricationSection, ReadsEachFlow) {
  const auto of = [&](const std::string& flow, const std::string& domain) {
    return read("velocity = { " + flow + " }\n", "end_time = 0.0\n", domain + kSphere)
        .setting.lubrication.value();
  };
  EXPECT_THAT(of("shear_rate = 3.0", kBox).gradient,
              ElementsAre(Vector{0, 3, 0}, Vector{}, Vector{}));
  EXPECT_THAT(of("strain_rate = 3.0", "").gradient,
              ElementsAre(Vector{3, 0, 0}, Vector{0, -3, 0}, Vector{}));
  EXPECT_THAT(of("gradient = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]]", "").gradient,
              ElementsAre(Vector{1, 2, 3}, Vector{4, 5, 6}, Vector{7, 8, -6}));
  const auto with_stress = of("stress = 7.0", kBox);
  EXPECT_EQ(with_stress.stress, 7);
  EXPECT_THAT(with_stress.gradient, ElementsAre(Vector{0, 1, 0}, Vector{}, Vector{}));
}

TEST_F(LubricationSection, TurnsStrainsIntoTimesByTheRate) {
  const auto c = read(kShear, "strain_step = 0.01\nend_strain = 10.0\n");
  EXPECT_DOUBLE_EQ(c.setting.time_step, 0.0025);
  EXPECT_DOUBLE_EQ(c.end_time, 2.5);
  EXPECT_DOUBLE_EQ(c.frame_interval, 0.025);
  // E:E of the strain rate 2 is 8, so that the rate is 4.
  EXPECT_DOUBLE_EQ(
      read("velocity = { strain_rate = 2.0 }\n", "time_step = 0.1\nend_strain = 6.0\n", kSphere)
          .end_time,
      1.5);
}

TEST_F(LubricationSection, NeedsNoStepForAnInstant) {
  const auto c = read(kShear, "end_time = 0\n");
  EXPECT_EQ(c.end_time, 0);
  EXPECT_GT(c.setting.time_step, 0);
  EXPECT_GT(c.frame_interval, 0);
  EXPECT_EQ(read(kShear, "end_strain = 0\n").end_time, 0);
}

TEST_F(LubricationSection, RefusesTimesAndStrainsThatDoNotFit) {
  EXPECT_THAT(refused(kShear, "strain_step = 0.01\n"),
              IsAt("case.toml", "viscous_contact.end_time"));
  EXPECT_THAT(refused(kShear, "end_strain = 1.0\n"),
              IsAt("case.toml", "viscous_contact.time_step"));
  EXPECT_THAT(refused(kShear, kTimes + "end_strain = 1.0\n"),
              IsAt("case.toml:10", "viscous_contact.end_strain"));
  EXPECT_THAT(refused(kShear, kTimes + "strain_step = 1.0\n"),
              IsAt("case.toml:10", "viscous_contact.strain_step"));
  EXPECT_THAT(refused("", "end_strain = 1.0\ntime_step = 0.1\n"),
              IsAt("case.toml:7", "viscous_contact.end_strain"));
  EXPECT_THAT(refused("velocity = { stress = 1.0 }\n"),
              IsAt("case.toml:9", "viscous_contact.end_time"));
  EXPECT_THAT(refused(kShear, "strain_step = 2.0\nend_strain = 1.0\n"),
              IsAt("case.toml:8", "viscous_contact.strain_step"));
  EXPECT_THAT(refused(kShear, "time_step = 1e-12\nend_time = 1.0\n"),
              IsAt("case.toml:8", "viscous_contact.time_step"));
}

TEST_F(LubricationSection, RefusesFlowsThatItCannotCompute) {
  const auto of = [&](const std::string& flow, const std::string& domain = kBox) {
    return refused("velocity = { " + flow + " }\n", kTimes, domain + kSphere);
  };
  EXPECT_THAT(of(""), IsAt("case.toml:6", "lubrication.velocity.shear_rate"));
  EXPECT_THAT(of("shear_rate = 1.0, stress = 1.0"),
              IsAt("case.toml:6", "lubrication.velocity.stress"));
  EXPECT_THAT(of("strain_rate = 1.0"), IsAt("case.toml:6", "lubrication.velocity.strain_rate"));
  EXPECT_THAT(of("gradient = [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]"),
              IsAt("case.toml:6", "lubrication.velocity.gradient"));
  EXPECT_THAT(of("gradient = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]", ""),
              IsAt("case.toml:6", "lubrication.velocity.gradient"));
  EXPECT_THAT(of("gradient = [[1.0, 0.0, 0.0]]", ""),
              IsAt("case.toml:6", "lubrication.velocity.gradient"));
  EXPECT_THAT(of("stress = 1.0", ""), IsAt("case.toml:6", "lubrication.velocity.stress"));
}

TEST_F(LubricationSection, FindsOverlapsAcrossDisplacedImages) {
  // The image of the first sphere across y is at x = 1 + offset, y = 9.2.
  const auto spheres = [](const std::string& x) {
    return kBox + "[[particle]]\ncentre = [1.0, 0.2, 2.0]\nradius = 1.0\n[[particle]]\ncentre = [" +
           x + ", 8.8, 2.0]\nradius = 1.0\n";
  };
  EXPECT_THAT(refused("", kTimes, spheres("1.5")), IsAt("case.toml:14"));
  EXPECT_EQ(read("offset = 3.0\n", kTimes, spheres("1.5")).setting.lubrication->offset, 3);
  EXPECT_EQ(read("", kTimes, spheres("4.5")).particles.count(), 2U);
  EXPECT_THAT(refused("offset = 3.0\n", kTimes, spheres("4.5")), IsAt("case.toml:15"));
  // Displaced by more than a period along x, and across x.
  EXPECT_THAT(refused("offset = -13.0\n", kTimes, spheres("4.5")), IsAt("case.toml:15"));
  EXPECT_THAT(refused("offset = -1.0\n", kTimes, spheres("7.5")), IsAt("case.toml:15"));
  // Within the cell as without an offset.
  EXPECT_THAT(refused("offset = 3.0\n", kTimes,
                      kBox + kSphere + "[[particle]]\ncentre = [3.0, 2.0, 2.0]\nradius = 1.0\n"),
              IsAt("case.toml:15"));
  EXPECT_THAT(refused("offset = 3.0\n", kTimes, kBox + "[arrangement]\ncount = 2\nradius = 1.0\n"),
              IsAt("case.toml:6", "lubrication.offset"));
}

TEST_F(LubricationSection, RefusesKeysWithoutAnEffect) {
  EXPECT_THAT(refused("pairs = \"none\"\nrange = 0.5\n"), IsAt("case.toml:7", "lubrication.range"));
  EXPECT_THAT(refused("pairs = \"none\"\ncompare = true\n"),
              IsAt("case.toml:7", "lubrication.compare"));
  EXPECT_THAT(refused("offset = 1.0\n", kTimes, kSphere),
              IsAt("case.toml:6", "lubrication.offset"));
  for (const std::string key :
       {"gamma_min = -1.0", "viscosity = 1.0", "restitution = 0.5", "scheme = \"leapfrog\""})
    EXPECT_THAT(refused("", kTimes + key + "\n"),
                IsAt("case.toml:9", "viscous_contact." + key.substr(0, key.find(' '))));
  const std::string friction = "[friction]\ncoefficient = 0.5\n";
  EXPECT_THAT(refused("", kTimes, kBox + kSphere + friction),
              IsAt("case.toml:15", "friction.coefficient"));
  const auto without_roughness = refused("pairs = \"none\"\n", kTimes, kBox + kSphere + friction);
  EXPECT_THAT(without_roughness, IsAt("case.toml:16", "friction.coefficient"));
  EXPECT_THAT(without_roughness.what(), ::testing::Not(::testing::HasSubstr("near_contact")));
  EXPECT_THAT(refused("", kTimes + "roughness = 1e-3\n",
                      kBox + kSphere + friction + "method = \"convex\"\n"),
              IsAt("case.toml:17", "friction.method"));
  for (const std::string key :
       {"velocity = [1.0, 0.0, 0.0]", "angular_velocity = [1.0, 0.0, 0.0]",
        "moment_of_inertia = 1.0", "fixed = true", "velocity_given = { value = [1.0, 0.0, 0.0] }"})
    EXPECT_THAT(refused("", kTimes, kBox + kSphere + key + "\n"),
                IsAt("case.toml:14", "particle[0]." + key.substr(0, key.find(' '))));
}

TEST_F(LubricationSection, RefusesWhatItCannotStandBeside) {
  EXPECT_THAT(refused("", kTimes, "[[particle]]\ncentre = [0.0, 0.0]\nradius = 1.0\n", 2),
              IsAt("case.toml:3", "space.dimension"));
  for (const std::string section :
       {"[fluid]\nviscosity = 1.0\n", "[[membrane]]\n", "[[source]]\n", "[[body]]\n", "[[hinge]]\n",
        "[[spring]]\n", "[[arm]]\n", "[[plane]]\n", "[solver]\n"}) {
    const auto begin = section.find_first_not_of('[');
    EXPECT_THAT(refused("", kTimes, kBox + kSphere + section),
                IsAt("case.toml:14", section.substr(begin, section.find(']') - begin)));
  }
  EXPECT_THAT(refused("", kTimes,
                      "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [9.0, 9.0, 9.0], periodic = "
                      "[true, true, false] }\n" +
                          kSphere),
              IsAt("case.toml:10", "domain.box.periodic"));
  EXPECT_THAT(refused("", kTimes,
                      "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [9.0, 4.9, 9.0], periodic = "
                      "[true, true, true] }\n" +
                          kSphere),
              IsAt("case.toml:10", "domain.box.to"));
  EXPECT_THAT(refused("range = 2.5\n"), IsAt("case.toml:6", "lubrication.range"));
  EXPECT_EQ(read("range = 100.0\n", kTimes, kSphere).setting.lubrication->range, 100);
  EXPECT_THAT(refused("range = 101.0\n", kTimes, kSphere),
              IsAt("case.toml:6", "lubrication.range"));
  EXPECT_THAT(refused("inertia = true\n"), IsAt("case.toml:6", "lubrication.inertia"));
}

}  // namespace
}  // namespace viscontact::particles
