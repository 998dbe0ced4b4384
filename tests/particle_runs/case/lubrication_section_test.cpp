// Cases of spheres with pairwise lubrication: what is read and what is refused.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
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

TEST_F(LubricationSection, HasGravityForMassesAlone) {
  const auto read_with = [&](const std::string& sphere) {
    return read_particles_case(
        folder_.file("case.toml",
                     "title = \"Fall\"\n[space]\ndimension = 3\ngravity = [0.0, 0.0, -1.0]\n"
                     "[lubrication]\nviscosity = 2.0\n[viscous_contact]\n" +
                         kTimes + kBox + kSphere + sphere));
  };
  EXPECT_THAT(bad_input([&] { read_with(""); }), IsAt("case.toml:4", "space.gravity"));
  EXPECT_EQ(read_with("mass = 3.0\n").particles.masses, std::vector{3.0});
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

TEST_F(LubricationSection, ReadsFlowsThatChangeInTime) {
  const auto of = [&](const std::string& flow, const std::string& domain = kBox) {
    return read("velocity = { " + flow + " }\n", kTimes, domain + kSphere)
        .setting.lubrication.value();
  };
  const auto pieces =
      of("shear_rate = [ { until = 0.3, value = 2.0 }, { until = 1.0, value = -1.0 } ]");
  ASSERT_EQ(pieces.pieces.size(), 2U);
  EXPECT_EQ(pieces.gradient[0][1], 2);
  EXPECT_EQ(pieces.flow_at(0.2).gradient[0][1], 2);
  EXPECT_EQ(pieces.flow_at(0.9).gradient[0][1], -1);
  EXPECT_FALSE(pieces.wave || pieces.stress);
  const auto strain =
      of("strain_rate = [ { until = 0.3, value = 2.0 }, { until = 1.5, value = 0.0 } ]", "");
  EXPECT_THAT(strain.pieces[0].gradient, ElementsAre(Vector{2, 0, 0}, Vector{0, -2, 0}, Vector{}));
  const auto gradients =
      of("gradient = [ { until = 1.0, value = [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]] "
         "}, { until = 2.0, value = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, -1.0]] } ]",
         "");
  EXPECT_THAT(gradients.pieces[1].gradient,
              ElementsAre(Vector{1, 0, 0}, Vector{}, Vector{0, 0, -1}));
  const auto stress =
      of("stress = [ { until = 0.3, value = 2.0 }, { until = 1.0, value = -1.0 } ]");
  EXPECT_EQ(stress.stress, 2);
  EXPECT_EQ(stress.flow_at(0.4).stress, -1);
  EXPECT_EQ(stress.flow_at(0.4).gradient[0][1], 1);
  const auto wave =
      of("shear_rate = { amplitude = 3.0, angular_frequency = 2.0, mean = 0.5, phase = 0.1 }");
  EXPECT_EQ(wave.gradient[0][1], 1);
  EXPECT_TRUE(wave.pieces.empty());
  EXPECT_DOUBLE_EQ(wave.factor(0.7, 0.7), 0.5 + 3 * std::sin(2 * 0.7 + 0.1));
  const auto stress_wave = of("stress = { amplitude = 3.0, angular_frequency = 2.0 }");
  EXPECT_EQ(stress_wave.stress, 1);
  EXPECT_DOUBLE_EQ(stress_wave.factor(0.7, 0.7), 3 * std::sin(1.4));
  // One piece is a constant.
  const auto constant = of("shear_rate = [ { until = 1.0, value = 2.0 } ]");
  EXPECT_TRUE(constant.pieces.empty());
  EXPECT_EQ(constant.gradient[0][1], 2);
}

TEST_F(LubricationSection, HasTheStrainsOfFlowsThatChangeInTime) {
  const auto pieces = read(
      "velocity = { shear_rate = [ { until = 2.0, value = 1.0 }, { until = 4.0, value = -4.0 } ] "
      "}\n",
      "strain_step = 0.01\nend_strain = 10.0\n");
  EXPECT_DOUBLE_EQ(pieces.end_time, 4);
  EXPECT_DOUBLE_EQ(pieces.setting.time_step, 0.0025);
  // The path of a period is 4 amplitude/frequency.
  const auto wave =
      read("velocity = { shear_rate = { amplitude = 3.0, angular_frequency = 2.0 } }\n",
           "strain_step = 0.01\nend_strain = 12.0\n");
  EXPECT_NEAR(wave.end_time, 2 * std::numbers::pi, 1e-9);
  EXPECT_DOUBLE_EQ(wave.setting.time_step, 0.01 / 3);
  // With a stress times alone are known.
  EXPECT_EQ(read("velocity = { stress = 3.0 }\n").setting.time_step, 0.1);
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
  for (const std::string key :
       {"strain_step = 0.1\nend_time = 1.0\n", "end_strain = 1.0\ntime_step = 0.1\n"})
    EXPECT_THAT(refused("velocity = { stress = 1.0 }\n", key),
                IsAt("case.toml:8", "viscous_contact." + key.substr(0, key.find(' '))));
  // The flow stops at the strain 2.
  const std::string stops =
      "velocity = { shear_rate = [ { until = 2.0, value = 1.0 }, { until = 3.0, value = 0.0 } ] "
      "}\n";
  EXPECT_THAT(refused(stops, "end_strain = 2.5\ntime_step = 0.1\n"),
              IsAt("case.toml:8", "viscous_contact.end_strain"));
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
  EXPECT_THAT(of("gradient = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]]", ""),
              IsAt("case.toml:6", "lubrication.velocity.gradient"));
  EXPECT_THAT(of("gradient = [[1.0, 0.0, 0.0]]", ""),
              IsAt("case.toml:6", "lubrication.velocity.gradient"));
  EXPECT_THAT(of("stress = 1.0", ""), IsAt("case.toml:6", "lubrication.velocity.stress"));
  EXPECT_THAT(of("shear_rate = [ { until = 2.0, value = 1.0 }, { until = 1.0, value = 2.0 } ]"),
              IsAt("case.toml:6", "lubrication.velocity.shear_rate[1].until"));
  // A piece within the rounding errors of steps of 0.1, and pieces that end before the case.
  EXPECT_THAT(
      of("shear_rate = [ { until = 0.55, value = 1.0 }, { until = 0.5500001, value = 2.0 }, "
         "{ until = 1.0, value = 1.0 } ]"),
      IsAt("case.toml:6", "lubrication.velocity.shear_rate[1].until"));
  for (const std::string pieces : {"[ { until = 0.9, value = 1.0 } ]",
                                   "[ { until = 0.3, value = 1.0 }, { until = 0.9, value = "
                                   "2.0 } ]"})
    for (const std::string key : {"shear_rate", "stress"})
      EXPECT_THAT(of(key + " = " + pieces), IsAt("case.toml:6", "lubrication.velocity." + key));
  EXPECT_THAT(of("shear_rate = { amplitude = 1.0 }"),
              IsAt("case.toml:6", "lubrication.velocity.shear_rate.angular_frequency"));
  EXPECT_THAT(of("shear_rate = { amplitude = 1.0, angular_frequency = 0.0 }"),
              IsAt("case.toml:6", "lubrication.velocity.shear_rate.angular_frequency"));
  EXPECT_THAT(of("gradient = { amplitude = 1.0, angular_frequency = 1.0 }", ""),
              IsAt("case.toml:6", "lubrication.velocity.gradient"));
  // A later piece that changes along a wall.
  EXPECT_THAT(
      of("gradient = [ { until = 1.0, value = [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, "
         "0.0]] }, { until = 2.0, value = [[0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, "
         "0.0]] } ]",
         "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [8.0, 9.0, 10.0], periodic = [true, "
         "false, "
         "true] }\n"),
      IsAt("case.toml:6", "lubrication.velocity.gradient"));
  EXPECT_THAT(
      of("gradient = [ { until = 1.0, value = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, "
         "0.0]] } ]"),
      IsAt("case.toml:6", "lubrication.velocity.gradient[0].value"));
}

TEST_F(LubricationSection, StrainsABoxThatStaysWideEnough) {
  const auto box = [](const std::string& to) {
    return "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [" + to +
           "], periodic = [true, true, true] }\n" + kSphere;
  };
  const std::string planar = "velocity = { strain_rate = 1.0 }\n";
  const std::string uniaxial =
      "velocity = { gradient = [[1.0, 0.0, 0.0], [0.0, -0.5, 0.0], [0.0, 0.0, -0.5]] }\n";
  EXPECT_TRUE(read(planar).setting.lubrication->turns_box);
  EXPECT_FALSE(read(planar + "turned = false\n").setting.lubrication->turns_box);
  EXPECT_EQ(read(uniaxial, kTimes, box("8.0, 8.0, 8.0")).particles.count(), 1U);
  // Faces come as near as 0.78 edges and must stay 5 apart.
  EXPECT_THAT(refused(uniaxial, kTimes, box("6.3, 6.3, 6.3")),
              IsAt("case.toml:11", "domain.box.to"));
  EXPECT_EQ(read(uniaxial, kTimes, box("6.5, 6.5, 6.5")).particles.count(), 1U);
  // Only a cube is turned about all axes.
  EXPECT_THAT(refused(uniaxial), IsAt("case.toml:11", "domain.box.to"));
  EXPECT_EQ(read(uniaxial + "turned = false\n").particles.count(), 1U);
  EXPECT_THAT(refused("turned = false\n"), IsAt("case.toml:6", "lubrication.turned"));
  EXPECT_THAT(refused(planar + "turned = false\n", kTimes, kSphere),
              IsAt("case.toml:7", "lubrication.turned"));
  EXPECT_THAT(refused(planar + "offset = 1.0\n"), IsAt("case.toml:7", "lubrication.offset"));
}

TEST_F(LubricationSection, TurnsABoxWhereThisHasAnEffect) {
  const std::string planar = "velocity = { strain_rate = 1.0 }\n";
  // No turn keeps images apart in this flow.
  const std::string general =
      "velocity = { gradient = [[0.3, 0.8, -0.2], [-0.1, 0.2, 0.5], [0.4, 0.0, -0.5]] }\n";
  for (const std::string turned : {"turned = true\n", "turned = false\n"}) {
    EXPECT_THAT(refused(general + turned), IsAt("case.toml:7", "lubrication.turned"));
    EXPECT_THAT(refused(kShear + turned), IsAt("case.toml:7", "lubrication.turned"));
    EXPECT_THAT(refused(planar + turned, kTimes, kSphere),
                IsAt("case.toml:7", "lubrication.turned"));
  }
  // An instant is that of the places that are given.
  EXPECT_FALSE(read(planar, "end_time = 0\n").setting.lubrication->turns_box);
  EXPECT_FALSE(read(planar + "turned = false\n", "end_time = 0\n").setting.lubrication->turns_box);
  EXPECT_THAT(refused(planar + "turned = true\n", "end_time = 0\n"),
              IsAt("case.toml:7", "lubrication.turned"));
}

TEST_F(LubricationSection, RefusesExtensionsThatGoBackTooFar) {
  const auto flow = [](const std::string& first, const std::string& then) {
    return "velocity = { strain_rate = [ { until = 9.0, value = " + first +
           " }, { until = 20.0, value = " + then + " } ] }\n";
  };
  const std::string times = "time_step = 0.1\nend_time = 19.0\n";
  // The edges of this box differ.
  EXPECT_THAT(refused(flow("-1.5", "3.0"), times),
              IsAt("case.toml:6", "lubrication.velocity.strain_rate"));
  EXPECT_EQ(read(flow("2.0", "-1.0"), times).particles.count(), 1U);
  EXPECT_EQ(
      read(flow("-1.5", "3.0"), times,
           "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [8.0, 8.0, 8.0], periodic = [true, "
           "true, true] }\n" +
               kSphere)
          .particles.count(),
      1U);
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
  // It would carry spheres into the walls.
  EXPECT_THAT(refused("offset = 1.0\n", kTimes,
                      "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [8.0, 9.0, 10.0], periodic = "
                      "[false, true, true] }\n" +
                          kSphere),
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
        "[[spring]]\n", "[[arm]]\n", "[solver]\n"}) {
    const auto begin = section.find_first_not_of('[');
    EXPECT_THAT(refused("", kTimes, kBox + kSphere + section),
                IsAt("case.toml:14", section.substr(begin, section.find(']') - begin)));
  }
  EXPECT_THAT(refused("", kTimes,
                      "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [9.0, 4.9, 9.0], periodic = "
                      "[true, true, true] }\n" +
                          kSphere),
              IsAt("case.toml:10", "domain.box.to"));
  EXPECT_THAT(refused("range = 2.5\n"), IsAt("case.toml:6", "lubrication.range"));
  EXPECT_EQ(read("range = 100.0\n", kTimes, kSphere).setting.lubrication->range, 100);
  EXPECT_THAT(refused("range = 101.0\n", kTimes, kSphere),
              IsAt("case.toml:6", "lubrication.range"));
}

