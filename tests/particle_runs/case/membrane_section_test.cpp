// [[membrane]] of a case: what is read and what is refused.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"

namespace viscontact::particles {
namespace {

using ::testing::AllOf;

class MembraneSection : public ::testing::Test {
 protected:
  static std::string text(const std::string& membranes, const std::string& fluid = "",
                          const std::string& periodic = "true, false") {
    return "title = \"Membranes\"\n[space]\ndimension = 2\n[domain]\nbox = { from = [-5.0, -4.0], "
           "to "
           "= [5.0, 4.0], periodic = [" +
           periodic +
           "] }\n[viscous_contact]\ntime_step = 0.1\nend_time = 4.0\n[fluid]\nviscosity = "
           "2.0\n" +
           fluid + "\n" + membranes;
  }
  static std::string membrane(const std::string& centre = "0.0, 0.0",
                              const std::string& area = "0.8", const std::string& more = "") {
    return "[[membrane]]\ncentre = [" + centre + "]\nperimeter = 7.0\nreduced_area = " + area +
           "\nbending_rigidity = 3.0\n" + more;
  }
  ParticlesCase read(const std::string& text) const {
    return read_particles_case(folder_.file("case.toml", text));
  }
  // Line 12 is that of the first membrane.
  void expect_refused(const std::string& text, int line, const std::string& key,
                      const std::string& named = "") const {
    EXPECT_THAT(bad_input([&] { read(text); }),
                AllOf(IsAt("case.toml:" + std::to_string(line), key), Names(named)));
  }
  TemporaryFolder folder_;
};

TEST_F(MembraneSection, MakesBeads) {
  const auto c = read(text(membrane("1.0, 0.5", "0.8", "inner_viscosity = 5.0\nbeads = 30\n") +
                           membrane("-2.5, 0.5")));
  const auto& membranes = c.setting.fluid->membranes;
  ASSERT_EQ(membranes.size(), 2U);
  EXPECT_EQ(membranes[0].beads.front(), 0);
  EXPECT_EQ(membranes[0].count(), 30);
  EXPECT_EQ(membranes[1].beads.front(), 30);
  EXPECT_EQ(membranes[1].count(), 48);
  EXPECT_EQ(membranes[0].viscosity_ratio, 2.5);
  EXPECT_EQ(membranes[1].viscosity_ratio, 1);
  EXPECT_EQ(membranes[0].bending_rigidity, 3);
  EXPECT_NEAR(membranes[0].area, 0.8 * 49 / (4 * std::numbers::pi), 1e-12);
  EXPECT_EQ(c.particles.count(), 78U);
  double x = 0;
  for (std::size_t k = 0; k < 30; ++k) x += c.particles.position(k)[0] / 30;
  EXPECT_NEAR(x, 1, 1e-6);
  EXPECT_NEAR(c.particles.radii[0], 0.45 * 7 / 30, 1e-12);
}

TEST_F(MembraneSection, ImpossibleMembranesAreErrorsWithTheirLine) {
  expect_refused(text(membrane("0.0, 0.0", "1.1")), 15, "membrane[0].reduced_area");
  expect_refused(text(membrane("0.0, 0.0", "0.2")), 15, "membrane[0].reduced_area");
  expect_refused(text(membrane("0.0, 0.0", "0.3", "beads = 12\n")), 15, "membrane[0].reduced_area");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "beads = 11\n")), 17, "membrane[0].beads");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "bead_radius = 1.0\n")), 17,
                 "membrane[0].bead_radius");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "colour = 1\n")), 17, "membrane[0].colour");
  expect_refused(text("[[membrane]]\nperimeter = 7.0\n"), 12, "");
}

TEST_F(MembraneSection, MembranesThatMeetOrLeaveTheDomainAreErrors) {
  expect_refused(text(membrane() + membrane("1.0, 0.0")), 18, "membrane[1].centre");
  expect_refused(text(membrane() + "[[membrane]]\ncentre = [0.1, 0.0]\nperimeter = 2.0\n"
                                   "reduced_area = 0.8\nbending_rigidity = 3.0\n"),
                 18, "membrane[1].centre");
  // Also across the period of 10: the second membrane is in the image of the first one.
  const std::string small = "perimeter = 2.0\nreduced_area = 0.8\nbending_rigidity = 3.0\n";
  for (const auto& [first, second] :
       {std::pair("4.5, 0.0", "-4.9, 0.0"), {"-4.5, 0.0", "4.9, 0.0"}})
    expect_refused(text(membrane(first) + "[[membrane]]\ncentre = [" + second + "]\n" + small), 18,
                   "membrane[1].centre");
  expect_refused(text(membrane("0.0, 3.5")), 12, "");
}

