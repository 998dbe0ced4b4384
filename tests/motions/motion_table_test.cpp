// The files of motion tables: what is written is read back, and what is wrong is refused.
#include "viscontact/motions/motion_table.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"

namespace viscontact::motions {
namespace {

using ::testing::HasSubstr;

MotionTable table_of_a_pair() {
  MotionTable table;
  table.motion = lubrication::MotionKind::kRoll;
  table.viscosity = 0.3;
  table.radius = 2;
  table.geometry = "sphere, radius 1, velocity_ratio 0";
  table.container = "unbounded";
  table.leading_force_factor = 1. / 3;
  table.leading_torque_factor = -0.2;
  table.case_hash = "abc";
  table.versions["FreeFEM"] = "4.9";
  table.tabulated_motions = {lubrication::MotionKind::kApproach, lubrication::MotionKind::kRoll};
  table.failed_rows = {{"gap 0.15", "no solution: 100 unknowns"}};
  MotionTableRow row;
  row.gap = 0.1;
  row.reference_velocity = -3;
  row.sphere = {-0.1, 2. / 3, 1e-7, 2e-7};
  row.neighbour = lubrication::ActionFactors{0.01, -0.02, 3e-7, 4e-7};
  row.degrees_of_freedom = 1234;
  row.seconds = 1.5;
  row.observed_order = 3.9;
  table.rows = {row, row};
  table.rows[1].gap = 0.2;
  return table;
}

class MotionTableFile : public ::testing::Test {
 protected:
  MotionTable read(const std::string& text) const {
    return read_motion_table(folder_.file("table.csv", text));
  }
  /// The text of a small table with one text replaced by another one.
  static std::string changed(const std::string& from, const std::string& to) {
    std::string text =
        "# motion: slide\n# viscosity: 1\n# radius: 1\ngap,reference_velocity,force,torque\n"
        "0.1,1,-40,2\n";
    return text.replace(text.find(from), from.size(), to);
  }
  TemporaryFolder folder_;
};

TEST_F(MotionTableFile, IsReadAsItWasWritten) {
  const auto table = table_of_a_pair();
  const auto text = write_motion_table(table);
  const auto again = read(text);
  EXPECT_EQ(write_motion_table(again), text);
  EXPECT_EQ(again.motion, lubrication::MotionKind::kRoll);
  ASSERT_EQ(again.rows.size(), 2U);
  EXPECT_EQ(again.rows[1].gap, 0.2);
  EXPECT_EQ(again.rows[0].sphere.torque, 2. / 3);
  EXPECT_EQ(again.rows[0].neighbour->torque_error_estimate, 4e-7);
  EXPECT_EQ(again.leading_force_factor, 1. / 3);
  EXPECT_EQ(again.tabulated_motions, table.tabulated_motions);
  EXPECT_EQ(again.failed_rows, table.failed_rows);
  // torque = -8 pi mu r^3 w0 * factor
  EXPECT_THAT(text, HasSubstr(fmt::format(",{},", 8 * std::numbers::pi * 0.3 * 8 * 3 * (2. / 3))));
}

TEST_F(MotionTableFile, OfOthersNeedsFourColumns) {
  const auto table = read(changed("", ""));
  EXPECT_NEAR(table.rows[0].sphere.force, 40 / (6 * std::numbers::pi), 1e-15);
  EXPECT_NEAR(table.rows[0].sphere.torque, -2 / (8 * std::numbers::pi), 1e-16);
  EXPECT_FALSE(table.rows[0].neighbour);
}

TEST_F(MotionTableFile, IsRefusedWithLineAndValue) {
  const auto failure = [&](const std::string& from, const std::string& to) {
    return bad_input([&] { (void)read(changed(from, to)); });
  };
  EXPECT_THAT(failure("slide", "glide"), HasSubstr("# motion: no motion is named 'glide'"));
  EXPECT_THAT(failure("slide", "approach"), HasSubstr("it must be slide, roll or spin"));
  EXPECT_THAT(failure("# motion: slide\n", ""), HasSubstr("has no line '# motion: ...'"));
  EXPECT_THAT(failure("0.1,1", "-0.1,1"), HasSubstr(":5: gap is -0.1; it must be > 0"));
  EXPECT_THAT(failure("0.1,1", "0.1,0"), HasSubstr("must be different from 0"));
  EXPECT_THAT(failure("-40", "40"), HasSubstr("force is 40 at velocity 1; it must be opposed"));
  EXPECT_THAT(failure(",torque", ",moment"), HasSubstr("column 'torque' is missing"));
  EXPECT_THAT(failure("radius: 1", "radius: 0"), HasSubstr("radius: is 0; it must be > 0"));
}

}  // namespace
}  // namespace viscontact::motions