TEST_F(LubricationSection, ReadsSpheresWithInertia) {
  const std::string given = "velocity = [1.0, 2.0, 3.0]\nangular_velocity = [4.0, 5.0, 6.0]\n";
  const auto c = read("inertia = true\n" + kShear, kTimes,
                      kBox + kSphere + "mass = 5.0\nmoment_of_inertia = 7.0\n" + given +
                          "[[particle]]\ncentre = [5.0, 6.0, 7.0]\nradius = 1.0\ndensity = 1.0\n");
  EXPECT_TRUE(c.setting.lubrication->inertia);
  EXPECT_THAT(c.particles.masses, ElementsAre(5, ::testing::DoubleEq(4 * M_PI / 3)));
  EXPECT_EQ(c.particles.inertias[0], 7);
  // The second sphere begins with the flow.
  EXPECT_THAT(c.particles.velocities, ElementsAre(1, 2, 3, -24, 0, 0));
  EXPECT_THAT(c.particles.angular_velocities, ElementsAre(4, 5, 6, 0, 0, 2));
  EXPECT_FALSE(read("inertia = false\n").setting.lubrication->inertia);
  EXPECT_THAT(refused("inertia = true\n"), IsAt("case.toml:12", "particle[0].mass"));
  EXPECT_THAT(refused("inertia = true\nvelocity = { stress = 1.0 }\n", "end_time = 0.0\n",
                      kBox + kSphere + "mass = 5.0\n"),
              IsAt("case.toml:6", "lubrication.inertia"));
  // The fluid would accelerate otherwise at images.
  for (const std::string flow :
       {"shear_rate = [ { until = 0.5, value = 1.0 }, { until = 1.0, value = -1.0 } ]",
        "shear_rate = { amplitude = 1.0, angular_frequency = 2.0 }", "strain_rate = 1.0"}) {
    const auto velocity = "velocity = { " + flow + " }\ninertia = true\n";
    EXPECT_THAT(refused(velocity, kTimes, kBox + kSphere + "mass = 5.0\n"),
                IsAt("case.toml:7", "lubrication.inertia"));
    EXPECT_EQ(read(velocity, kTimes, kSphere + "mass = 5.0\n").particles.count(), 1U);
  }
}

