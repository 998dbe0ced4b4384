// Resistance matrices by FreeFEM beside exact ones.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/freefem_axi/tabulations.hpp"
#include "tests/oracles/collinear_spheres.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"
#include "viscontact/swimmer/tabulation/collinear_spheres.hpp"

namespace viscontact::swimmer {
namespace {

struct Row {
  std::vector<double> radii, gaps;
};

std::ostream& operator<<(std::ostream& out, const Row& row) {
  for (const double radius : row.radii) out << radius << " ";
  for (const double gap : row.gaps) out << gap << " ";
  return out;
}

class ExactMatrix : public ::testing::TestWithParam<Row> {};

TEST_P(ExactMatrix, IsMetWithinTheAccuracyThatWasAskedAndWithinTheEstimates) {
  constexpr double kAccuracy = 1e-5;
  const auto& [radii, gaps] = GetParam();
  const auto row =
      solve_resistance(freefem_axi::default_freefem(), {1, radii, {}, kAccuracy}, gaps);
  const auto exact = exact_resistance(radii, gaps);
  const auto computed = matrix_of(row, radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i)
    for (std::size_t j = i; j < radii.size(); ++j) {
      const auto a = static_cast<Eigen::Index>(i), b = static_cast<Eigen::Index>(j);
      const double scale =
          std::max(std::abs(exact(a, b)), 1e-3 * std::sqrt(exact(a, a) * exact(b, b)));
      const double error = std::abs(computed(a, b) - exact(a, b)) / scale;
      const double estimate = row.relative_error_estimates[entry_position(i, j, radii.size())];
      EXPECT_LE(error, estimate) << "R" << i + 1 << j + 1;
      EXPECT_LE(estimate, kAccuracy) << "R" << i + 1 << j + 1;
    }
}

// The exact matrices have eight digits or more at these gaps (exact_resistance). A gap below 0.15
// of the smaller radius has a structured film.
INSTANTIATE_TEST_SUITE_P(Rows, ExactMatrix,
                         ::testing::Values(Row{{1, 1, 1}, {0.1, 0.1}},
                                           Row{{0.7, 1, 0.5, 1.2}, {0.5, 2, 0.14}}));

TEST(CollinearSpheres, InALongTubeHaveTheDragOfOneIfTheyAreFarApart) {
  const auto row =
      solve_resistance(freefem_axi::default_freefem(), {1, {1, 1}, Tube{2, {}}, 1e-5}, {14});
  EXPECT_NEAR(row.entries[1], 0, 1e-9);
  // One sphere in the middle of a cylinder that is 20 radii high at each side, by the other script.
  freefem_axi::Tabulation tabulation = freefem_axi::unit_tabulation({19}, 2, 1e-5);
  tabulation.container->height = 40;
  const auto one = freefem_axi::solve_row(freefem_axi::default_freefem(), tabulation, 19, -1);
  EXPECT_NEAR(row.entries[0] / one.force, 1, 2e-5);
  // A closed cylinder of 8 radii beyond both ends is as good as a long one.
  const auto closed =
      solve_resistance(freefem_axi::default_freefem(), {1, {1, 1}, Tube{2, 50}, 1e-5}, {14});
  EXPECT_NEAR(closed.entries[0] / row.entries[0], 1, 1e-6);
}

TEST(CollinearSpheres, UnitOfLengthScalesTheMatrix) {
  // In a tube, which needs fewer elements than unbounded fluid.
  const auto large =
      solve_resistance(freefem_axi::default_freefem(), {1, {1, 1}, Tube{2, 12}, 1e-2}, {1});
  const auto small = solve_resistance(freefem_axi::default_freefem(),
                                      {1e-3, {5e-5, 5e-5}, Tube{1e-4, 6e-4}, 1e-2}, {5e-5});
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(small.entries[i] / large.entries[i] / 5e-8, 1, 1e-9);
}

}  // namespace
}  // namespace viscontact::swimmer
