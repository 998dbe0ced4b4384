// A table that is a smooth wall's, shifted, gives its shift back.
#include "viscontact/fitting/wall_shift.hpp"

#include <gmock/gmock.h>

#include <string>

#include "tests/common/failure.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"

namespace viscontact::fitting {
namespace {

using ::testing::HasSubstr;

constexpr double kShift = 0.005;

lubrication::LubricationForce smooth() {
  return lubrication::LubricationForce(
      lubrication::read_fit(std::string(VISCONTACT_SOURCE_FOLDER) + "/data/fits/lecture.json"));
}

lubrication::MotionTable shifted_table() {
  const auto force = smooth();
  lubrication::MotionTable table;
  table.viscosity = force.viscosity();
  table.radius = force.radius();
  for (const double gap : {0.001, 0.01, 0.1, 1.0}) {
    lubrication::MotionRow row;
    row.gap = gap;
    row.reference_velocity = -2;
    row.force = 2 * force.resistance(gap + kShift);
    table.rows.push_back(row);
  }
  return table;
}

TEST(WallShift, OfAShiftedSmoothWallIsFoundRowByRowAndInCommon) {
  const auto found = fit_wall_shift(shifted_table(), smooth());
  // Round-off of the force, 1e-16, over its slope: a relative 1e-16 of the gap of 1.
  EXPECT_NEAR(found.shift, kShift, 1e-14);
  for (const auto& row : found.rows) EXPECT_NEAR(row.shift, kShift, 1e-14);
  EXPECT_LT(found.largest_relative_residual, 1e-12);
}

TEST(WallShift, OneRowThatIsAnotherShowsInItsResidual) {
  auto table = shifted_table();
  table.rows[2].force *= 1.01;
  const auto found = fit_wall_shift(table, smooth());
  EXPECT_LT(found.rows[2].shift, kShift);
  EXPECT_GT(found.largest_relative_residual, 5e-3);
  EXPECT_LT(found.largest_relative_residual, 1.01e-2);
}

TEST(WallShift, TakesAFitWhoseUnitsWereConverted) {
  auto table = shifted_table();
  table.viscosity *= 1 + 1e-15;
  table.radius *= 1 - 1e-15;
  EXPECT_NEAR(fit_wall_shift(table, smooth()).shift, kShift, 1e-14);
}

TEST(WallShift, RefusesAnotherFluidAndADragBeyondTheFit) {
  const auto fails_with = [](const lubrication::MotionTable& table, const char* words) {
    try {
      (void)fit_wall_shift(table, smooth());
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_THAT(error.what(), HasSubstr(words));
    }
  };
  auto table = shifted_table();
  table.viscosity *= 2;
  fails_with(table, "viscosity");
  table = shifted_table();
  table.rows[0].force *= 100;
  fails_with(table, "interval");
  // The fit's interval is [1e-3, 2]: the first gap needs a shift of 9e-4, the last one at most
  // 1e-4.
  table = shifted_table();
  table.rows.front().gap = 1e-4;
  table.rows.back().gap = 1.9999;
  fails_with(table, "no shift of the wall brings all gaps");
}

TEST(WallShift, RefusesASmoothWallWithAFormulaOutsideTheFit) {
  const auto fit =
      lubrication::read_fit(std::string(VISCONTACT_SOURCE_FOLDER) + "/data/fits/lecture.json");
  using lubrication::OutsideInterval;
  for (const auto& outside :
       {OutsideInterval{}.with_limits(), OutsideInterval{lubrication::BelowInterval::kTheoryLimit},
        OutsideInterval{.above = lubrication::AboveInterval::kStokesLimit}})
    EXPECT_THAT(bad_input([&] {
                  fit_wall_shift(shifted_table(), lubrication::LubricationForce(fit, outside));
                }),
                Names("OutsideInterval"));
}

}  // namespace
}  // namespace viscontact::fitting
