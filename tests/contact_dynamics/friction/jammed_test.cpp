// A packing that comes to rest with friction: what a step leaves that does not reach the
// tolerances.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/contact_dynamics/box2d/box2d_case.hpp"
#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

/// Runs `count` discs in the box of the benchmark with mu_s = 0.3 until they lie on each other.
template <class Visit>
void run_box(int count, double gamma_min, int max_iterations, const Visit& visit) {
  constexpr double kEnd = 8;
  auto setting = box(count);
  setting.solver = {1e-6, 1e-10, max_iterations};
  setting.laws.film.gamma_min = gamma_min;
  setting.laws.friction = FrictionLaw{0.3, FrictionMethod::kCoulomb};
  auto discs = particles_in_box(count);
  add_rotation(discs.particles);
  Simulation simulation(setting, std::move(discs), 1);
  while (simulation.state().time < kEnd * (1 - 1e-9)) visit(simulation.step(kEnd));
}

TEST(JammedFriction, AStepThatDoesNotReachTheTolerancesHasNoOverlap) {
  int unsolved = 0;
  for (const double gamma_min : {0.0, -2.0}) {
    SCOPED_TRACE(gamma_min);
    int contacts = 0;
    // 100 iterations are too few for Coulomb's law in this packing: 2 steps without films and 34
    // with films are not solved.
    run_box(300, gamma_min, 100, [&](const StepReport& report) {
      unsolved += report.converged ? 0 : 1;
      contacts = std::max(contacts, static_cast<int>(report.contacts));
      // solver.tolerance, in mean radii
      EXPECT_LE(report.largest_overlap, 1e-6) << report.time;
    });
    EXPECT_GT(contacts, 400);  // the discs lie on each other
  }
  EXPECT_GT(unsolved, 10);
}

/// Places and angles of 40 particles that have fallen into the box, in lengths of the unit `unit`.
std::vector<double> places_in_unit(double unit, int dimension, FrictionMethod method,
                                   double gamma_min) {
  constexpr int kCount = 40;
  auto setting = box(kCount, dimension);
  setting.gravity = unit * setting.gravity;
  for (auto& plane : setting.planes) plane.start.point = unit * plane.start.point;
  setting.laws.film.gamma_min = unit * gamma_min;
  setting.laws.friction = FrictionLaw{0.3, method};
  auto state = particles_in_box(kCount, dimension);
  auto& p = state.particles;
  for (auto& x : p.positions) x *= unit;
  for (auto& radius : p.radii) radius *= unit;
  add_rotation(p);
  Simulation simulation(setting, std::move(state), 1);
  while (simulation.state().time < 6) simulation.step(6);
  auto places = simulation.state().particles.positions;
  for (auto& x : places) x /= unit;
  const auto& angles = simulation.state().particles.angles;
  places.insert(places.end(), angles.begin(), angles.end());
  return places;
}

TEST(JammedFriction, HasTheSameBitsInUnitsThatArePowersOfTwo) {
  for (const auto method : {FrictionMethod::kCoulomb, FrictionMethod::kConvex})
    for (const int dimension : {2, 3})
      for (const double gamma_min : {0.0, -2.0}) {
        SCOPED_TRACE(testing::Message() << dimension << " dimensions, gamma_min " << gamma_min);
        const double unit = gamma_min == 0 ? 0x1p-20 : 0x1p20;
        EXPECT_EQ(places_in_unit(unit, dimension, method, gamma_min),
                  places_in_unit(1, dimension, method, gamma_min));
      }
}

TEST(JammedFriction, CoulombsLawConvergesInEveryStep) {
  for (const double gamma_min : {0.0, -2.0})
    run_box(100, gamma_min, 10000,
            [&](const StepReport& report) { EXPECT_TRUE(report.converged) << report.time; });
}

}  // namespace
}  // namespace viscontact::particles
