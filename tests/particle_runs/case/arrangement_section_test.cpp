// The sections [arrangement] and [[source]]: which particles they add, their defaults, and what
// they refuse.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "tests/common/failure.hpp"
#include "tests/particle_runs/case/fluid_cases.hpp"
#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/particle_runs/case/particles_sections.hpp"

namespace viscontact::particles {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
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
  // At least one disc is drawn.
  EXPECT_EQ(read("area_fraction = 1e-9\nradius = 1.0\n", kBox, true).count(), 1U);
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
  EXPECT_THAT(refused("count = 2\nradius = 1.0\n"), IsAt("case.toml:2", "arrangement.mass"));
  EXPECT_THAT(refused("radius = 1.0\nmass = 1.0\n"), IsAt("case.toml:2", "arrangement.count"));
  EXPECT_THAT(refused("count = 2\narea_fraction = 0.1\nradius = 1.0\nmass = 1.0\n"),
              IsAt("case.toml:3", "arrangement.count"));
  EXPECT_THAT(refused("area_fraction = 1.2\nradius = 1.0\nmass = 1.0\n"),
              IsAt("case.toml:3", "arrangement.area_fraction"));
  EXPECT_THAT(refused("area_fraction = 0.5\nradius = 1e-5\nmass = 1.0\n"),
              IsAt("case.toml:3", "arrangement.area_fraction"));
  EXPECT_THAT(refused("count = 60\nradius = 1.0\nmass = 1.0\n"),
              AllOf(IsAt("case.toml:3", "arrangement.count"), Names("0.9425")));
  EXPECT_THAT(refused("count = 2\nradius = 1.0\nmass = 0.0\n"),
              IsAt("case.toml:5", "arrangement.mass"));
  EXPECT_THAT(refused("count = 2\nradius = 1.0\nmass = 1.0\nseeds = 1\n"),
              IsAt("case.toml:6", "arrangement.seeds"));
  EXPECT_THAT(refused("count = 2\nradius = 1.0\nmass = 1.0\n", {}), IsAt("case.toml:4"));
  Particles spheres;
  spheres.dimension = 3;
  EXPECT_THAT(bad_input([&] { read("count = 2\nradius = 1.0\n", {}, false, spheres); }),
              IsAt("case.toml:4"));
  EXPECT_THAT(bad_input([] { read("count = 2\nspecies = [ { radius = 1.0 } ]\n", {}); }),
              IsAt("case.toml:4", "arrangement.species"));
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
    EXPECT_DOUBLE_EQ(p.masses[k], p.radii[k] == 1 ? 3 * round_shape(3, 1).measure() : 5.0);
  const auto uniform =
      read_spheres("volume_fraction = 0.2\nradius = { uniform = [0.5, 1.0] }\ndensity = 1.0\n");
  double volume = 0;
  for (std::size_t k = 0; k < uniform.count(); ++k) {
    EXPECT_TRUE(0.5 <= uniform.radii[k] && uniform.radii[k] < 1);
    volume += uniform.masses[k];
  }
  EXPECT_NEAR(volume, 0.2 * 3000, round_shape(3, 1).measure());
  EXPECT_THAT(read_spheres("count = 4\nradius = [0.5, 1.0]\nmass = 1.0\n").radii,
              ElementsAre(0.5, 1.0, 0.5, 1.0));
}