TEST_F(LubricationSection, FillsEmptyCellsOfVelocitiesWithTheFlow) {
  const auto of = [&](const std::string& rows) {
    folder_.file("spheres.csv", rows);
    return read("inertia = true\n" + kShear, kTimes, kBox + "[particles]\nfile = \"spheres.csv\"\n")
        .particles;
  };
  // The flow at y = 2 is -8, and the fluid turns by 2. A row with one component has all of them.
  const auto p =
      of("x,y,z,radius,mass,vx,vy,vz,angular_velocity_x,angular_velocity_y,angular_velocity_z\n"
         "1,2,2,0.5,1,,,,,,\n3,2,2,0.5,1,,,7,,3,\n5,2,2,0.5,1,0,0,0,,,\n7,2,2,0.5,1,,,,0,0,0\n");
  EXPECT_THAT(p.velocities, ElementsAre(-8, 0, 0, 0, 0, 7, 0, 0, 0, -8, 0, 0));
  EXPECT_THAT(p.angular_velocities, ElementsAre(0, 0, 2, 0, 3, 0, 0, 0, 2, 0, 0, 0));
}

TEST_F(LubricationSection, ReadsPlanesThatMoveWithTheFlow) {
  const auto box = [](const std::string& periodic) {
    return "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [8.0, 9.0, 10.0], periodic = [" +
           periodic + "] }\n";
  };
  const auto plane = [](const std::string& keys) { return "[[plane]]\n" + keys; };
  const std::string shear = "velocity = { shear_rate = 2.0 }\n";
  // Walls move with the flow; planes have its velocity.
  EXPECT_EQ(obstacles_of(read(shear, kTimes, box("true, false, true") + kSphere).setting).size(),
            2U);
  const std::string above = "point = [0.0, 6.0, 0.0]\nnormal = [0.0, -2.0, 0.0]\n";
  const std::string moves = "velocity = [12.0, 0.0, 0.0]\n";
  EXPECT_EQ(read(shear, kTimes, kSphere + plane(above + moves)).setting.planes.size(), 1U);
  EXPECT_EQ(read("", kTimes, kSphere + plane(above)).setting.planes.size(), 1U);
  const std::string stops =
      "velocity = { shear_rate = [ { until = 0.25, value = 1.0 }, { until = 1.0, value = 0.0 } ] "
      "}\n";
  const std::string at_rest = "point = [0.0, 0.0, 0.0]\nnormal = [0.0, 1.0, 0.0]\n";
  EXPECT_EQ(read(stops, kTimes, kSphere + plane(at_rest)).setting.planes.size(), 1U);
  EXPECT_THAT(refused(stops, kTimes, kSphere + plane(above)),
              IsAt("case.toml:13", "plane[0].velocity"));
  EXPECT_EQ(read("velocity = { gradient = [[0.0, 0.0, 3.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]] }\n",
                 kTimes, box("true, true, false") + kSphere)
                .setting.lubrication->gradient[0][2],
            3);

  EXPECT_THAT(refused(shear, kTimes, kSphere + plane(above)),
              IsAt("case.toml:13", "plane[0].velocity"));
  EXPECT_THAT(refused("", kTimes, kSphere + plane(above + moves)),
              IsAt("case.toml:15", "plane[0].velocity"));
  EXPECT_THAT(refused("", kTimes, kSphere + plane(above + "velocity = [0.0, 1.0, 0.0]\n")),
              IsAt("case.toml:15", "plane[0].velocity"));
  EXPECT_THAT(refused("", kTimes, kSphere + plane(above + "angular_velocity = [0.0, 1.0, 0.0]\n")),
              IsAt("case.toml:15", "plane[0].angular_velocity"));
  EXPECT_THAT(refused("", kTimes, kSphere + plane(above + "force = 1.0\nmass = 1.0\n")),
              IsAt("case.toml:16", "plane[0].mass"));
  EXPECT_THAT(refused(shear, kTimes,
                      kSphere + plane("point = [0.0, 0.0, 0.0]\nnormal = [1.0, 0.0, 0.0]\n")),
              IsAt("case.toml:15", "plane[0].normal"));
  EXPECT_THAT(refused(shear, kTimes, box("true, true, false") + kSphere),
              IsAt("case.toml:6", "lubrication.velocity.shear_rate"));
  EXPECT_THAT(refused("offset = 1.0\n", kTimes, box("true, false, true") + kSphere),
              IsAt("case.toml:6", "lubrication.offset"));
}

}  // namespace
}  // namespace viscontact::particles
