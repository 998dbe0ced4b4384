// The pull-back of stokes_problem.idp by itself: isoparametric.edp of this folder, with curved
// edges and with straight ones.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/freefem_axi/scripts/levels.hpp"
#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::freefem_axi {
namespace {

using std::numbers::pi;

constexpr double kConcentric =
    7.294117647058823529;  // data/reference/sphere_in_cavity_concentric.csv

// As the script prints them.
enum Quantity { kVolume, kCapacitance, kFlux, kDrag, kStress, kQuantities };
constexpr std::array<double, kQuantities> kExact = {28. / 3 * pi, 8 * pi, 8 * pi,
                                                    6 * pi* kConcentric, 6 * pi* kConcentric};

/// Relative errors on four meshes.
std::vector<std::array<double, kQuantities>> errors(const std::string& curved) {
  // An absolute path, and the include files of the folder under test.
  const auto result = run_freefem(
      default_freefem(), VISCONTACT_SOURCE_FOLDER "/tests/freefem_axi/scripts/isoparametric.edp",
      {"-curved", curved, "-levels", "4"});
  std::vector<std::array<double, kQuantities>> errors;
  for (const auto& level : levels_of(result, kQuantities)) {
    auto& error = errors.emplace_back();
    for (std::size_t i = 0; i < kQuantities; ++i) error[i] = level[i] / kExact[i] - 1;
  }
  EXPECT_EQ(errors.size(), 4U);
  return errors;
}

/// From the third mesh to the fourth.
double last_order(const std::vector<std::array<double, kQuantities>>& errors, Quantity quantity) {
  return observed_order(errors.at(2)[quantity], errors.at(3)[quantity]);
}

// Orders are within 0.15 of theory on the last two meshes, of 16 and 32 elements from sphere to
// sphere, 0.25 where it is said.
TEST(Isoparametric, CurvedEdgesGiveTheOrderOfTheElementsInGeometryEnergyAndForce) {
  const auto error = errors("1");
  EXPECT_NEAR(last_order(error, kVolume), 4, 0.15);       // observed 4.00
  EXPECT_NEAR(last_order(error, kCapacitance), 4, 0.15);  // 4.00
  EXPECT_NEAR(last_order(error, kDrag), 4, 0.15);         // 3.99
  // The derivatives on the boundary themselves, of quadratic functions.
  EXPECT_NEAR(last_order(error, kFlux), 2, 0.15);    // 1.95
  EXPECT_NEAR(last_order(error, kStress), 2, 0.15);  // 2.06
  // Far below what straight edges leave on the same mesh. Observed 3e-8 and 5e-7.
  EXPECT_LT(std::abs(error.at(3)[kCapacitance]), 1e-7);
  EXPECT_LT(std::abs(error.at(3)[kDrag]), 2e-6);
}

TEST(Isoparametric, StraightEdgesGiveTheOrderOfTheInscribedPolygon) {
  const auto error = errors("0");
  EXPECT_NEAR(last_order(error, kVolume), 2, 0.15);       // 2.00
  EXPECT_NEAR(last_order(error, kCapacitance), 2, 0.15);  // 1.95
  EXPECT_NEAR(last_order(error, kDrag), 2, 0.25);        // 1.79: changes sign on the coarser meshes
  EXPECT_GT(std::abs(error.at(3)[kCapacitance]), 5e-5);  // 8.7e-5
  EXPECT_GT(std::abs(error.at(3)[kDrag]), 5e-5);         // 7.9e-5
}

}  // namespace
}  // namespace viscontact::freefem_axi