TEST_F(MembraneSection, AMembraneThatIsWiderThanTheDomainIsAnErrorOfItsPerimeter) {
  // The width of an ellipse is proportional to its perimeter, so that the largest perimeter that is
  // named is allowed.
  const auto with = [&](double perimeter, const char* periodic) {
    auto made = text(membrane(), "", periodic);
    const std::string seven = "perimeter = 7.0";
    return made.replace(made.find(seven), seven.size(),
                        fmt::format("perimeter = {:.1f}", perimeter));
  };
  for (const auto* periodic : {"true, false", "false, false"}) {
    expect_refused(with(40, periodic), 14, "membrane[0].perimeter");
    expect_refused(with(1e5, periodic), 14, "membrane[0].perimeter");
  }
  const std::string said = bad_input([&] { read(with(40, "true, false")); }).what();
  const std::string least = "it must be less than ";
  ASSERT_THAT(said, ::testing::HasSubstr(least));
  const double most = std::stod(said.substr(said.find(least) + least.size()));
  EXPECT_THAT(bad_input([&] { read(with(1.01 * most, "true, false")); }),
              Names("membrane[0].perimeter"));
  EXPECT_GT(most, 7);
}

TEST_F(MembraneSection, WhatCannotBeComputedWithMembranesIsRefused) {
  const auto beside = [&](const std::string& centre, const std::string& more) {
    return text(membrane() + "[[particle]]\ncentre = [" + centre + "]\n" + more + "\n");
  };
  const std::string radius = "radius = 0.1\n";
  EXPECT_NO_THROW(read(beside("0.5, 0.0", radius)));
  expect_refused(beside("3.0, 3.0", radius + "mass = 1.0"), 12, "membrane", "mass");
  expect_refused(beside("3.0, 3.0", radius + "torque = 1.0"), 12, "membrane", "torque");
  expect_refused(beside("3.0, 3.0", "semi_axes = [0.1, 0.2]"), 12, "membrane", "ellipse");
  expect_refused(beside("0.0, 0.65", radius), 12, "membrane", "particle 0");
  expect_refused(text(membrane() + "[[plane]]\npoint = [0.0, -3.0]\nnormal = [0.0, 1.0]\n"), 12,
                 "membrane", "plane");
  expect_refused(text(membrane(), "density = 1.0"), 11, "fluid.density");
  expect_refused(text(membrane(), "mesh = \"fixed\""), 11, "fluid.mesh");
  expect_refused(text(membrane(), "coupling = \"splitting\""), 11, "fluid.coupling");
  expect_refused(text(membrane(), "solver = [\"mine\"]"), 11, "fluid.solver");
  expect_refused(text(membrane(), "constraint = \"rigid\""), 11, "fluid.constraint");
  const auto with = [&](const std::string& section, const std::string& key) {
    auto changed = text(membrane());
    return changed.insert(changed.find(section) + section.size(), "\n" + key);
  };
  expect_refused(with("dimension = 2", "gravity = [0.0, -1.0]"), 4, "space.gravity");
  expect_refused(with("end_time = 4.0", "gamma_min = 0.0\nrestitution = 0.5"), 10,
                 "viscous_contact.restitution");
  expect_refused(text(membrane(), "", "true, true"), 12, "membrane");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "bead_mass = 1.0\n")), 17,
                 "membrane[0].bead_mass");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "velocity = [1.0, 0.0]\n")), 17,
                 "membrane[0].velocity");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "bending_viscosity = 1.0\n")), 17,
                 "membrane[0].bending_viscosity");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "inner_area = \"free\"\n")), 17,
                 "membrane[0].inner_area");
}

TEST_F(MembraneSection, ViscosityRatiosThatCannotBeComputedAreErrors) {
  for (const auto* number : {"1e-8", "1e-5", "1e4", "1e100"})
    expect_refused(text(membrane("0.0, 0.0", "0.8", fmt::format("inner_viscosity = {}\n", number))),
                   17, "membrane[0].inner_viscosity");
  for (const auto* number : {"2.1e-4", "1.9e3"})
    EXPECT_NO_THROW(
        read(text(membrane("0.0, 0.0", "0.8", fmt::format("inner_viscosity = {}\n", number)))));
}

