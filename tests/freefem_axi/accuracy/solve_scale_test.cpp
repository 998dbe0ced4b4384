// Viscosities and velocities so large or small that FreeFEM's arithmetic fails with them as they
// are: at a viscosity of 1e100 a force was wrong by 70 decades, at 1e-15 the solver failed.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/freefem_axi/tabulations.hpp"
#include "viscontact/freefem_axi/row_picture.hpp"

namespace viscontact::freefem_axi {
namespace {

constexpr double kGap = 0.25;
// Between two solves of the same problem there is round-off only (extrapolation.idp).
constexpr double kRoundOff = 1e-11;

Tabulation tabulation_of_viscosity(double viscosity) {
  auto tabulation = unit_tabulation({kGap}, 2.5, 1e-3);
  tabulation.viscosity = viscosity;
  return tabulation;
}

TEST(SolveScale, IsOneForOrdinaryNumbers) {
  // Tables that were made before must stay as they are.
  for (const double ordinary : {1e-9, 1e-3, 1.0, 3.0, 1e9}) {
    EXPECT_EQ(solve_scale(tabulation_of_viscosity(ordinary), -1).viscosity, 1);
    EXPECT_EQ(solve_scale(tabulation_of_viscosity(1), -ordinary).speed, 1);
  }
}

TEST(SolveScale, ForceIsLinearInViscosityAndVelocityAtAnySize) {
  const auto unit = solve_row(default_freefem(), tabulation_of_viscosity(1), kGap, -1);
  for (const auto& [viscosity, velocity] : {std::pair(1e100, 1e-30), std::pair(1e-15, -1e200)}) {
    const auto row =
        solve_row(default_freefem(), tabulation_of_viscosity(viscosity), kGap, velocity);
    SCOPED_TRACE(viscosity);
    EXPECT_NEAR(row.force / viscosity / (-velocity) / unit.force, 1, kRoundOff);
    EXPECT_NEAR(row.force_factor / unit.force_factor, 1, kRoundOff);
    EXPECT_EQ(row.reference_velocity, velocity);
    EXPECT_EQ(row.degrees_of_freedom, unit.degrees_of_freedom);
  }
}

TEST(SolveScale, ForceThatNoDoubleHoldsIsAnError) {
  for (const auto& [viscosity, velocity] : {std::pair(1e300, -1e300), std::pair(1e-300, -1e-300)})
    EXPECT_THAT(failure(ErrorKind::kBadInput,
                        [&, viscosity = viscosity, velocity = velocity] {
                          (void)solve_row(default_freefem(), tabulation_of_viscosity(viscosity),
                                          kGap, velocity);
                        }),
                Names("double"));
}

TEST(SolveScale, FlowOfAPictureHasTheCasesUnits) {
  constexpr double kViscosity = 1e20, kSpeed = 1e-12;
  const auto unit = solve_row_for_picture(default_freefem(), tabulation_of_viscosity(1), kGap, -1);
  const auto scaled =
      solve_row_for_picture(default_freefem(), tabulation_of_viscosity(kViscosity), kGap, -kSpeed);
  ASSERT_EQ(scaled.flow.x, unit.flow.x);
  ASSERT_EQ(scaled.flow.y, unit.flow.y);
  const auto expect_scaled = [](const std::vector<double>& values, const std::vector<double>& plain,
                                double factor) {
    ASSERT_EQ(values.size(), plain.size());
    const double largest = std::abs(
        *std::ranges::max_element(plain, {}, [](double value) { return std::abs(value); }));
    for (std::size_t i = 0; i < plain.size(); ++i)
      ASSERT_NEAR(values[i] / factor, plain[i], kRoundOff * largest) << i;
  };
  expect_scaled(scaled.flow.pressure, unit.flow.pressure, kViscosity * kSpeed);
  expect_scaled(scaled.stream_function, unit.stream_function, kSpeed);
  expect_scaled(scaled.flow.velocity_x, unit.flow.velocity_x, kSpeed);
  expect_scaled(scaled.flow.velocity_y, unit.flow.velocity_y, kSpeed);
}

}  // namespace
}  // namespace viscontact::freefem_axi
