// Where discs of a body that overlap are cut, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/setting/chords.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

using std::numbers::pi;

Particles discs(const Vector& at, double first, double second) {
  State state = no_particles(2);
  add_particle(state, {0.3, -0.2, 0}, first, 1);
  add_particle(state, Vector{0.3, -0.2, 0} + at, second, 1);
  add_rotation(state.particles);
  return state.particles;
}

TEST(OverlappingMembers, ShareALens) {
  // Two unit discs at the distance d share 2 acos(d/2) - d/2 sqrt(4 - d^2).
  for (const double d : {0.1, 1.0, 1.9}) {
    const auto p = discs({d * std::cos(0.4), d * std::sin(0.4), 0}, 1, 1);
    const auto first = chord_of(p, 0, 1), second = chord_of(p, 1, 0);
    ASSERT_TRUE(first && second);
    const double lens = 2 * std::acos(d / 2) - d / 2 * std::sqrt(4 - d * d);
    EXPECT_NEAR(first->area + second->area, lens, 1e-14);
    EXPECT_NEAR(first->area, second->area, 1e-14);
    EXPECT_NEAR(first->middle, 0.4, 1e-14);
    EXPECT_NEAR(first->wedge, pi - 2 * std::asin(d / 2), 1e-14);
    EXPECT_EQ(first->from, second->to);
    EXPECT_EQ(first->to, second->from);
  }
}

TEST(OverlappingMembers, OfWhichOneIsSmallLoseMoreOfIt) {
  // The circles of the radii 5 and 3 at the distance 4 meet on the line through the centre of the
  // smaller one, of which a half is cut.
  const auto p = discs({4, 0, 0}, 5, 3);
  EXPECT_NEAR(chord_of(p, 1, 0)->area, pi * 9 / 2, 1e-13);
  EXPECT_NEAR(chord_of(p, 0, 1)->area, 25 * std::atan2(3, 4) - 12, 1e-13);
}

TEST(OverlappingMembers, MustMeet) {
  EXPECT_FALSE(chord_of(discs({2.001, 0, 0}, 1, 1), 0, 1));
  EXPECT_FALSE(chord_of(discs({0.1, 0, 0}, 1, 0.5), 0, 1));
}

Fluid rigid_fluid() {
  Fluid fluid;
  fluid.constraint = RigidConstraint::kRigid;
  return fluid;
}

TEST(OverlappingMembers, AreDiscsOfOneBodyThatIsHeldRigid) {
  auto p = discs({1, 0, 0}, 1, 1);
  EXPECT_TRUE(cut_areas_of(rigid_fluid(), p).empty());
  add_rigid_body(p, {{0, 1}});
  const auto areas = cut_areas_of(rigid_fluid(), p);
  ASSERT_EQ(areas.size(), 2U);
  EXPECT_NEAR(areas[0] + areas[1], 2 * pi / 3 - std::sqrt(3) / 2, 1e-14);
  EXPECT_TRUE(cut_areas_of({}, p).empty());  // by penalty
  p.shapes = {Shape::plate(1, 0.1), Shape::disc(1)};
  EXPECT_TRUE(cut_areas_of(rigid_fluid(), p).empty());
}

// Four discs in a row, of which each overlaps three: what is left of them is the union, whose area
// is the integral of its height over x.
TEST(OverlappingMembers, InARowCoverTheUnionOnce) {
  State state = no_particles(2);
  const std::array<double, 4> places = {0, 0.5, 1, 1.5}, radii = {1, 1.02, 1.01, 0.99};
  for (std::size_t k = 0; k < 4; ++k) add_particle(state, {places[k], 0, 0}, radii[k], 1);
  add_rotation(state.particles);
  add_rigid_body(state.particles, {{0, 1, 2, 3}});
  auto fluid = rigid_fluid();
  fluid.cut_areas = cut_areas_of(fluid, state.particles);
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += fluid.size_of(Shape::disc(radii[k]), k);
  double integral = 0;
  constexpr int kStrips = 200000;
  constexpr double kFrom = -1.1, kTo = 2.5, kStrip = (kTo - kFrom) / kStrips;
  for (int i = 0; i < kStrips; ++i) {
    double square = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = kFrom + (i + 0.5) * kStrip - places[k];
      square = std::max(square, radii[k] * radii[k] - x * x);
    }
    integral += 2 * std::sqrt(square) * kStrip;
  }
  EXPECT_NEAR(sum, integral, 1e-6);  // strips at the ends of a disc have errors of kStrip^1.5
}

}  // namespace
}  // namespace viscontact::particles