TEST(ArrangementSection, WrongSpeciesAreRefusedAtTheirLine) {
  const auto refused = [](const std::string& keys) {
    return bad_input([&] { read_spheres("count = 2\n" + keys); });
  };
  EXPECT_THAT(refused("species = [ { radius = 1.0, mass = 1.0 } ]\nradius = 1.0\n"),
              IsAt("case.toml:5", "arrangement.radius"));
  EXPECT_THAT(refused("species = []\n"), IsAt("case.toml:4", "arrangement.species"));
  EXPECT_THAT(refused("species = [ { radius = 1.0 } ]\n"),
              IsAt("case.toml:4", "arrangement.species[0].mass"));
  EXPECT_THAT(refused("radius = { uniform = [1.0, 0.5] }\nmass = 1.0\n"),
              IsAt("case.toml:4", "arrangement.radius.uniform"));
  EXPECT_THAT(refused("radius = { uniform = [0.5, 1.0], lognormal = { median = 1.0, sigma = 0.1 "
                      "} }\nmass = 1.0\n"),
              IsAt("case.toml:4", "arrangement.radius.uniform"));
  EXPECT_THAT(refused("radius = { lognormal = { median = 1.0, sigma = 2.0 } }\nmass = 1.0\n"),
              IsAt("case.toml:4", "arrangement.radius.lognormal.sigma"));
  EXPECT_THAT(refused("radius = 1.0\ndensity = 0.0\n"), IsAt("case.toml:5", "arrangement.density"));
  EXPECT_THAT(bad_input([] { read_spheres("area_fraction = 0.1\nradius = 1.0\nmass = 1.0\n"); }),
              IsAt("case.toml:3", "arrangement.area_fraction"));
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
                                            "number = 30\nbegin = 1.0\nend = 4.0\n"
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
  expect_refused_at(poured(disc + region), "[[source]]", "source[0].rate");
  expect_refused_at(poured(disc + region + "rate = 1.0\nbegin = 2.0\nend = 1.0\n"), "end = 1.0",
                    "source[0].end");
  expect_refused_at(poured(disc + "region = { from = [1.0, 15.0], to = [11.0, 19.0] }\nrate = 1.0"),
                    "region", "source[0].region");
  expect_refused_at(poured(disc + "region = { from = [1.0, 15.0], to = [0.0, 19.0] }\nrate = 1.0"),
                    "region", "source[0].region.to");
  expect_refused_at(poured(disc + region + "rate = 1e9\n"), "rate", "source[0].rate");
  expect_refused_at(poured(disc + region + "rate = 1.0\n", "[fluid]\nviscosity = 1.0\n"), "region",
                    "source[0].region");
}

TEST(SourceSection, MayHaveAMillionParticles) {
  const std::string keys =
      "radius = 0.5\nmass = 1.0\nregion = { from = [1.0, 15.0], to = [9.0, 19.0] }\n";
  // 5 * 199999.8 + 1 = 1e6.
  const auto c = read_particles_text(poured(keys + "rate = 199999.8\n"));
  EXPECT_EQ(c.setting.sources[0].due(5), 1000000U);
  expect_refused_at(poured(keys + "rate = 200000.0\n"), "rate", "source[0].rate");
}

TEST(SourceSection, MayBeginLaterThanACaseWithoutParticles) {
  const auto c =
      read_particles_text(poured("radius = 0.5\nmass = 1.0\nrate = 1.0\nbegin = 1.0\n"
                                 "region = { from = [1.0, 15.0], to = [9.0, 19.0] }\n"));
  EXPECT_EQ(c.particles.count(), 0U);
  EXPECT_EQ(c.setting.sources[0].begin, 1);
}

TEST(SourceSection, RadiiThatCannotComeAreRefusedAtTheirLine) {
  const auto refused = [](const std::string& radius, const std::string& named,
                          const std::string& more = "") {
    const auto text = poured(
        "mass = 1.0\nregion = { from = [1.0, 15.0], to = [9.0, 18.5] }\n"
        "rate = 10.0\nradius = " +
            radius + "\n",
        more);
    expect_refused_at(text, "radius", "source[0].radius", {named});
  };
  // The box is 10 x 20, and the region reaches from 15 to 18.5 below its top at 20.
  refused("5.1", "5");
  refused("[0.4, 6.0]", "6");
  refused("{ uniform = [0.4, 5.5] }", "5.5");
  refused("{ lognormal = { median = 2.0, sigma = 1.0 } }", "the region");
  refused("4.0", "3.6", "[[plane]]\npoint = [0.0, 18.6]\nnormal = [0.0, -1.0]\n");
  refused("[0.0004, 1.0]", "0.0004", "[solver]\ntolerance = 1e-5\n");
  const auto periodic = [](const std::string& radius) {
    return changed(poured("mass = 1.0\nregion = { from = [0.0, 9.0], to = [10.0, 9.5] }\n"
                          "rate = 10.0\nradius = " +
                          radius + "\n"),
                   "20.0] }", "20.0], periodic = [true, false] }");
  };
  expect_refused_at(periodic("4.99"), "radius", "source[0].radius", {"4.97512"});
  EXPECT_EQ(read_particles_text(periodic("4.97")).setting.sources.size(), 1U);
}

