// Two free spheres: the exact solution of Batchelor & Green 1972, and LF_DEM's near-contact terms.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <sstream>

#include "tests/suspensions/spheres.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::particles {
namespace {

Setting unbounded(PairTerms pairs, double drag) {
  auto setting = sheared_cube(1, 0);
  setting.domain = {};
  setting.lubrication->pairs = pairs;
  setting.lubrication->drag = drag;
  return setting;
}

/// The rows of data/reference/two_free_spheres.csv.
std::vector<std::vector<double>> rows() {
  std::istringstream lines(read_file(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) /
                                     "data/reference/two_free_spheres.csv"));
  std::vector<std::vector<double>> found;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with("size_ratio")) continue;
    std::istringstream fields(line);
    auto& numbers = found.emplace_back();
    for (std::string word; std::getline(fields, word, ',');)
      numbers.push_back(parse_number(word).value());
  }
  return found;
}

TEST(FreePair, MovesByTheTablesAsTwoSpheresAloneDo) {
  const Vector n{0.6, 0.64, 0.48};
  const Vector rotation{0, 0, -0.5}, strained{n[1] / 2, n[0] / 2, 0};
  int compared = 0;
  for (const auto& numbers : rows()) {
    const double r = numbers.at(1), a = numbers.at(4), b = numbers.at(5), c = numbers.at(6);
    const double along = dot(n, strained);
    const Vector expected =
        r * (cross(rotation, n) + strained - a * along * n - b * (strained - along * n));
    for (const double drag : {1.0, 1e-8}) {
      auto setting = unbounded(PairTerms::kTables, drag);
      setting.lubrication->regularisation = 0;
      setting.lubrication->range = 5;
      SuspensionSimulation simulation(setting, spheres_at({{}, r * n}, {1, 1}), 1);
      simulation.solve_instant();
      const auto& p = simulation.state().particles;
      // The tables have errors of 1e-5 of a resistance, and here of 1.5e-6 of velocities.
      EXPECT_LT(norm(p.velocity(1) - p.velocity(0) - expected), 1e-5) << numbers.at(1);
      for (const std::size_t k : {0U, 1U})
        EXPECT_LT(
            norm(point_of(p.angular_velocities.data(), k, 3) - rotation - c * cross(n, strained)),
            1e-5)
            << numbers.at(1);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 16);
}

TEST(FreePair, HasTheStressletsOfTwoSpheresAlone) {
  const double length = 100, half = std::sqrt(0.5);
  int compared = 0;
  for (const auto& numbers : rows()) {
    const double r = numbers.at(1), s0 = numbers.at(8), s1 = numbers.at(9), s2 = numbers.at(10);
    const std::array<std::pair<Vector, double>, 3> cases{
        {{{1, 0, 0}, s1}, {{0, 0, 1}, s2}, {{half, half, 0}, (3 * s0 + s2) / 4}}};
    for (const auto& [n, expected] : cases) {
      auto setting = sheared_cube(length, 0);
      setting.lubrication->pairs = PairTerms::kTables;
      setting.lubrication->regularisation = 0;
      setting.lubrication->range = 5;
      const Vector middle{50, 50, 50};
      SuspensionSimulation simulation(setting, spheres_at({middle, middle + r * n}, {1, 1}), 1);
      const double found = (simulation.solve_instant().viscosity - 1) * length * length * length;
      // The tables have errors of 1e-5 of a resistance.
      EXPECT_NEAR(found / (20 * M_PI / 3), expected, 5e-5) << numbers.at(1);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 24);
}

TEST(FreePair, OfUnequalSpheresHasTheNearContactMotion) {
  // Computed apart from Viscontact with 20 digits; the gradient is along z there.
  const std::array<std::array<double, 6>, 2> expected{
      {{4.04288600963463839e-1, 8.50371078663853903e-2, 4.18349564561581314e-1,
        2.29612602347801725e-2, 5.58983468793210234e-1, -3.41789751586422415e-2},
       {1.66122242788324012, -6.07407913331324217e-2, -2.98821117543986653e-1,
        1.6891189759188241e-2, 5.43390517500086612e-1, -2.51433740690206641e-2}}};
  auto setting = unbounded(PairTerms::kNearContact, 1);
  setting.lubrication->viscosity = 1 / (6 * M_PI);
  setting.lubrication->gradient = {};
  setting.lubrication->gradient[0][2] = 1;
  SuspensionSimulation simulation(setting, spheres_at({{}, {1.31, 0.62, 1.95}}, {1, 1.4}), 1);
  simulation.solve_instant();
  const auto& p = simulation.state().particles;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(p.velocity(k)[d], expected[k][d], 1e-12);
      EXPECT_NEAR(p.angular_velocities[3 * k + d], expected[k][3 + d], 1e-12);
    }
}

}  // namespace
}  // namespace viscontact::particles
