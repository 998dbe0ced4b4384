#include "viscontact/reduced_model/trajectory.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <ostream>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact::reduced_model {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

void expect_same_bits(const OptionalDouble& a, const OptionalDouble& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a.has_value()) {
    EXPECT_EQ(bits(*a), bits(*b)) << *a << " and " << *b;
  }
}

TEST(TrajectoryFile, ReadsBackToTheBit) {
  const double smallest = std::numeric_limits<double>::denorm_min();
  const double largest = std::numeric_limits<double>::max();
  Trajectory written;
  written.model = "viscous_contact";
  written.rows = {
      {-0.1, 0.1 + 0.2, -1.0 / 3, std::nextafter(1.0, 2.0), -200, -0.0},
      {0, 0, -0.0, {}, {}, {}},
      {smallest, smallest, -largest, largest, -smallest, -4e-5},
      {1e22, 5e-324, 1.7976931348623157e308, 0.1, {}, -1e-300},
  };
  written.film_from_gamma = 2.9708466100000004e-3;
  written.rebounds = {{0.1 + 0.2, -1.0 / 3, 5e-324, 0, 0}, {1, -2, 3, 1e-17, 5e-18}};
  written.steps = 123456789;
  written.seconds = 0.1;
  written.provenance = {{"fit", "fit.json"}, {"time_step", "0.001"}, {"a note", "with: a colon"}};

  const TemporaryFolder folder;
  const auto read = read_trajectory(folder.file("t.csv", write_trajectory(written)));
  EXPECT_EQ(read.model, written.model);
  EXPECT_EQ(read.steps, written.steps);
  EXPECT_EQ(read.provenance, written.provenance);
  EXPECT_EQ(bits(read.seconds), bits(written.seconds));
  EXPECT_EQ(read.film_from_gamma, written.film_from_gamma);
  EXPECT_EQ(read.rebounds, written.rebounds);
  ASSERT_EQ(read.rows.size(), written.rows.size());
  for (std::size_t i = 0; i < read.rows.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(bits(read.rows[i].time), bits(written.rows[i].time));
    EXPECT_EQ(bits(read.rows[i].gap), bits(written.rows[i].gap));
    EXPECT_EQ(bits(read.rows[i].velocity), bits(written.rows[i].velocity));
    expect_same_bits(read.rows[i].lubrication_force, written.rows[i].lubrication_force);
    expect_same_bits(read.rows[i].external_force, written.rows[i].external_force);
    expect_same_bits(read.rows[i].gamma, written.rows[i].gamma);
  }
}

TEST(TrajectoryFile, HasTheColumnsOfTheInterfaces) {
  Trajectory trajectory;
  trajectory.model = "m";
  trajectory.rows = {{0, 1, 2, 3, 4, {}}};
  EXPECT_THAT(write_trajectory(trajectory),
              AllOf(HasSubstr("\ntime,gap,velocity,lubrication_force,external_force,gamma,solid_"
                              "force\n0,1,2,3,4,,\n"),
                    HasSubstr("# model: m\n")));
}

TEST(TrajectoryFile, MayBeAUsersOwnWithThreeColumns) {
  const TemporaryFolder folder;
  const auto read = read_trajectory(
      folder.file("measured in the lab.csv", "time,gap,velocity\n0,1,-2\n1.5,0,0\n"));
  EXPECT_EQ(read.model, "measured in the lab");
  ASSERT_EQ(read.rows.size(), 2U);
  EXPECT_EQ(read.rows[1].time, 1.5);
  EXPECT_EQ(read.rows[0].velocity, -2);
  EXPECT_FALSE(read.rows[0].gamma || read.rows[0].external_force || read.rows[0].lubrication_force);
  EXPECT_FALSE(read.film_from_gamma);
}

TEST(TrajectoryFile, MayHaveItsColumnsInAnyOrderAndOthersBesides) {
  const TemporaryFolder folder;
  const auto read = read_trajectory(folder.file(
      "t.csv",
      "# a comment without a key\r\nvelocity, comment ,gap,gamma,time\r\n1,words,2,-3,4\r\n"));
  ASSERT_EQ(read.rows.size(), 1U);
  EXPECT_EQ(read.rows[0].time, 4);
  EXPECT_EQ(read.rows[0].gap, 2);
  EXPECT_EQ(read.rows[0].velocity, 1);
  EXPECT_EQ(read.rows[0].gamma, -3);
}