// R0 is 0.998 here and the viscosity 2, so that the limit of the rigidity is 199 at the rate 1.
TEST_F(MembraneSection, StiffMembranesNeedBeads) {
  const auto stiff = [&](const std::string& rigidity, const std::string& beads) {
    auto changed = text(membrane("0.0, 0.0", "0.8", beads), "velocity = { shear_rate = 1.0 }");
    return changed.replace(changed.find("= 3.0\n") + 2, 3, rigidity);
  };
  expect_refused(stiff("250.0", "beads = 31\n"), 17, "membrane[0].beads");
  EXPECT_NO_THROW(read(stiff("250.0", "beads = 32\n")));
  EXPECT_NO_THROW(read(stiff("250.0", "")));
  EXPECT_NO_THROW(read(stiff("150.0", "beads = 31\n")));
}

/// A case of particles without a fluid.
std::string dry(const std::string& sections) {
  return "title = \"Dry\"\n[space]\ndimension = 2\n[viscous_contact]\ntime_step = 0.1\n"
         "end_time = 4.0\n" +
         sections;
}

TEST_F(MembraneSection, MakesANecklaceWithoutAFluid) {
  const auto c =
      read(dry(membrane("1.0, 0.5", "0.8", "bead_mass = 0.5\nbeads = 30\nvelocity = [1.0, 2.0]\n") +
               membrane("-2.5, 0.5", "0.8", "bead_mass = 1.0\ninner_area = \"free\"\n")));
  const auto& membranes = c.setting.links.membranes;
  ASSERT_EQ(membranes.size(), 2U);
  EXPECT_EQ(membranes[0].count(), 30);
  EXPECT_TRUE(membranes[0].keeps_area);
  EXPECT_FALSE(membranes[1].keeps_area);
  EXPECT_EQ(membranes[0].lengths, std::vector<double>(30, 7.0 / 30));
  EXPECT_NEAR(measure(membranes[0], c.particles).area, 0.8 * 49 / (4 * std::numbers::pi), 1e-12);
  EXPECT_NEAR(measure(membranes[0], c.particles).x, 1, 1e-12);
  EXPECT_EQ(c.particles.masses[0], 0.5);
  EXPECT_EQ(c.particles.velocity(3), (Vector{1, 2, 0}));
  EXPECT_NEAR(c.particles.radii[0], 0.5 * 7 / 30, 1e-12);
  EXPECT_TRUE(c.particles.turn());
  EXPECT_TRUE(c.particles.are_joined(29, 0));
  EXPECT_FALSE(c.particles.are_joined(0, 2));
  EXPECT_FALSE(c.particles.are_joined(29, 30));
}

/// Tables [[particle]] on a circle of radius 2, in the order of `places`.
std::string ring(int count, const std::vector<int>& places, const std::string& more) {
  std::string text;
  for (const int k : places)
    text += fmt::format("[[particle]]\ncentre = [{:.6f}, {:.6f}]\n{}\n",
                        2 * std::cos(2 * std::numbers::pi * k / count),
                        1.6 * std::sin(2 * std::numbers::pi * k / count), more);
  return text;
}

TEST_F(MembraneSection, TakesGivenParticles) {
  const std::string of_six =
      "[[membrane]]\nparticles = [0, 1, 2, 3, 4, 5]\n"
      "bending_rigidity = 0.0\n";
  // Clockwise: the order becomes counter-clockwise.
  const auto c = read(dry(ring(6, {0, 5, 4, 3, 2, 1}, "radius = 0.5\nmass = 1.0") + of_six));
  const auto& membrane = c.setting.links.membranes.front();
  EXPECT_EQ(membrane.beads, (std::vector<std::int32_t>{5, 4, 3, 2, 1, 0}));
  EXPECT_NEAR(membrane.area, 3 * 2 * 1.6 * std::sin(std::numbers::pi / 3), 1e-5);
  EXPECT_NEAR(membrane.lengths[0], 2, 1e-5);
  EXPECT_NEAR(membrane.lengths[1], std::hypot(1, 1.6 * std::sin(std::numbers::pi / 3)), 1e-5);
  const auto shuffled = dry(ring(6, {0, 3, 4, 1, 2, 5}, "radius = 0.5\nmass = 1.0") + of_six);
  EXPECT_THAT(bad_input([&] { read(shuffled); }), IsAt("case.toml:32", "membrane[0].particles"));
  std::string flat;
  for (int k = 0; k < 4; ++k)
    flat += fmt::format("[[particle]]\ncentre = [{}.0, 0.0]\nradius = 0.1\nmass = 1.0\n", k);
  EXPECT_THAT(bad_input([&] {
                read(dry(flat + "[[membrane]]\nparticles = [0, 1, 2, 3]\n"
                                "bending_rigidity = 0.0\n"));
              }),
              IsAt("case.toml:24", "membrane[0].particles"));
  for (const auto& [wrong, key] : {std::pair("[0, 1, 2]", "membrane[0].particles"),
                                   {"[0, 1, 2, 3, 0]", "membrane[0].particles"},
                                   {"[0, 1, 2, 9]", "membrane[0].particles"},
                                   {"[0, 1, 2, 3]\nbeads = 4", "membrane[0].beads"}}) {
    const auto text = dry(ring(6, {0, 1, 2, 3, 4, 5}, "radius = 0.5\nmass = 1.0") +
                          "[[membrane]]\nbending_rigidity = 0.0\nparticles = " + wrong + "\n");
    EXPECT_THAT(bad_input([&] { read(text); }), IsAt("case.toml", key));
  }
  const auto twice = dry(ring(6, {0, 1, 2, 3, 4, 5}, "radius = 0.5\nmass = 1.0") + of_six + of_six);
  EXPECT_THAT(bad_input([&] { read(twice); }), IsAt("case.toml:35", "membrane[1].particles"));
  const auto body = dry(ring(6, {0, 1, 2, 3, 4, 5}, "radius = 0.5\nmass = 1.0") + of_six +
                        "[[body]]\nparticles = [0, 1]\n");
  EXPECT_THAT(bad_input([&] { read(body); }), IsAt("case.toml:35", "body[0].particles"));
}

