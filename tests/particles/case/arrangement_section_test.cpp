// The section [arrangement]: which discs it adds, its defaults, and what it refuses.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/common/failure.hpp"
#include "tests/particles/case/fluid_cases.hpp"
#include "viscontact/particles/case/particles_sections.hpp"

namespace viscontact::particles {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const Domain kBox = BoxDomain{{0, 0}, {20, 10}, {true, false}};

Particles read(const std::string& keys, const Domain& domain = kBox, bool has_fluid = false,
               Particles p = {}) {
  const auto root = case_file::TomlSection::parse("\n[arrangement]\n" + keys, "case.toml");
  ParticlesCase c;
  c.particles = std::move(p);
  c.setting.domain = domain;
  if (has_fluid) c.setting.fluid.emplace();
  read_particles_of_case(root, c);
  return c.particles;
}

TEST(ArrangementSection, AddsDiscsAtRest) {
  const auto p = read("count = 5\nradius = 1.0\nmass = 2.0\n");
  EXPECT_EQ(p.count(), 5U);
  EXPECT_THAT(p.radii, AllOf(SizeIs(5), Each(1.0)));
  EXPECT_THAT(p.masses, AllOf(SizeIs(5), Each(2.0)));
  EXPECT_THAT(p.velocities, AllOf(SizeIs(10), Each(0.0)));
  EXPECT_THAT(p.positions, SizeIs(10));
  EXPECT_THAT(p.angles, IsEmpty());
}

TEST(ArrangementSection, InAFluidDiscsHaveAnglesAndNeedNoMass) {
  const auto p = read("area_fraction = 0.3\nradius = 1.0\n", kBox, true);
  EXPECT_EQ(p.count(), 19U);  // 0.3 * 200/pi = 19.1
  EXPECT_THAT(p.masses, Each(0.0));
  EXPECT_THAT(p.angles, SizeIs(19));
  EXPECT_THAT(p.inertias, AllOf(SizeIs(19), Each(0.0)));
  EXPECT_THAT(read("count = 1\nradius = 1.0\nmass = 3.0\n", kBox, true).inertias, ElementsAre(1.5));
}

TEST(ArrangementSection, DefaultsAreSeed1AndAGapOfATwentiethOfTheRadius) {
  const std::string discs = "area_fraction = 0.5\nradius = 1.0\nmass = 1.0\n";
  const auto p = read(discs);
  EXPECT_EQ(read(discs + "seed = 1\n").positions, p.positions);
  EXPECT_EQ(read(discs + "smallest_gap = 0.05\n").positions, p.positions);
  EXPECT_NE(read(discs + "seed = 2\n").positions, p.positions);
  EXPECT_NE(read(discs + "smallest_gap = 0.04\n").positions, p.positions);
}

TEST(ArrangementSection, KeepsPresentParticlesAndContinuesTheirIds) {
  Particles present;
  present.positions = {10, 5};
  present.velocities = {1, 2};
  present.radii = {2};
  present.masses = {7};
  present.ids = {41};
  const auto p = read("count = 2\nradius = 1.0\nmass = 1.0\n", kBox, false, present);
  EXPECT_THAT(p.ids, ElementsAre(41, 42, 43));
  EXPECT_EQ(p.positions[0], 10);
  EXPECT_EQ(p.velocities[1], 2);
  EXPECT_THAT(p.masses, ElementsAre(7, 1, 1));
}

TEST(ArrangementSection, WrongKeysAreRefusedAtTheirLine) {
  const auto refused = [](const std::string& keys, const Domain& domain = kBox) {
    return bad_input([&] { read(keys, domain); });
  };
  EXPECT_THAT(refused("count = 2\nradius = 1.0\n"),
              HasSubstr("case.toml:2: arrangement.mass is missing"));
  EXPECT_THAT(refused("radius = 1.0\nmass = 1.0\n"), HasSubstr("arrangement.count is missing"));
  EXPECT_THAT(refused("count = 2\narea_fraction = 0.1\nradius = 1.0\nmass = 1.0\n"),
              HasSubstr("case.toml:3: arrangement.count must be left out"));
  EXPECT_THAT(refused("area_fraction = 1.2\nradius = 1.0\nmass = 1.0\n"),
              HasSubstr("area_fraction is 1.2; it must be a number between 0 and 1"));
  EXPECT_THAT(refused("area_fraction = 0.5\nradius = 1e-5\nmass = 1.0\n"),
              HasSubstr("at most 1000000 are allowed"));
  EXPECT_THAT(refused("count = 60\nradius = 1.0\nmass = 1.0\n"),
              AllOf(HasSubstr("case.toml:3: arrangement.count is not accepted: 60 discs"),
                    HasSubstr("0.9425 of the area of the domain")));
  EXPECT_THAT(refused("count = 2\nradius = 1.0\nmass = 0.0\n"), HasSubstr("arrangement.mass is 0"));
  EXPECT_THAT(refused("count = 2\nradius = 1.0\nmass = 1.0\nseeds = 1\n"),
              HasSubstr("arrangement.seeds is not a key that is known here"));
  EXPECT_THAT(refused("count = 2\nradius = 1.0\nmass = 1.0\n", {}),
              HasSubstr("needs a section [domain] with a disc or a box"));
  Particles spheres;
  spheres.dimension = 3;
  EXPECT_THAT(bad_input([&] { read("count = 2\nradius = 1.0\n", {}, false, spheres); }),
              HasSubstr("needs a section [domain] with a disc or a box"));
}

const Domain kCuboid = BoxDomain{{0, 0, 0}, {20, 10, 15}, {true, true, false}};

Particles read_spheres(const std::string& keys) {
  Particles p;
  p.dimension = 3;
  return read(keys, kCuboid, false, p);
}

TEST(ArrangementSection, PlacesSpheresOfSeveralSpecies) {
  const auto p = read_spheres(
      "count = 90\nspecies = [ { radius = 1.0, share = 2.0, density = 3.0 },\n"
      "{ radius = { lognormal = { median = 0.7, sigma = 0.1 } }, mass = 5.0 } ]\n");
  EXPECT_THAT(p.positions, SizeIs(270));
  EXPECT_EQ(std::ranges::count(p.radii, 1.0), 60);
  EXPECT_EQ(std::ranges::count(p.masses, 5.0), 30);
  for (std::size_t k = 0; k < p.count(); ++k)
    EXPECT_DOUBLE_EQ(p.masses[k], p.radii[k] == 1 ? 3 * size_of_particle(3, 1) : 5.0);
  const auto uniform =
      read_spheres("volume_fraction = 0.2\nradius = { uniform = [0.5, 1.0] }\ndensity = 1.0\n");
  double volume = 0;
  for (std::size_t k = 0; k < uniform.count(); ++k) {
    EXPECT_TRUE(0.5 <= uniform.radii[k] && uniform.radii[k] < 1);
    volume += uniform.masses[k];
  }
  EXPECT_NEAR(volume, 0.2 * 3000, size_of_particle(3, 1));
  EXPECT_THAT(read_spheres("count = 4\nradius = [0.5, 1.0]\nmass = 1.0\n").radii,
              ElementsAre(0.5, 1.0, 0.5, 1.0));
}

TEST(ArrangementSection, WrongSpeciesAreRefusedAtTheirLine) {
  const auto refused = [](const std::string& keys) {
    return bad_input([&] { read_spheres("count = 2\n" + keys); });
  };
  EXPECT_THAT(refused("species = [ { radius = 1.0, mass = 1.0 } ]\nradius = 1.0\n"),
              HasSubstr("case.toml:5: arrangement.radius must be left out, because species"));
  EXPECT_THAT(refused("species = [ { radius = 1.0 } ]\n"),
              HasSubstr("case.toml:4: arrangement.species[0].mass is missing"));
  EXPECT_THAT(refused("radius = { uniform = [1.0, 0.5] }\nmass = 1.0\n"),
              HasSubstr("arrangement.radius.uniform must be two numbers"));
  EXPECT_THAT(refused("radius = { uniform = [0.5, 1.0], lognormal = { median = 1.0, sigma = 0.1 "
                      "} }\nmass = 1.0\n"),
              HasSubstr("must have one of them"));
  EXPECT_THAT(refused("radius = { lognormal = { median = 1.0, sigma = 2.0 } }\nmass = 1.0\n"),
              HasSubstr("sigma is 2; it must be a number from 1e-6 to 1"));
  EXPECT_THAT(refused("radius = 1.0\ndensity = 0.0\n"), HasSubstr("must have a mass"));
  EXPECT_THAT(bad_input([] { read_spheres("area_fraction = 0.1\nradius = 1.0\nmass = 1.0\n"); }),
              HasSubstr("arrangement.area_fraction must be volume_fraction in 3 dimensions"));
}

/// A case of discs in a box, into which [[source]] pours others.
std::string poured(const std::string& source, const std::string& rest = "") {
  return "title = \"Poured\"\n[space]\ndimension = 2\n[domain]\nbox = { from = [0.0, 0.0], to = "
         "[10.0, 20.0] }\n[viscous_contact]\ntime_step = 0.01\nend_time = 5.0\ngamma_min = 0.0\n" +
         rest + "[[source]]\n" + source;
}

TEST(SourceSection, HasDefaultsAndRatesFromNumbers) {
  const std::string keys =
      "radius = 0.5\nmass = 1.0\nregion = { from = [1.0, 15.0], to = [9.0, 19.0] }\n";
  const auto c = read_particles_text(poured(keys + "rate = 2.0\n[[source]]\n" + keys +
                                            "number = 30\nfrom = 1.0\nuntil = 4.0\n"
                                            "velocity = [0.0, -3.0]\n"));
  ASSERT_THAT(c.setting.sources, SizeIs(2));
  const auto& first = c.setting.sources[0];
  EXPECT_EQ(first.begin, 0);
  EXPECT_EQ(first.end, 5);
  EXPECT_EQ(first.rate, 2);
  EXPECT_EQ(first.velocity, Vector{});
  EXPECT_EQ(first.due(5), 11U);
  const auto& second = c.setting.sources[1];
  EXPECT_EQ(second.rate, 10);
  EXPECT_EQ(second.due(4), 30U);
  EXPECT_EQ(second.velocity[1], -3);
  EXPECT_NE(first.seed, second.seed);
  EXPECT_EQ(c.particles.count(), 0U);
}

TEST(SourceSection, WrongKeysAreRefusedAtTheirLine) {
  const std::string region = "region = { from = [1.0, 15.0], to = [9.0, 19.0] }\n";
  const std::string disc = "radius = 0.5\nmass = 1.0\n";
  expect_refused_at(poured(disc + region), "[[source]]", "rate and number are missing");
  expect_refused_at(poured(disc + region + "rate = 1.0\nfrom = 2.0\nuntil = 1.0\n"), "until = 1.0",
                    "it must be later than from, 2");
  expect_refused_at(poured(disc + "region = { from = [1.0, 15.0], to = [11.0, 19.0] }\nrate = 1.0"),
                    "region", "has the corner (11, 15), which is outside the domain");
  expect_refused_at(poured(disc + "region = { from = [1.0, 15.0], to = [0.0, 19.0] }\nrate = 1.0"),
                    "region", "it must be at least 1");
  expect_refused_at(poured(disc + region + "rate = 1e9\n"), "rate", "at most 1000000 are allowed");
  EXPECT_THAT(
      bad_input([&] { read_particles_text(poured(disc + region + "rate = 1.0\nfrom = 1.0\n")); }),
      HasSubstr("or a [[source]] that begins at time 0"));
  expect_refused_at(poured(disc + region + "rate = 1.0\n", "[fluid]\nviscosity = 1.0\n"), "region",
                    "the case must not have a section [fluid]");
}

TEST(ArrangementSection, GapInAFluidIsJudgedWithoutTheSeed) {
  const auto text = [](const std::string& fluid, const std::string& gap) {
    auto changed_text = changed(kDiscsInBox, "viscosity = 2.0", "viscosity = 2.0\n" + fluid);
    changed_text.resize(changed_text.find("[[particle]]"));
    return changed_text + "[arrangement]\ncount = 2\nradius = 0.2\nsmallest_gap = " + gap + "\n";
  };
  expect_refused_at(
      text("threshold_gap = 0.1", "0.05"), "smallest_gap",
      "arrangement.smallest_gap is 0.05; it must be at least fluid.threshold_gap, 0.1");
  expect_refused_at(
      changed(text("", "0.05"), "end_time = 1.0", "end_time = 1.0\nroughness = 0.04"),
      "smallest_gap",
      "it must be at least twice viscous_contact.roughness, 0.08, at which the solids "
      "touch");
  expect_refused_at(text("", "1e-4"), "smallest_gap", "a thousandth of the radius, 0.0002");
  EXPECT_EQ(read_particles_text(text("threshold_gap = 0.05", "0.05")).particles.count(), 2U);
}

}  // namespace
}  // namespace viscontact::particles