TEST(TrajectoryFile, TakesItsNameFromItsModelLine) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      read_trajectory(folder.file("t.csv", "# model: mine\ntime,gap,velocity\n0,1,0\n")).model,
      "mine");
}

struct WrongFile {
  const char* name;
  const char* content;
  int line;  // 0: of the file as a whole
  const char* key = "";
};

/// For the messages of GoogleTest.
void PrintTo(const WrongFile& file, std::ostream* stream) { *stream << file.name; }

class WrongTrajectoryFile : public ::testing::TestWithParam<WrongFile> {};

TEST_P(WrongTrajectoryFile, IsRefusedWithItsLine) {
  const TemporaryFolder folder;
  const auto path = folder.file("wrong.csv", GetParam().content);
  const auto line = GetParam().line > 0 ? ":" + std::to_string(GetParam().line) : "";
  EXPECT_THAT(bad_input([&] { read_trajectory(path); }),
              IsAt(path.string() + line, GetParam().key));
}

INSTANTIATE_TEST_SUITE_P(
    With, WrongTrajectoryFile,
    ::testing::Values(
        WrongFile{"NothingInIt", "", 0},  //
        WrongFile{"OnlyComments", "# model: a\n# b: c\n", 0},
        WrongFile{"NoRows", "time,gap,velocity\n", 0},
        WrongFile{"NoTime", "gap,velocity\n1,0\n", 0, "time"},
        WrongFile{"NoGap", "time,velocity\n1,0\n", 0, "gap"},
        WrongFile{"NoVelocity", "time,gap\n1,0\n", 0, "velocity"},
        WrongFile{"AColumnTwice", "time,gap,velocity,gap\n0,1,0,1\n", 0, "gap"},
        WrongFile{"ANegativeGap", "time,gap,velocity\n0,1,0\n1,-1e-9,0\n", 3, "gap"},
        WrongFile{"NaN", "# a: b\n# c: d\ntime,gap,velocity\n0,1,0\n1,nan,0\n", 5, "gap"},
        WrongFile{"Infinity", "time,gap,velocity\n0,1,inf\n", 2, "velocity"},
        WrongFile{"ANumberTooLarge", "time,gap,velocity\n0,1e400,0\n", 2, "gap"},
        WrongFile{"Words", "time,gap,velocity\n0,1,0\n0.5,one,0\n", 3, "gap"},
        WrongFile{"ACommaForAPoint", "time,gap,velocity\n0,5,1,0\n", 2},
        WrongFile{"AnEmptyGap", "time,gap,velocity\n0,1,0\n1,,0\n", 3, "gap"},
        WrongFile{"AnEmptyTime", "time,gap,velocity\n,1,0\n", 2, "time"},
        WrongFile{"AWrongGamma", "time,gap,velocity,gamma\n0,1,0,\n1,1,0,x\n", 3, "gamma"},
        WrongFile{"ARowTooShort", "time,gap,velocity\n0,1,0\n1,2\n", 3},
        WrongFile{"TheSameTimeTwice", "time,gap,velocity\n0,1,0\n1,1,0\n1,2,0\n", 4, "time"},
        WrongFile{"TimeThatGoesBack", "time,gap,velocity\n0,1,0\n1,1,0\n0.5,2,0\n", 4, "time"},
        WrongFile{"RowsCutOff", "# rows: 3\ntime,gap,velocity\n0,1,0\n1,1,0\n", 0, ""},
        WrongFile{"ReboundsOfFourNumbers",
                  "# rebounds: 1 -2 3 1 0.5; 1 -2 3 1\ntime,gap,velocity\n0,1,0\n", 0, "rebound"},
        WrongFile{"AWrongNumberAtItsHead", "# film_from_gamma: thin\ntime,gap,velocity\n0,1,0\n", 0,
                  "film_from_gamma"}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(TrajectoryFile, IsRefusedWhenItIsAFolderOrMissing) {
  const TemporaryFolder folder;
  for (const auto& path : {folder.path(), folder.path() / "missing.csv"})
    EXPECT_THAT(bad_input([&] { read_trajectory(path); }), IsAt(path.string()));
}

}  // namespace
}  // namespace viscontact::reduced_model