// In a fluid the beads are at equal distances along the curve.
TEST_F(MembraneSection, TakesGivenParticlesInAFluid) {
  const auto made = read(text(membrane("0.3, 0.2", "0.8", "beads = 16\nangle = 0.4\n")));
  const auto given = [&](double moved) {
    std::string sections, list;
    for (std::size_t k = 0; k < 16; ++k) {
      const auto x = made.particles.position(k);
      sections += fmt::format("[[particle]]\ncentre = [{:.6f}, {:.6f}]\nradius = 0.1\n",
                              x[0] + (k == 3 ? moved : 0), x[1]);
      list += fmt::format("{}{}", k == 0 ? "" : ", ", k);
    }
    return text(sections + "[[membrane]]\nparticles = [" + list + "]\nbending_rigidity = 3.0\n");
  };
  const auto c = read(given(0));
  EXPECT_NEAR(c.setting.fluid->membranes[0].perimeter, 7, 1e-5);
  EXPECT_NEAR(c.setting.fluid->membranes[0].area, made.setting.fluid->membranes[0].area, 1e-5);
  for (std::size_t k = 0; k < 16; ++k)
    EXPECT_NEAR(norm(c.particles.position(k) - made.particles.position(k)), 0, 1e-5);
  EXPECT_THAT(bad_input([&] { read(given(0.05)); }), IsAt("case.toml:61", "membrane[0].particles"));
}

TEST_F(MembraneSection, WhatCannotStandBesideANecklaceIsRefused) {
  const auto expect = [&](const std::string& text, const std::string& key) {
    EXPECT_THAT(bad_input([&] { read(text); }), IsAt("case.toml", key));
  };
  const std::string mass = "bead_mass = 1.0\n";
  expect(dry(membrane("0.0, 0.0", "0.8")), "membrane[0].bead_mass");
  expect(dry(membrane("0.0, 0.0", "0.8", mass + "inner_viscosity = 1.0\n")),
         "membrane[0].inner_viscosity");
  expect(dry(membrane("0.0, 0.0", "0.8", mass) + membrane("1.0, 0.0", "0.8", mass)),
         "membrane[1].centre");
  // The regular polygon of 20 corners has the reduced area 0.9918.
  expect(dry(membrane("0.0, 0.0", "0.995", mass + "beads = 20\n")), "membrane[0].reduced_area");
  auto rebound = dry(membrane("0.0, 0.0", "0.8", mass));
  rebound.insert(rebound.find("end_time"), "gamma_min = 0.0\nrestitution = 0.5\n");
  expect(rebound, "viscous_contact.restitution");
  auto space = dry(membrane("0.0, 0.0", "0.8", mass));
  space.replace(space.find("= 2"), 3, "= 3");
  expect(space, "membrane");
  // A membrane may contain another one.
  EXPECT_NO_THROW(read(dry(membrane("0.0, 0.0", "0.8", mass) +
                           "[[membrane]]\ncentre = [0.0, 0.0]\nperimeter = 2.0\n"
                           "reduced_area = 0.8\nbending_rigidity = 0.0\n" +
                           mass)));
}

}  // namespace
}  // namespace viscontact::particles
