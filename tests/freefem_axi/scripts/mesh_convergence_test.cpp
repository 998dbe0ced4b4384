// Orders of convergence of the scripts in the mesh size against exact drags, on nested meshes each
// of half the size of the one before.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <ostream>

#include "tests/freefem_axi/scripts/levels.hpp"
#include "tests/oracles/bispherical/bispherical.hpp"
#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::freefem_axi {
namespace {

struct ExactDrag {
  std::string name, script;
  std::vector<std::string> arguments;
  double drag_factor = 0;
};

// What GoogleTest shows of the parameter.
std::ostream& operator<<(std::ostream& out, const ExactDrag& drag) { return out << drag.name; }

class MeshConvergence : public ::testing::TestWithParam<ExactDrag> {};

// One test for all: the numbers come from one run of seconds.
TEST_P(MeshConvergence, IsOfTwiceTheOrderInTheReactionsAsInTheBoundaryStress) {
  const double exact = 6 * std::numbers::pi * GetParam().drag_factor;
  // An accuracy that no mesh has, so that all levels are solved.
  std::vector<std::string> arguments = {"-radius",   "1",      "-viscosity", "1",       "-velocity",
                                        "-1",        "-cells", "2",          "-levels", "4",
                                        "-attempts", "1",      "-accuracy",  "1e-15"};
  arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const auto result = run_freefem(default_freefem(), GetParam().script, arguments);
  const auto levels = levels_of(result, 4);
  ASSERT_EQ(levels.size(), 4U);
  const auto force_error = [&](std::size_t level) { return levels[level][0] / exact - 1; };
  const auto stress_error = [&](std::size_t level) { return levels[level][1] / exact - 1; };

  // h^4: quadratic velocity in the energy norm, squared, on isoparametric edges. From the first
  // mesh, which has two layers of elements across the film, the order is already seen: 3.7 to 3.8,
  // then 3.86 to 3.91, then 3.94 to 3.96. Straight edges give 2.
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const double order = observed_order(force_error(i - 1), force_error(i));
    EXPECT_GT(order, 3.5) << i;
    EXPECT_LT(order, 4.5) << i;
    // Each triangle is cut into four: 4 times the unknowns, less what the boundaries share (3.7
    // observed from the first mesh).
    EXPECT_GT(levels[i][2], 3.5 * levels[i - 1][2]) << i;
  }
  // h^2: stress of the quadratic velocity on the boundary. The coarser meshes' orders go from 0.5
  // to 2; here 1.91, 2.03, 1.97.
  const double order = observed_order(stress_error(2), stress_error(3));
  EXPECT_GT(order, 1.7);
  EXPECT_LT(order, 2.3);
  // Two functionals of one solution: that they agree says that both are the drag. Observed 3e-4 at
  // most.
  EXPECT_LT(std::abs(stress_error(3)), 1e-3);
  // A direct solve: round-off. Observed 1e-13.
  for (const auto& level : levels) EXPECT_LT(level[3], 1e-11);

  // Extrapolation gains on the finest mesh at least as much as another refinement would, 16.
  // Observed 160 at least.
  std::istringstream answer(line_after(result.output, "viscontact-result"));
  double extrapolated = 0, estimate = 0;
  answer >> extrapolated >> estimate;
  const double error = std::abs(extrapolated / exact - 1);
  EXPECT_LT(error, std::abs(force_error(3)) / 16);
  EXPECT_LE(error, estimate);
}

INSTANTIATE_TEST_SUITE_P(
    Of, MeshConvergence,
    ::testing::Values(ExactDrag{"UnboundedFreeSurface",
                                "free_surface.edp",
                                {"-gap", "0.1", "-containerRadius", "0", "-containerHeight", "0"},
                                free_surface_drag_factor(0.1)},
                      ExactDrag{
                          "ConcentricCavity",
                          "cavity.edp",
                          {"-gap", "1", "-cavityRadius", "2"},
                          7.294117647058823529}),  // data/reference/sphere_in_cavity_concentric.csv
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace viscontact::freefem_axi