TEST(SourceSection, ParticlesOfTheCaseMustNotBeTooSmallBesideThoseOfSources) {
  const auto text = [](const std::string& tolerance) {
    return poured(
        "radius = 1.0\nmass = 1.0\nrate = 10.0\n"
        "region = { from = [1.0, 15.0], to = [9.0, 18.5] }\n",
        "[solver]\ntolerance = " + tolerance +
            "\n[[particle]]\ncentre = [5.0, 5.0]\nradius = 0.01\nmass = 1.0\n");
  };
  expect_refused_at(text("2e-4"), "radius = 1.0", "source[0].radius", {"0.01"});
  EXPECT_EQ(read_particles_text(text("5e-5")).particles.count(), 1U);
}

TEST(SourceSection, NeedsIdsForItsParticles) {
  const auto read = [](const std::string& number) {
    const auto root = case_file::TomlSection::parse(
        "[[source]]\nradius = 0.5\nmass = 1.0\nregion = { from = [1.0, 5.0], to = [9.0, 9.0] }\n"
        "number = " +
            number + "\n",
        "case.toml");
    ParticlesCase c;
    c.end_time = 1;
    c.particles.positions = {10, 5};
    c.particles.radii = {2};
    c.particles.ids = {2147483640};
    read_sources(root, c);
    return c.setting.sources.size();
  };
  EXPECT_EQ(read("7"), 1U);
  EXPECT_THAT(bad_input([&] { read("8"); }),
              AllOf(IsAt("case.toml:5", "source[0].number"), Names("8", "2147483640")));
}

TEST(SourceSection, WithOneSeedPourDifferentParticles) {
  const std::string keys =
      "radius = { uniform = [0.2, 0.3] }\nmass = 1.0\nnumber = 20\nseed = 7\n"
      "region = { from = [1.0, 1.0], to = [9.0, 19.0] }\n";
  const auto c = read_particles_text(poured(keys + "[[source]]\n" + keys));
  State state;
  state.particles = c.particles;
  Simulation simulation(c.setting, state, 1);
  while (simulation.state().time < 4.999) simulation.step(5);
  const auto& p = simulation.state().particles;
  ASSERT_EQ(p.count(), 40U);
  EXPECT_THAT(std::set<double>(p.radii.begin(), p.radii.end()), SizeIs(40));
  // Nothing moves the particles.
  EXPECT_THAT(std::set<double>(p.positions.begin(), p.positions.end()), SizeIs(80));
}

TEST(ArrangementSection, NeedsIdsForItsParticles) {
  Particles present;
  present.positions = {10, 5};
  present.velocities = {0, 0};
  present.radii = {2};
  present.masses = {7};
  present.ids = {2147483646};
  EXPECT_THAT(
      bad_input([&] { read("count = 2\nradius = 1.0\nmass = 1.0\n", kBox, false, present); }),
      AllOf(IsAt("case.toml:3", "arrangement.count"), Names("2", "2147483646")));
}

TEST(ArrangementSection, GapInAFluidIsJudgedWithoutTheSeed) {
  const auto text = [](const std::string& fluid, const std::string& gap) {
    auto changed_text = changed(kDiscsInBox, "viscosity = 2.0", "viscosity = 2.0\n" + fluid);
    changed_text.resize(changed_text.find("[[particle]]"));
    return changed_text + "[arrangement]\ncount = 2\nradius = 0.2\nsmallest_gap = " + gap + "\n";
  };
  expect_refused_at(text("threshold_gap = 0.1", "0.05"), "smallest_gap",
                    "arrangement.smallest_gap");
  expect_refused_at(changed(text("", "0.05"), "end_time = 1.0", "end_time = 1.0\nroughness = 0.04"),
                    "smallest_gap", "arrangement.smallest_gap", {"0.08"});
  expect_refused_at(text("", "1e-4"), "smallest_gap", "arrangement.smallest_gap", {"0.0002"});
  EXPECT_EQ(read_particles_text(text("threshold_gap = 0.05", "0.05")).particles.count(), 2U);
}

}  // namespace
}  // namespace viscontact::particles
