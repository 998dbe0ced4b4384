// [[body]], [[hinge]], [[spring]] and [[arm]] of a case of many particles: what is read and what is
// refused.
#include <gmock/gmock.h>

#include <limits>
#include <string>
#include <variant>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"

namespace viscontact::particles {
namespace {

using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators
using ::testing::ElementsAre;

// The first lines of a case, up to the particles at 0, 3 and 6 on the first axis, radius 1, and the
// line of the first link.
constexpr int kFirstLine = 22;

class LinksSection : public ::testing::Test {
 protected:
  static std::string particle(const std::string& centre, const std::string& mass) {
    return "[[particle]]\ncentre = [" + centre + "]\nradius = 1.0\nmass = " + mass + "\n";
  }
  static std::string text(const std::string& links, int dimension) {
    const std::string rest = dimension == 3 ? ", 0.0, 0.0" : ", 0.0";
    return "title = \"Links\"\n[space]\ndimension = " + std::to_string(dimension) +
           "\n[viscous_contact]\ntime_step = 0.1\nend_time = 4.0\ngamma_min = 0.0\n\n\n" +
           particle("0.0" + rest, "1.0") + particle("3.0" + rest, "1.0") +
           particle("6.0" + rest, "2.0") + links;
  }
  ParticlesCase read(const std::string& links, int dimension = 2) const {
    return read_particles_case(folder_.file("case.toml", text(links, dimension)));
  }
  void expect_refused(const std::string& links, const std::string& key, int line = kFirstLine + 1,
                      int dimension = 2) const {
    EXPECT_THAT(bad_input([&] { read(links, dimension); }),
                IsAt("case.toml:" + std::to_string(line), key))
        << links;
  }
  TemporaryFolder folder_;
};

TEST_F(LinksSection, ABodyHasTheMassesOfItsParticlesOrItsOwn) {
  const auto c = read("[[body]]\nparticles = [1, 2]\n");
  ASSERT_EQ(c.particles.bodies.count(), 1U);
  const auto& body = c.particles.bodies.bodies[0];
  EXPECT_THAT(body.members, ElementsAre(1, 2));
  EXPECT_EQ(body.mass, 3);
  EXPECT_EQ(body.centre, (Vector{5, 0, 0}));
  // Two discs m r^2/2, and m_1 m_2/(m_1 + m_2) distance^2.
  EXPECT_DOUBLE_EQ(body.inertia[8], 1.5 + 2.0 / 3 * 9);
  EXPECT_THAT(c.particles.bodies.of_particle, ElementsAre(-1, 0, 0));
  EXPECT_TRUE(c.particles.turn());
  const auto own =
      read("[[body]]\nparticles = [1, 2]\nmass = 6.0\nmoment_of_inertia = 0.5\n").particles;
  EXPECT_EQ(own.bodies.bodies[0].mass, 6);
  EXPECT_EQ(own.bodies.bodies[0].inertia[8], 0.5);
  EXPECT_EQ(own.bodies.bodies[0].centre, (Vector{5, 0, 0}));
}

TEST_F(LinksSection, ABodyMayLieAcrossAPeriodButNotFillIt) {
  const auto in_cell = [](const std::string& width) {
    return "[domain]\nbox = { from = [-1.5, -5.0], to = [" + width +
           ", 5.0], periodic = [true, false] }\n";
  };
  // The period is 9: the image of the last particle at -3 is nearest to the first one.
  const auto c = read(
      "[[body]]\nparticles = [0, 2]\nmoment_of_inertia = 1.0\n[[hinge]]\nbody = "
      "0\nat = [6.5, 0.0]\n" +
      in_cell("7.5"));
  const auto& body = c.particles.bodies.bodies[0];
  EXPECT_NEAR(body.centre[0], -2 + 9, 1e-12);
  EXPECT_NEAR(norm(body.offsets[0] - Vector{2, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(norm(body.offsets[1] - Vector{-1, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(norm(c.setting.links.hinges[0].point.offset - Vector{-0.5, 0, 0}), 0, 1e-12);
  expect_refused("[[body]]\nparticles = [0, 1, 2]\n" + in_cell("7.7"), "body[0].particles");
  // With the period 8.5 the distances are 3, 3 and 2.5, with the period 9 they are 3 each.
  for (const auto* width : {"7.0", "7.5"})
    expect_refused("[[body]]\nparticles = [0, 1, 2]\n" + in_cell(width), "body[0].particles");
}

TEST_F(LinksSection, AHingeMayHaveStops) {
  const auto& hinges =
      read(
          "[[hinge]]\nparticle = 0\nat = [0.0, 0.0]\nlowest_angle = -0.5\n[[hinge]]\nparticle = "
          "1\nat = [3.0, 0.0]\nlowest_angle = 0.0\nhighest_angle = 1.5\n")
          .setting.links.hinges;
  ASSERT_EQ(hinges.size(), 2U);
  EXPECT_EQ(hinges[0].lowest_angle, -0.5);
  EXPECT_EQ(hinges[0].highest_angle, std::numeric_limits<double>::infinity());
  EXPECT_EQ(hinges[1].lowest_angle, 0);
  EXPECT_EQ(hinges[1].highest_angle, 1.5);
  const std::string hinge = "[[hinge]]\nparticle = 0\nat = [0.0, 0.0]\n";
  expect_refused(hinge + "lowest_angle = 0.5\n", "hinge[0].lowest_angle", kFirstLine + 3);
  expect_refused(hinge + "highest_angle = -0.5\n", "hinge[0].highest_angle", kFirstLine + 3);
  expect_refused(hinge + "lowest_angle = 0.0\nhighest_angle = 0.0\n", "hinge[0].lowest_angle",
                 kFirstLine + 3);
  expect_refused("[[hinge]]\nparticle = 0\nat = [0.0, 0.0, 0.0]\nlowest_angle = -0.5\n",
                 "hinge[0].lowest_angle", kFirstLine + 3, 3);
}

TEST_F(LinksSection, AHingeHoldsAPointOfABodyOrParticle) {
  const auto c = read(
      "[[body]]\nparticles = [1, 2]\n[[hinge]]\nbody = 0\nat = [5.5, 0.0]\nstiffness = "
      "2.0\nrest_angle = 0.25\n[[hinge]]\nparticle = 0\nat = [0.0, 0.5]\n");
  const auto& hinges = c.setting.links.hinges;
  ASSERT_EQ(hinges.size(), 2U);
  EXPECT_EQ(hinges[0].body, 0);
  EXPECT_EQ(hinges[0].point.particle, 2);
  EXPECT_EQ(hinges[0].point.offset, (Vector{0.5, 0, 0}));
  EXPECT_EQ(hinges[0].stiffness, 2);
  EXPECT_EQ(hinges[0].rest_angle, 0.25);
  EXPECT_EQ(hinges[1].body, -1);
  EXPECT_EQ(hinges[1].point.particle, 0);
  EXPECT_EQ(hinges[1].at, (Vector{0, 0.5, 0}));
  EXPECT_EQ(hinges[1].stiffness, 0);
}

TEST_F(LinksSection, SpringsAndArmsJoinTwoParticles) {
  const auto c = read(
      "[[spring]]\nbetween = [0, 1]\nstiffness = 10.0\n[[spring]]\nbetween = [0, 2]\nstiffness = "
      "1.0\nlength = 0.0\n[[arm]]\nbetween = [0, 1]\nlength = 3.0\n[[arm]]\nbetween = [1, "
      "2]\nlength = { pieces = [[0.0, 3.0], [1.0, 4.0]], period = 2.0 }\n[[arm]]\nbetween = [2, "
      "0]\nlength = { mean = 5.5, amplitude = 0.5, angular_frequency = 2.0, "
      "phase = 1.5707963267948966 }\n",
      3);
  const auto& links = c.setting.links;
  ASSERT_EQ(links.springs.size(), 2U);
  EXPECT_EQ(links.springs[0].length, 3);  // the distance at the start
  EXPECT_EQ(links.springs[0].stiffness, 10);
  EXPECT_EQ(links.springs[1].length, 0);
  ASSERT_EQ(links.arms.size(), 3U);
  EXPECT_EQ(length_at(links.arms[0].length, 7), 3);
  EXPECT_EQ(length_at(links.arms[1].length, 0.5), 3.5);
  EXPECT_EQ(length_at(links.arms[1].length, 2.25), 3.25);
  EXPECT_DOUBLE_EQ(length_at(links.arms[2].length, 0.7), 5.5 + 0.5 * std::cos(1.4));
}

TEST_F(LinksSection, WrongBodiesAreRefused) {
  expect_refused("[[body]]\nparticles = []\n", "body[0].particles");
  expect_refused("[[body]]\nparticles = [0, 3]\n", "body[0].particles");
  expect_refused("[[body]]\nparticles = [0, 1, 0]\n", "body[0].particles");
  expect_refused("[[body]]\nparticles = [0, 1]\n[[body]]\nparticles = [1, 2]\n",
                 "body[1].particles", kFirstLine + 3);
  expect_refused("[[body]]\nparticles = [0, 1]\nmass = 0.0\n", "body[0].mass", kFirstLine + 2);
  expect_refused("[[body]]\nparticles = [0, 1]\nmass = -1.0\n", "body[0].mass", kFirstLine + 2);
  expect_refused("[[body]]\nparticles = [0, 1]\nmoment_of_inertia = 1.0\n",
                 "body[0].moment_of_inertia", kFirstLine + 2, 3);
  expect_refused("[[body]]\nparticles = [0, 1]\ncolour = 1\n", "body[0].colour", kFirstLine + 2);
}

TEST_F(LinksSection, WrongHingesAreRefused) {
  expect_refused("[[hinge]]\nbody = 0\nat = [0.0, 0.0]\n", "hinge[0].body");
  expect_refused("[[hinge]]\nparticle = 0\nat = [0.0, 1.5]\n", "hinge[0].at", kFirstLine + 2);
  expect_refused("[[body]]\nparticles = [0, 1]\n[[hinge]]\nbody = 0\nat = [1.5, 0.0]\n",
                 "hinge[0].at", kFirstLine + 4);
  expect_refused("[[body]]\nparticles = [0, 1]\n[[hinge]]\nparticle = 1\nat = [3.0, 0.0]\n",
                 "hinge[0].particle", kFirstLine + 3);
  EXPECT_THAT(bad_input([&] { read("[[hinge]]\nat = [0.0, 0.0]\n"); }),
              IsAt("case.toml:22", "hinge[0].body"));
  expect_refused("[[hinge]]\nparticle = 0\nat = [0.0, 0.0]\nstiffness = -1.0\n",
                 "hinge[0].stiffness", kFirstLine + 3);
  expect_refused("[[hinge]]\nparticle = 0\nat = [0.0, 0.0]\nrest_angle = 1.0\n",
                 "hinge[0].rest_angle", kFirstLine + 3);
  expect_refused("[[hinge]]\nparticle = 0\nat = [0.0, 0.0, 0.0]\nstiffness = 1.0\n",
                 "hinge[0].stiffness", kFirstLine + 3, 3);
}

TEST_F(LinksSection, WrongSpringsAndArmsAreRefused) {
  const std::string arm = "[[arm]]\nbetween = [0, 1]\nlength = ";
  expect_refused("[[spring]]\nbetween = [0]\nstiffness = 1.0\n", "spring[0].between");
  expect_refused("[[spring]]\nbetween = [1, 1]\nstiffness = 1.0\n", "spring[0].between");
  expect_refused("[[spring]]\nbetween = [0, 1]\nstiffness = 0.0\n", "spring[0].stiffness",
                 kFirstLine + 2);
  expect_refused("[[spring]]\nbetween = [0, 1]\nstiffness = 1.0\nlength = -1.0\n",
                 "spring[0].length", kFirstLine + 3);
  expect_refused("[[body]]\nparticles = [0, 1]\n" + arm + "3.0\n", "arm[0].between",
                 kFirstLine + 3);
  expect_refused(arm + "3.5\n", "arm[0].length", kFirstLine + 2);
  expect_refused(arm + "{ pieces = [[0.0, 3.0], [1.0, 1.5]] }\n", "arm[0].length", kFirstLine + 2);
  expect_refused(arm + "{ pieces = [[0.5, 3.0]] }\n", "arm[0].length.pieces", kFirstLine + 2);
  expect_refused(arm + "{ pieces = [[0.0, 3.0], [1.0, 3.5], [1.0, 3.0]] }\n",
                 "arm[0].length.pieces", kFirstLine + 2);
  expect_refused(arm + "{ pieces = [[0.0, 3.0], [2.0, 4.0]], period = 1.0 }\n",
                 "arm[0].length.period", kFirstLine + 2);
  expect_refused(arm + "{ pieces = [[0.0, 3.0], [2.0, 4.0]], period = 2.0 }\n",
                 "arm[0].length.pieces", kFirstLine + 2);
  expect_refused(arm + "{ mean = 3.0, amplitude = 3.0, angular_frequency = 1.0 }\n",
                 "arm[0].length.amplitude", kFirstLine + 2);
  expect_refused(arm + "3.0\n[[arm]]\nbetween = [1, 0]\nlength = 3.0\n", "arm[1].between",
                 kFirstLine + 4);
}

TEST_F(LinksSection, ThreeArmsThatCannotMeetAreRefused) {
  const std::string arms =
      "[[arm]]\nbetween = [0, 1]\nlength = 3.0\n[[arm]]\nbetween = [1, 2]\nlength = 3.0\n";
  read(arms + "[[arm]]\nbetween = [0, 2]\nlength = 6.0\n");
  // In the middle of the motion: the longest side grows until t = 1.
  expect_refused(
      arms +
          "[[arm]]\nbetween = [0, 2]\nlength = { pieces = [[0.0, 6.0], [1.0, 6.5], [2.0, 6.0]] }\n",
      "arm[2].length", kFirstLine + 8);
}

}  // namespace
}  // namespace viscontact::particles
