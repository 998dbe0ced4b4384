// The walls of a domain as obstacles: their order, gaps and normals, and discs that stay in them.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

std::vector<double> gaps_of(const Domain& domain, const Vector& centre, double radius) {
  std::vector<double> gaps;
  for (const auto& place : positions_of(obstacles_of(domain), 0))
    gaps.push_back(gap(place, centre, radius));
  return gaps;
}

const DiscDomain kDisc{{1, 2, 0}, 5};

TEST(Obstacles, OfABoxAreLeftRightBottomTop) {
  BoxDomain box{{-1, -2}, {3, 7}, {false, false}};
  EXPECT_EQ(gaps_of(box, {0, 0, 0}, 0.5), (std::vector<double>{0.5, 2.5, 1.5, 6.5}));
  box.periodic = {true, false};
  EXPECT_EQ(gaps_of(box, {0, 0, 0}, 0.5), (std::vector<double>{1.5, 6.5}));
  box.periodic = {true, true};
  EXPECT_TRUE(obstacles_of(box).empty());
}

TEST(Obstacles, OfACuboidAreLeftRightFrontBackBottomTop) {
  BoxDomain box{{-1, -2, -3}, {3, 7, 5}, {}};
  EXPECT_EQ(gaps_of(box, {0, 0, 0}, 0.5), (std::vector<double>{0.5, 2.5, 1.5, 6.5, 2.5, 4.5}));
  box.periodic = {true, true, false};
  EXPECT_EQ(gaps_of(box, {0, 0, 0}, 0.5), (std::vector<double>{2.5, 4.5}));
  EXPECT_EQ(measure(box), 4 * 9 * 8);
}

TEST(Obstacles, OfACylinderAreSideFloorLid) {
  EXPECT_EQ(gaps_of(CylinderDomain{5, 10}, {3, 0, 0}, 1), (std::vector<double>{4, 2, 6}));
  // The side does not push along the axis.
  const auto places = positions_of(obstacles_of(CylinderDomain{5, 10}), 0);
  EXPECT_EQ(places[0].normal[0], 0);
  EXPECT_EQ(places[1].normal[0], 1);
  EXPECT_EQ(places[2].normal[0], -1);
}

TEST(Obstacles, OfADiscIsTheCircleSeenFromInside) {
  const auto place = obstacles_of(kDisc).at(0).at(0);
  EXPECT_DOUBLE_EQ(gap(place, {4, 6, 0}, 0.25), -0.25);  // at the distance 5 from the centre
  EXPECT_DOUBLE_EQ(gap(place, {1, 2, 0}, 2), 3);
  const Vector inward = normal_at(place, {4, 6, 0});
  EXPECT_DOUBLE_EQ(inward[0], -0.6);
  EXPECT_DOUBLE_EQ(inward[1], -0.8);
  EXPECT_DOUBLE_EQ(norm(normal_at(place, {1, 2, 0})), 1);  // in the centre any direction
}

TEST(Obstacles, TangentHasTheGapAndNormalOfTheCircle) {
  const auto place = obstacles_of(kDisc).at(0).at(0);
  const Vector centre = {3, -1, 0};
  const auto tangent = tangent_at(place, centre);
  EXPECT_FALSE(tangent.is_curved());
  EXPECT_NEAR(gap(tangent, centre, 0.5), gap(place, centre, 0.5), 1e-14);
  EXPECT_EQ(tangent.normal, normal_at(place, centre));
}

TEST(Obstacles, WallsOfTheDomainComeBeforeThePlanes) {
  Setting setting;
  setting.domain = kDisc;
  setting.planes = {plane_at_rest({0, 0, 0}, {0, 1, 0})};
  const auto obstacles = obstacles_of(setting);
  ASSERT_EQ(obstacles.size(), 2U);
  EXPECT_TRUE(obstacles[0].start.is_curved());
  EXPECT_FALSE(obstacles[1].start.is_curved());
}

