// [[membrane]] of a case: what is read and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/particles/case/particles_case.hpp"

namespace viscontact::particles {
namespace {

using ::testing::HasSubstr;

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
  void expect_refused(const std::string& text, int line, const std::string& said) const {
    EXPECT_THAT(bad_input([&] { read(text); }),
                HasSubstr("case.toml:" + std::to_string(line) + ": " + said));
  }
  TemporaryFolder folder_;
};

TEST_F(MembraneSection, MakesBeads) {
  const auto c = read(text(membrane("1.0, 0.5", "0.8", "inner_viscosity = 5.0\nbeads = 30\n") +
                           membrane("-2.5, 0.5")));
  const auto& membranes = c.setting.fluid->membranes;
  ASSERT_EQ(membranes.size(), 2U);
  EXPECT_EQ(membranes[0].first, 0);
  EXPECT_EQ(membranes[0].beads, 30);
  EXPECT_EQ(membranes[1].first, 30);
  EXPECT_EQ(membranes[1].beads, 48);
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
  expect_refused(text(membrane("0.0, 0.0", "1.1")), 15, "membrane[0].reduced_area is 1.1");
  expect_refused(text(membrane("0.0, 0.0", "0.2")), 15, "membrane[0].reduced_area is 0.2");
  expect_refused(text(membrane("0.0, 0.0", "0.3", "beads = 12\n")), 15, "membrane[0].reduced_area");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "beads = 11\n")), 17, "membrane[0].beads is 11");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "bead_radius = 1.0\n")), 17,
                 "membrane[0].bead_radius is 1");
  expect_refused(text(membrane("0.0, 0.0", "0.8", "colour = 1\n")), 17, "");
  expect_refused(text("[[membrane]]\nperimeter = 7.0\n"), 12, "");
}

TEST_F(MembraneSection, MembranesThatMeetOrLeaveTheDomainAreErrors) {
  expect_refused(text(membrane() + membrane("1.0, 0.0")), 18,
                 "membrane[1].centre makes the membrane cross or contain membrane 0");
  expect_refused(text(membrane() + "[[membrane]]\ncentre = [0.1, 0.0]\nperimeter = 2.0\n"
                                   "reduced_area = 0.8\nbending_rigidity = 3.0\n"),
                 18, "membrane[1].centre makes the membrane cross or contain membrane 0");
  // Also across the period of 10: the second membrane is in the image of the first one.
  const std::string small = "perimeter = 2.0\nreduced_area = 0.8\nbending_rigidity = 3.0\n";
  for (const auto& [first, second] :
       {std::pair("4.5, 0.0", "-4.9, 0.0"), {"-4.5, 0.0", "4.9, 0.0"}})
    expect_refused(text(membrane(first) + "[[membrane]]\ncentre = [" + second + "]\n" + small), 18,
                   "membrane[1].centre makes the membrane cross or contain membrane 0");
  expect_refused(text(membrane("0.0, 3.5")), 12, "");
}

TEST_F(MembraneSection, WhatCannotBeComputedWithMembranesIsRefused) {
  expect_refused(text(membrane() + "[[particle]]\ncentre = [3.0, 3.0]\nradius = 0.1\nmass = 0.0\n"),
                 12, "section [[membrane]] stands beside particle");
  expect_refused(text(membrane(), "density = 1.0"), 11, "fluid.density is 1");
  expect_refused(text(membrane(), "mesh = \"fixed\""), 11, "fluid.mesh is 'fixed'");
  expect_refused(text(membrane(), "coupling = \"splitting\""), 11, "fluid.coupling is 'splitting'");
  expect_refused(text(membrane(), "solver = [\"mine\"]"), 11, "fluid.solver is a program");
  expect_refused(text(membrane(), "constraint = \"rigid\""), 11, "fluid.constraint is 'rigid'");
  const auto with = [&](const std::string& section, const std::string& key) {
    auto changed = text(membrane());
    return changed.insert(changed.find(section) + section.size(), "\n" + key);
  };
  expect_refused(with("dimension = 2", "gravity = [0.0, -1.0]"), 4, "space.gravity has no effect");
  expect_refused(with("end_time = 4.0", "gamma_min = 0.0\nrestitution = 0.5"), 10,
                 "viscous_contact.restitution has no effect");
  expect_refused(text(membrane(), "", "true, true"), 12, "section [[membrane]] stands in a box");
  expect_refused(
      "title = \"Dry\"\n[space]\ndimension = 2\n[viscous_contact]\ntime_step = 0.1\n"
      "end_time = 4.0\n" +
          membrane(),
      7, "section [[membrane]] belongs to a case with a fluid");
}

}  // namespace
}  // namespace viscontact::particles
