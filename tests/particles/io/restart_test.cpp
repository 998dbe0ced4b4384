// Restart files of this version and of the one before, and those that are refused.
#include "viscontact/particles/io/restart.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"

namespace viscontact::particles {
namespace {

using ::testing::HasSubstr;

/// A disc on a plane whose film pulls.
State disc_on_plane(double gamma) {
  State state = no_particles(2);
  add_particle(state, {0, 1, 0}, 1, 2, {0.5, 0, 0});
  state.walls.push_back({-1, 0, gamma, -0.25, 1e-9});
  state.time = 3;
  return state;
}

class RestartFile : public ::testing::Test {
 protected:
  State read(const std::string& text) const {
    return read_restart(folder_.file("restart.bin", text));
  }
  TemporaryFolder folder_;
};

TEST_F(RestartFile, IsReadAsItWasWritten) {
  const auto state = read(write_restart(disc_on_plane(-0.75)));
  EXPECT_EQ(state.time, 3);
  EXPECT_EQ(state.particles.masses, std::vector<double>{2});
  ASSERT_EQ(state.walls.size(), 1U);
  EXPECT_EQ(state.walls[0].gamma, -0.75);
  EXPECT_EQ(state.walls[0].impulse, -0.25);
  EXPECT_EQ(state.walls[0].gamma_error, 1e-9);
}

TEST_F(RestartFile, OfVersion1HasNoErrorsOfGamma) {
  const auto text = write_restart(disc_on_plane(-0.75));
  const auto first = text.find('\n') + 1, second = text.find('\n', first) + 1;
  auto bytes = text.substr(second);
  // The walls' films are followed by the lengths of two empty lists, 8 bytes each.
  ASSERT_EQ(bytes.substr(bytes.size() - 16), std::string(16, '\0'));
  bytes.erase(bytes.size() - 16 - sizeof(double), sizeof(double));
  auto head = text.substr(0, first);
  head.replace(head.find("version 2"), 9, "version 1");
  const auto state = read(head + "# sha256 of the rest: " + sha256(bytes) + "\n" + bytes);
  EXPECT_EQ(state.time, 3);
  ASSERT_EQ(state.walls.size(), 1U);
  EXPECT_EQ(state.walls[0].gamma, -0.75);
  EXPECT_EQ(state.walls[0].impulse, -0.25);
  EXPECT_EQ(state.walls[0].gamma_error, 0);
}

TEST_F(RestartFile, WithoutAFiniteGammaIsRefused) {
  for (const double gamma :
       {std::numeric_limits<double>::quiet_NaN(), 0.5, -std::numeric_limits<double>::infinity()})
    EXPECT_THAT(bad_input([&] { read(write_restart(disc_on_plane(gamma))); }),
                HasSubstr("is not a whole restart file"));
}

}  // namespace
}  // namespace viscontact::particles
