// Suspensions in cells that any linear flow strains.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/common/failure.hpp"
#include "tests/suspensions/spheres.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/suspensions/cell/strained_lattice.hpp"
#include "viscontact/suspensions/values/affine_motion.hpp"

namespace viscontact::particles {
namespace {

using suspensions::Matrix;

constexpr double kPeriod = 10;
// Rounding errors of iterations, which ten steps multiply.
constexpr double kBar = 1e-9;
constexpr Matrix kPlanar{Vector{1, 0, 0}, Vector{0, -1, 0}, Vector{0, 0, 0}};
constexpr Matrix kUniaxial{Vector{1, 0, 0}, Vector{0, -0.5, 0}, Vector{0, 0, -0.5}};
// Any flow, which no turn of the box keeps.
constexpr Matrix kGeneral{Vector{0.3, 0.8, -0.2}, Vector{-0.1, 0.2, 0.5}, Vector{0.4, 0, -0.5}};

Setting strained_cube(const Matrix& gradient) {
  auto setting = sheared_cube(kPeriod, 0);
  setting.lubrication->gradient = gradient;
  setting.time_step = 0.01;
  return setting;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) result[i][j] += a[i][k] * b[k][j];
  return result;
}
Matrix transposed(const Matrix& a) {
  Matrix result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = a[j][i];
  return result;
}

SuspensionSimulation moved(const Setting& setting, const State& state, int steps = 10) {
  SuspensionSimulation simulation(setting, state, 1);
  for (int n = 0; n < steps; ++n) EXPECT_TRUE(simulation.step(1e300).converged);
  return simulation;
}

std::vector<RelativeMotion> motions(const SuspensionSimulation& of, const Setting& setting) {
  std::vector<RelativeMotion> result;
  for (std::size_t k = 0; k < of.state().particles.count(); ++k)
    result.push_back(relative_motion(of, setting, k));
  return result;
}

class StrainedStep : public testing::TestWithParam<Matrix> {
 protected:
  Random random{51};
  State state = random_spheres(kPeriod, 0, two_sizes(40), 0.006, random);
  Setting setting = strained_cube(GetParam());
};

TEST_P(StrainedStep, OfTheOrderOfSpheres) {
  const auto order = shuffled(40);
  const auto here = moved(setting, state), there = moved(setting, reordered(state, order));
  std::vector<RelativeMotion> sorted;
  for (const auto k : order) sorted.push_back(relative_motion(here, setting, k));
  EXPECT_LT(largest_difference(sorted, motions(there, setting)), kBar);
  EXPECT_NEAR(here.rheology().viscosity, there.rheology().viscosity, kBar);
}

TEST_P(StrainedStep, OfTheOrigin) {
  const Vector shift{30, -20, 7};
  const auto start = displaced(state, [&](const Vector& x) { return x + shift; });
  auto shifted = setting;
  shifted.domain = BoxDomain{shift, shift + Vector{kPeriod, kPeriod, kPeriod}, {true, true, true}};
  const auto here = moved(setting, state), there = moved(shifted, start);
  EXPECT_LT(largest_difference(motions(here, setting), motions(there, shifted)), kBar);
}

TEST_P(StrainedStep, OfUnits) {
  for (int trial = 0; trial < 3; ++trial) {
    const double length = random.decades(-5, 5), time = random.decades(-5, 5);
    const double mass = random.decades(-5, 5);
    auto other = setting;
    const double period = length * kPeriod;
    other.domain = BoxDomain{{0, 0, 0}, {period, period, period}, {true, true, true}};
    other.lubrication->viscosity = mass / (length * time);
    for (auto& row : other.lubrication->gradient) row = (1 / time) * row;
    other.time_step = 0.01 * time;
    const auto here = moved(setting, state), there = moved(other, scaled(state, length));
    EXPECT_LT(
        largest_difference(motions(here, setting), in_units(motions(there, other), length, time)),
        kBar);
    EXPECT_NEAR(here.rheology().viscosity, there.rheology().viscosity, kBar);
  }
}

TEST_P(StrainedStep, OfATurnedOrMirroredFrame) {
  const auto start = SuspensionSimulation(setting, state, 1).state();
  for (const double sign : {1.0, -1.0}) {
    // Rows at right angles; with the sign -1 also a mirror.
    Matrix turn{};
    turn[0] = {0.36, 0.48, -0.8};
    turn[1] = {-0.8, 0.6, 0};
    turn[2] = sign * Vector{0.48, 0.64, 0.6};
    auto turned = setting;
    turned.lubrication->gradient = product(product(turn, GetParam()), transposed(turn));
    const Vector middle{kPeriod / 2, kPeriod / 2, kPeriod / 2};
    auto there = displaced(
        start, [&](const Vector& x) { return middle + suspensions::times(turn, x - middle); });
    for (std::size_t k = 0; k < 3; ++k)
      there.shear.periods[k] = suspensions::times(turn, start.shear.periods[k]);
    const auto one = moved(setting, state), other = moved(turned, there);
    auto expected = motions(one, setting);
    for (auto& motion : expected) {
      motion.along = suspensions::times(turn, motion.along);
      motion.turn = sign * suspensions::times(turn, motion.turn);
    }
    EXPECT_LT(largest_difference(expected, motions(other, turned)), kBar);
    EXPECT_NEAR(one.rheology().viscosity, other.rheology().viscosity, kBar);
    EXPECT_NEAR(one.rheology().pressure, other.rheology().pressure, kBar);
  }
}

TEST_P(StrainedStep, ContinuesBitForBit) {
  const auto whole = moved(setting, state, 12), part = moved(setting, state, 5);
  const auto rest = moved(setting, part.state(), 7);
  EXPECT_EQ(whole.state().particles.positions, rest.state().particles.positions);
  EXPECT_EQ(whole.state().shear, rest.state().shear);
}

INSTANTIATE_TEST_SUITE_P(Flows, StrainedStep, testing::Values(kPlanar, kUniaxial, kGeneral));

TEST(StrainedCell, ShearOfAnotherPairOfAxesIsThatOfAnOffset) {
  Random random(52);
  const auto state = random_spheres(kPeriod, 0, two_sizes(40), 0.006, random);
  const auto exchanged = [](const Vector& x) { return Vector{x[1], x[0], x[2]}; };
  auto setting = strained_cube({Vector{0, 1, 0}, Vector{}, Vector{}});
  auto other = strained_cube({Vector{}, Vector{1, 0, 0}, Vector{}});
  const auto one = moved(setting, state), two = moved(other, displaced(state, exchanged));
  EXPECT_FALSE(one.state().shear.has_periods());
  EXPECT_TRUE(two.state().shear.has_periods());
  auto expected = motions(one, setting);
  for (auto& motion : expected) {
    motion.along = exchanged(motion.along);
    motion.turn = -1.0 * exchanged(motion.turn);
  }
  EXPECT_LT(largest_difference(expected, motions(two, other)), 1e-11);
  EXPECT_NEAR(one.rheology().viscosity, two.rheology().viscosity, 1e-12);
  EXPECT_NEAR(one.rheology().n1, -two.rheology().n1, 1e-12);
}

TEST(StrainedCell, OneSphereHasEinsteinsViscosityInEachFlow) {
  for (const auto& gradient : {kPlanar, kUniaxial, kGeneral}) {
    auto setting = strained_cube(gradient);
    setting.lubrication->pairs = PairTerms::kTables;
    SuspensionSimulation simulation(setting, spheres_at({Vector{1, 2, 3}}, {1}), 1);
    const double fraction = 4 * M_PI / 3 / std::pow(kPeriod, 3);
    EXPECT_NEAR(simulation.solve_instant().viscosity, 1 + 2.5 * fraction, 1e-12);
  }
}

TEST(StrainedCell, LargeStrainsLeaveNoOverlapAndASteadyViscosity) {
  Random random(53);
  const auto state = random_spheres(kPeriod, 0, std::vector<double>(70, 1.0), 0.004, random);
  for (const auto& gradient : {kPlanar, kUniaxial}) {
    auto setting = strained_cube(gradient);
    setting.time_step = 0.02;
    SuspensionSimulation simulation(setting, state, 1);
    double sum = 0, later = 0;
    for (int n = -60; n < 200; ++n) {
      const auto report = simulation.step(1e300);
      ASSERT_TRUE(report.converged);
      ASSERT_LE(report.largest_overlap, 1e-7);
      const auto& p = simulation.state().shear.periods;
      for (const double height : suspensions::heights_of(p)) ASSERT_GE(height, 0.78 * kPeriod);
      if (n >= 0) (n < 100 ? sum : later) += simulation.rheology().viscosity / 100;
    }
    // A small cell fluctuates.
    EXPECT_NEAR(sum, later, 0.25 * sum);
    EXPECT_GT(later, 1.2);
  }
}

TEST(StrainedCell, ABoxAsItIsEndsWithTheStrainReached) {
  auto setting = strained_cube(kPlanar);
  setting.lubrication->turns_box = false;
  setting.time_step = 0.02;
  SuspensionSimulation simulation(setting, spheres_at({Vector{1, 2, 3}, Vector{5, 5, 5}}, {1, 1}),
                                  1);
  const auto run = [&] {
    for (int n = 0; n < 200; ++n) simulation.step(1e300);
  };
  // The period along y falls to two distances of 2.5.
  EXPECT_THROW(run(), Error);
  EXPECT_NEAR(simulation.state().time, std::log(2.0), 0.021);
}

TEST(StrainedCell, AnExtensionContinuesAShear) {
  Random random(54);
  const auto state = random_spheres(kPeriod, 0, two_sizes(40), 0.006, random);
  const auto sheared =
      moved(strained_cube({Vector{0, 1, 0}, Vector{}, Vector{}}), state, 15).state();
  SuspensionSimulation strained(strained_cube(kPlanar), sheared, 1);
  const suspensions::Lattice left{Vector{kPeriod, 0, 0}, Vector{0.15 * kPeriod, kPeriod, 0},
                                  Vector{0, 0, kPeriod}};
  EXPECT_TRUE(suspensions::are_same(left, strained.state().shear.periods));
  EXPECT_EQ(strained.state().particles.position(0), sheared.particles.position(0));
  for (int n = 1; n <= 5; ++n) {
    EXPECT_LE(strained.step(1e300).largest_overlap, 1e-7);
    EXPECT_TRUE(suspensions::are_same(suspensions::carried_lattice(kPlanar, 0.01 * n, left),
                                      strained.state().shear.periods));
  }
}

/// kPlanar times a number.
Matrix planar(double rate) {
  auto gradient = kPlanar;
  for (auto& row : gradient) row = rate * row;
  return gradient;
}

/// Whether the cell of a run that continues `state` with kPlanar times `rate` still has the lattice
/// of the turned box after many steps, in which other cells have no images that stay apart.
void expect_lasting(const State& state, double rate) {
  auto setting = strained_cube(planar(rate));
  setting.time_step = 0.1;
  SuspensionSimulation simulation(setting, state, 1);
  for (int n = 0; n < 100; ++n) {
    simulation.step(1e300);
    for (const double height : suspensions::heights_of(simulation.state().shear.periods))
      ASSERT_GE(height, 0.86 * kPeriod);
  }
}

TEST(StrainedCell, LastsWhenAnotherRateContinuesIt) {
  for (const double first : {0.5, -0.5}) {
    const auto state =
        moved(strained_cube(planar(first)), spheres_at({{1, 2, 3}}, {1}), 37).state();
    for (const double rate : {0.5, 1.0, 0.7, -0.7}) expect_lasting(state, rate);
  }
}

/// A box whose lattice does not last against the flow.
Setting with_other_edges(const Matrix& gradient) {
  auto setting = strained_cube(gradient);
  setting.domain = BoxDomain{{0, 0, 0}, {10, 14, 10}, {true, true, true}};
  setting.time_step = 0.1;
  return setting;
}

TEST(StrainedCell, OfOtherEdgesIsTurnedForTheWayOnWhichTheFlowEnds) {
  const auto one = spheres_at({Vector{1, 2, 3}}, {1});
  auto wave = with_other_edges(kPlanar), pieces = wave;
  wave.lubrication->wave = Wave{-1, 0.2, 5, 0};
  pieces.lubrication->pieces = {{0.1, planar(0.5), {}}, {1e3, planar(-1), {}}};
  for (const auto& setting : {wave, pieces}) EXPECT_LT(moved(setting, one, 300).state().time, 31);
}

TEST(StrainedCell, OfOtherEdgesDoesNotGoBackFar) {
  auto setting = with_other_edges(kPlanar);
  const auto one = spheres_at({Vector{1, 2, 3}}, {1});
  setting.lubrication->pieces = {{9, planar(-1), {}}, {20, planar(1), {}}};
  const SuspensionSimulation near(setting, one, 1);
  setting.lubrication->pieces = {{30, planar(-1), {}}, {70, planar(1), {}}};
  EXPECT_THROW(SuspensionSimulation(setting, one, 1), Error);
  // A run that continues another one may go back farther.
  const auto there = moved(with_other_edges(planar(1)), one, 1).state();
  SuspensionSimulation back(with_other_edges(planar(-1)), there, 1);
  const auto stopped = failure(ErrorKind::kNotConverged, [&] {
    for (int n = 0; n < 200; ++n) back.step(1e300);
  });
  EXPECT_THAT(stopped, Says("edges in its plane are equal"));
  EXPECT_LT(back.state().shear.net_strain, -19);
}

TEST(StrainedCell, IsNotForInertiaUnlessTheFluidHasNone) {
  const auto one = spheres_at({Vector{1, 2, 3}}, {1});
  auto setting = strained_cube(kPlanar);
  setting.lubrication->inertia = true;
  EXPECT_THROW(SuspensionSimulation(setting, one, 1), Error);
  setting.lubrication->gradient = {Vector{}, Vector{1, 0, 0}, Vector{}};
  const SuspensionSimulation shear(setting, one, 1);
  setting.lubrication->wave = Wave{0, 1, 1, 0};
  EXPECT_THROW(SuspensionSimulation(setting, one, 1), Error);
}

TEST(StrainedCell, ComesBackWhenTheExtensionReverses) {
  Random random(55);
  const auto state = random_spheres(kPeriod, 0, two_sizes(40), 0.006, random);
  auto setting = strained_cube(kPlanar);
  auto back = kPlanar;
  for (auto& row : back) row = -2.0 * row;
  setting.lubrication->pieces = {{0.1, kPlanar, {}}, {1e9, back, {}}};
  const auto start = SuspensionSimulation(setting, state, 1).state().shear.periods;
  const auto there = moved(setting, state, 10);
  EXPECT_FALSE(suspensions::are_same(start, there.state().shear.periods));
  // The way back takes half of the time.
  const auto again = moved(setting, there.state(), 5);
  EXPECT_TRUE(suspensions::are_same(start, again.state().shear.periods));
}

TEST(StrainedCell, IsNotTurnedForFlowsThatAreNoMultiplesOfOne) {
  auto setting = strained_cube(kPlanar);
  setting.lubrication->pieces = {{0.02, kPlanar, {}}, {1e9, kUniaxial, {}}};
  const auto one = spheres_at({Vector{1, 2, 3}}, {1});
  const auto start = SuspensionSimulation(setting, one, 1).state();
  EXPECT_EQ(start.particles.position(0), (Vector{1, 2, 3}));
  const auto end = moved(setting, one, 4).state().shear.periods;
  EXPECT_NEAR(end[0][0], kPeriod * std::exp(0.04), 1e-12);
  EXPECT_NEAR(end[2][2], kPeriod * std::exp(-0.01), 1e-12);
}

TEST(StrainedCell, RefusesABoxThatIsTooSmallToLast) {
  auto setting = strained_cube(kUniaxial);
  setting.domain = BoxDomain{{0, 0, 0}, {6, 6, 6}, {true, true, true}};
  EXPECT_THROW(SuspensionSimulation(setting, spheres_at({Vector{1, 2, 3}}, {1}), 1), Error);
}

}  // namespace
}  // namespace viscontact::particles