TEST(Obstacles, ContactOnAnAxisHasOneComponent) {
  State state = no_particles(1);
  add_particle(state, {3, 0, 0}, 1, 1);
  add_particle(state, {7, 0, 0}, 2, 1);
  const auto places = positions_of(obstacles_of(CylinderDomain{5, 10}), 0);
  const auto pair = contact_of<1>(state.particles, {0, 1, -0.5, 0.25}, places);
  EXPECT_EQ(pair.gap, 1);
  EXPECT_EQ(pair.normal[0], 1);
  EXPECT_EQ(pair.lowest, -0.5);
  EXPECT_EQ(pair.impulse, 0.25);
  const auto lid = contact_of<1>(state.particles, {-3, 1}, places);
  EXPECT_EQ(lid.first, -1);
  EXPECT_EQ(lid.gap, 1);
  EXPECT_EQ(lid.normal[0], -1);
  EXPECT_EQ(contact_of<1>(state.particles, {-1, 1}, places).gap, 3);
}

/// Discs of many sizes in a circle under gravity.
Simulation discs_in_a_circle(double time_step) {
  Setting setting;
  setting.domain = DiscDomain{{10, -20, 0}, 6};
  setting.gravity = {0.3, -1, 0};
  setting.laws.film.gamma_min = 0;
  setting.time_step = time_step;
  Random random(7);
  State state = random_cloud(
      2, 40, 6, [&] { return random.uniform(0.15, 0.4); }, random);
  for (std::size_t k = 0; k < state.particles.count(); ++k) {
    state.particles.positions[2 * k] += 10;
    state.particles.positions[2 * k + 1] -= 20;
  }
  return {setting, state, 1};
}

TEST(Obstacles, DiscsStayInACircle) {
  auto simulation = discs_in_a_circle(0.02);
  run(simulation, 8, [&](const StepReport& report) {
    ASSERT_TRUE(report.converged);
    // Overlaps of the tangents' gaps are within the tolerance 1e-6; the circle itself curves away
    // from them by the square of the sideways motion that contacts add.
    ASSERT_LT(largest_overlap(simulation.setting(), simulation.state()), 2e-3);
  });
  EXPECT_FALSE(simulation.state().walls.empty());
}

/// A disc slides along a circle without losing speed but for errors of first order in the step: it
/// is a pendulum without friction, of length R - r. A quarter of its period is known.
TEST(Obstacles, DiscSwingsInACircleLikeAPendulum) {
  const double length = 4, angle = 0.01;
  Setting setting;
  setting.domain = DiscDomain{{0, 0, 0}, 5};
  setting.gravity = {0, -1, 0};
  setting.laws.film.gamma_min = 0;
  setting.time_step = 1e-3;
  State state = no_particles(2);
  add_particle(state, {length * std::sin(angle), -length * std::cos(angle), 0}, 1, 2);
  Simulation simulation(setting, state, 1);
  const double quarter = std::acos(-1.0) / 2 * std::sqrt(length);
  run(simulation, quarter, [&](const StepReport& report) { ASSERT_TRUE(report.converged); });
  const auto& p = simulation.state().particles;
  // An error of one step in time is 1e-3/quarter of the amplitude; the law itself is exact to
  // angle^2.
  EXPECT_NEAR(p.positions[0], 0, 3e-3 * length * angle);
  EXPECT_NEAR(p.velocities[0], -std::sqrt(length) * angle, 3e-3 * std::sqrt(length) * angle);
  EXPECT_LT(largest_overlap(simulation.setting(), simulation.state()), 1e-6);
}

/// A step in which a disc would leave the circle by far ends at the circle, from any place.
TEST(Obstacles, FastDiscDoesNotLeaveACircle) {
  for (const Vector& start : {Vector{0, 0, 0}, Vector{0, 3, 0}, Vector{-3.9, 0, 0}}) {
    Setting setting;
    setting.domain = DiscDomain{{0, 0, 0}, 5};
    setting.laws.film.gamma_min = 0;
    setting.time_step = 1;
    State state = no_particles(2);
    add_particle(state, start, 1, 2, {30, 8, 0});
    Simulation simulation(setting, state, 1);
    EXPECT_TRUE(simulation.step(1e300).converged);
    EXPECT_LT(largest_overlap(simulation.setting(), simulation.state()), 1e-6);
  }
}

}  // namespace
}  // namespace viscontact::particles
