// Planes under a load, given motions without a fluid and arrangements beside planes: what is read
// and what is refused.
#include <gmock/gmock.h>

#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particles/domain/region.hpp"

namespace viscontact::particles {
namespace {

class ShearedPackings : public ::testing::Test {
 protected:
  ParticlesCase read(const std::string& contact, const std::string& sections,
                     int dimension = 2) const {
    return read_particles_case(folder_.file(
        "case.toml", "title = \"Sheared\"\n[space]\ndimension = " + std::to_string(dimension) +
                         "\n[viscous_contact]\ntime_step = 0.1\nend_time = 1.0\n" + contact + "\n" +
                         sections));
  }
  Error refused(const std::string& contact, const std::string& sections, int dimension = 2) const {
    return bad_input([&] { read(contact, sections, dimension); });
  }
  TemporaryFolder folder_;
};

const std::string kDisc = "[[particle]]\ncentre = [2.0, 0.5]\nradius = 0.5\nmass = 1.0\n";
const std::string kBox = "[domain]\nbox = { from = [0.0, 0.0], to = [4.0, 9.0] }\n";
const std::string kPlane = "[[plane]]\npoint = [0.0, 3.0]\nnormal = [0.0, -2.0]\n";

TEST_F(ShearedPackings, ReadAPressureAsTheForceOnTheirPlane) {
  const auto of = [&](const std::string& keys, const std::string& domain) {
    return read("", kDisc + domain + kPlane + keys).setting.planes.at(0).load.value();
  };
  EXPECT_EQ(of("pressure = 2.5\nmass = 3.0\n", kBox).force.value(0.5)[0], 10);
  EXPECT_EQ(of("pressure = 2.5\nmass = 3.0\n", kBox).mass, 3);
  EXPECT_EQ(of("force = -2.5\nmass = 3.0\n", "").force.value(0.5)[0], -2.5);
  const auto pieces =
      of("mass = 1.0\npressure = [ { until = 0.5, value = 1.0 }, "
         "{ until = 1.0, value = 2.0 } ]\n",
         kBox);
  EXPECT_EQ(pieces.force.value(0.2)[0], 4);
  EXPECT_EQ(pieces.force.value(0.7)[0], 8);
  EXPECT_EQ(read("",
                 "[domain]\nbox = { from = [0.0, 0.0, 0.0], to = [2.0, 3.0, 9.0], periodic = "
                 "[true, true, false] }\n[[plane]]\npoint = [0.0, 0.0, 5.0]\nnormal = [0.0, "
                 "0.0, -1.0]\npressure = 2.0\nmass = 1.0\n[[particle]]\ncentre = [1.0, 1.0, "
                 "1.0]\nradius = 0.5\nmass = 1.0\n",
                 3)
                .setting.planes.at(0)
                .load->force.value(0)[0],
            12);
}

TEST_F(ShearedPackings, RefuseLoadsWithFileAndLine) {
  const auto of = [&](const std::string& keys, const std::string& sections = "",
                      const std::string& contact = "") {
    return refused(contact, kDisc + kPlane + keys + sections);
  };
  EXPECT_THAT(of("pressure = 1.0\nmass = 1.0\n"), IsAt("case.toml:15", "plane[0].pressure"));
  EXPECT_THAT(of("force = 1.0\n"), IsAt("case.toml:12", "plane[0].mass"));
  EXPECT_THAT(of("mass = 1.0\n"), IsAt("case.toml", "plane[0].mass"));
  EXPECT_THAT(of("force = 1.0\nmass = 0.0\n"), IsAt("case.toml", "plane[0].mass"));
  EXPECT_THAT(of("force = 1.0\npressure = 1.0\nmass = 1.0\n", kBox),
              IsAt("case.toml", "plane[0].force"));
  EXPECT_THAT(of("force = [0.0, 1.0]\nmass = 1.0\n"), IsAt("case.toml", "plane[0].force"));
  EXPECT_THAT(of("force = 1.0\nmass = 1.0\nangular_velocity = 1.0\n"),
              IsAt("case.toml:17", "plane[0].angular_velocity"));
  EXPECT_THAT(of("force = 1.0\nmass = 1.0\nvelocity = [1.0, 0.1]\n"),
              IsAt("case.toml:17", "plane[0].velocity"));
  EXPECT_THAT(of("force = 1.0\nmass = 1.0\n", "", "gamma_min = 0.0\nrestitution = 0.5"),
              IsAt("case.toml", "plane[0].force"));
  EXPECT_THAT(of("force = 1.0\nmass = 1.0\n", kBox + "[fluid]\nviscosity = 1.0\n"),
              IsAt("case.toml", "plane[0].force"));
  EXPECT_THAT(refused("", kDisc + kBox +
                              "[[plane]]\npoint = [0.0, 5.0]\nnormal = [0.1, -2.0]\n"
                              "pressure = 1.0\nmass = 1.0\n"),
              IsAt("case.toml", "plane[0].pressure"));
  EXPECT_THAT(refused("", kDisc + "[domain]\ndisc = { radius = 9.0 }\n" + kPlane +
                              "pressure = 1.0\nmass = 1.0\n"),
              IsAt("case.toml"));
}

TEST_F(ShearedPackings, HaveFixedAndDrivenParticlesWithoutAFluid) {
  const auto c = read("", kDisc +
                              "[[particle]]\ncentre = [5.0, 0.5]\nradius = 0.5\nfixed = true\n"
                              "[[particle]]\ncentre = [5.5, 0.5]\nradius = 0.5\nvelocity_given = { "
                              "value = [1.0, 0.0], angular_velocity = 2.0 }\n");
  EXPECT_EQ(c.setting.given_motions.size(), 2U);
  EXPECT_TRUE(c.particles.turn());
  EXPECT_EQ(c.particles.angular_velocities.at(2), 2);
  // Two discs overlap, whose motions are given; a free one must not.
  EXPECT_THAT(
      refused("", kDisc + "[[particle]]\ncentre = [2.5, 0.5]\nradius = 0.5\nfixed = true\n"),
      IsAt("case.toml:12"));
  EXPECT_THAT(refused("", kDisc + "[[particle]]\ncentre = [5.0, 0.5]\nradius = 0.5\nfixed = true\n"
                                  "[[body]]\nparticles = [0, 1]\n"),
              IsAt("case.toml:17", "body[0].particles"));
  EXPECT_THAT(refused("",
                      "[[particle]]\ncentre = [5.0, 0.5]\nradius = 0.5\nmass = 1.0\nfixed = "
                      "true\nforce = [1.0, 0.0]\n"),
              IsAt("case.toml:13", "particle[0].force"));
}

TEST_F(ShearedPackings, ArrangeParticlesOnTheFreeSideOfPlanes) {
  const std::string planes =
      "[[plane]]\npoint = [0.0, 6.0]\nnormal = [0.0, -1.0]\n"
      "[[plane]]\npoint = [0.0, 1.0]\nnormal = [1.0, 2.0]\n";
  const auto c = read("", kBox + planes +
                              "[arrangement]\nradius = 0.2\nmass = 1.0\narea_fraction "
                              "= 0.5\nseed = 3\n");
  const auto obstacles = positions_of(obstacles_of(c.setting), 0);
  for (std::size_t k = 0; k < c.particles.count(); ++k)
    for (const auto& obstacle : obstacles)
      EXPECT_GE(gap(obstacle, c.particles.position(k), 0.2), 0.05 * 0.2 * (1 - 1e-9));
  // The fraction is that of the trapezium that is left: 4 x 6 less a triangle of the legs 2 and 1.
  EXPECT_EQ(c.particles.count(), std::lround(0.5 * 23 / (0.04 * 3.141592653589793)));
  EXPECT_THAT(refused("", kBox + planes +
                              "[[plane]]\npoint = [0.0, 5.5]\nnormal = [0.0, 1.0]\n"
                              "[arrangement]\nradius = 0.3\nmass = 1.0\ncount = 3\n"),
              IsAt("case.toml", "arrangement.count"));
  const auto round = read("",
                          "[domain]\ndisc = { radius = 3.0 }\n[[plane]]\npoint = [0.0, 0.0]\n"
                          "normal = [0.0, 1.0]\n[arrangement]\nradius = 0.2\nmass = 1.0\n"
                          "count = 40\n");
  for (std::size_t k = 0; k < 40; ++k) EXPECT_GE(round.particles.position(k)[1], 0.21 * (1 - 1e-9));
}

TEST_F(ShearedPackings, NameAnUnknownKeyBeforeAMissingOne) {
  EXPECT_THAT(refused("", "[[particle]]\ncentre = [0.0, 0.0]\nradus = 0.5\nmass = 1.0\n"),
              IsAt("case.toml:10", "particle[0].radus"));
  EXPECT_THAT(refused("", "[[particle]]\ncentre = [0.0, 0.0]\nmass = 1.0\n"),
              IsAt("case.toml:8", "particle[0].radius"));
  EXPECT_THAT(refused("", kDisc + "[[plane]]\npoint = [0.0, 0.0]\nnormel = [0.0, 1.0]\n"),
              IsAt("case.toml:14", "plane[0].normel"));
}

}  // namespace
}  // namespace viscontact::particles
