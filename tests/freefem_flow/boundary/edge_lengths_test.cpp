// Lengths of the edges of the mesh, and how curves are cut into edges. Lengths are in one unit.
#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/freefem_flow/placed_flow.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::CylinderDomain;
using particles::DiscDomain;
using std::numbers::pi;

EdgeLengths lengths_of(const particles::Domain& domain, const std::vector<Body>& bodies,
                       int edges = 24, double coarsening = 1) {
  const bool on_axis = std::holds_alternative<CylinderDomain>(domain);
  const auto particles = particles_of(bodies, on_axis ? 1 : 2);
  return EdgeLengths(fluid_with(edges), domain, {&particles, {}, {}, {}}, coarsening);
}

// The largest length of an edge beside a gap, as a fraction of the gap.
constexpr double kMostOfGap = 0.5;

TEST(EdgeLengths, OnAParticleFarFromOthersAreThoseAsked) {
  const auto lengths = lengths_of(DiscDomain{{}, 20}, {{0, 0, 1}, {8, 0, 0.5}}, 30);
  // The smaller disc has 30 edges, the other one edges of the same length.
  EXPECT_NEAR(lengths.on_particle(0, {-1, 0}), 2 * pi * 0.5 / 30, 1e-15);
  EXPECT_NEAR(lengths.on_particle(1, {8.5, 0}), 2 * pi * 0.5 / 30, 1e-15);
}

TEST(EdgeLengths, InANarrowGapAreAFractionOfIt) {
  for (const int edges : {12, 24, 48, 96})
    for (const double gap : {0.1, 0.01, 1e-3, 1e-6}) {
      SCOPED_TRACE(::testing::Message() << edges << " edges, gap " << gap);
      // Between two discs, between a disc and the wall, and across a period.
      const auto two = lengths_of(DiscDomain{{}, 20}, {{-1, 0, 1}, {1 + gap, 0, 1}}, edges);
      EXPECT_LE(two.on_particle(0, {0, 0}), kMostOfGap * gap * (1 + 1e-9));
      EXPECT_LE(two.on_particle(1, {gap, 0}), kMostOfGap * gap * (1 + 1e-9));
      const auto wall = lengths_of(DiscDomain{{}, 2 + gap}, {{1, 0, 1}}, edges);
      EXPECT_LE(wall.on_particle(0, {2, 0}), kMostOfGap * gap * (1 + 1e-9));
      EXPECT_LE(wall.on_wall({2 + gap, 0}), kMostOfGap * gap * (1 + 1e-9));
      const auto image =
          lengths_of(BoxDomain{{0, 0}, {2 + gap, 9}, {true, true}}, {{1, 1, 1}}, edges);
      EXPECT_LE(image.on_particle(0, {2, 1}), kMostOfGap * gap * (1 + 1e-9));
      EXPECT_LE(image.in_fluid({2 + gap / 2, 1}), kMostOfGap * gap * (1 + 1e-9));
      const auto floor = lengths_of(CylinderDomain{5, 10}, {{0, 1 + gap, 1}}, edges);
      EXPECT_LE(floor.on_particle(0, {0, gap}), kMostOfGap * gap * (1 + 1e-9));
      EXPECT_LE(floor.on_wall({0, 0}), kMostOfGap * gap * (1 + 1e-9));
      EXPECT_LE(floor.in_fluid({0, gap / 2}), kMostOfGap * gap * (1 + 1e-9));
    }
}

TEST(EdgeLengths, AllShrinkTogetherWithMoreEdges) {
  const std::vector<Body> bodies = {{-1.05, 0, 1}, {1.05, 0, 1}};
  const auto some = lengths_of(DiscDomain{{}, 6}, bodies, 24);
  const auto twice = lengths_of(DiscDomain{{}, 6}, bodies, 48);
  for (const Point x : {Point{-0.05, 0}, Point{-2.05, 0}, Point{-1.05, 1}})
    EXPECT_NEAR(twice.on_particle(0, x), some.on_particle(0, x) / 2, 1e-15);
  // On the wall the length at the particle and its growth are both halved: a quarter further away.
  const Point far = {0, 6};
  EXPECT_LT(twice.on_wall(far), 0.51 * some.on_wall(far));
}

// Twice as fast with 48 and more edges; not at all with up to 24, so that no mesh is coarser than
// one of 24 edges was.
TEST(EdgeLengths, GrowFasterInAFluidWithInertia) {
  const auto growth = [](int edges, double density) {
    const auto particles = particles_of({{0, 0, 1}}, 2);
    auto fluid = fluid_with(edges);
    fluid.density = density;
    const EdgeLengths lengths(fluid, BoxDomain{{-9, -40}, {9, 40}}, {&particles, {}, {}, {}});
    return (lengths.on_wall({9, 1}) - lengths.on_particle(0, {1, 0})) / (std::sqrt(82.0) - 1);
  };
  for (const int edges : {12, 24})
    EXPECT_DOUBLE_EQ(growth(edges, 1), growth(edges, 0)) << edges << " edges";
  EXPECT_NEAR(growth(36, 1), growth(24, 0), 1e-14);
  for (const int edges : {48, 96})
    EXPECT_NEAR(growth(edges, 1), 2 * growth(edges, 0), 1e-14) << edges << " edges";
}

TEST(EdgeLengths, OfACoarserMeshAreLonger) {
  const std::vector<Body> bodies = {{-1.05, 0, 1}, {1.05, 0, 1}};
  const auto fine = lengths_of(DiscDomain{{}, 6}, bodies, 24);
  const auto coarse = lengths_of(DiscDomain{{}, 6}, bodies, 24, 2);
  for (const Point x : {Point{-0.05, 0}, Point{-2.05, 0}, Point{-1.05, 1}})
    EXPECT_NEAR(coarse.on_particle(0, x), 2 * fine.on_particle(0, x), 1e-15);
}

TEST(EdgeLengths, ChangeLittleFromEdgeToEdge) {
  // Neighbouring edges differ by at most this factor, so that no triangle between them is thin.
  constexpr double kLargestRatio = 2;
  for (const double gap : {0.5, 0.1, 0.01, 1e-3}) {
    const auto lengths = lengths_of(DiscDomain{{}, 6}, {{-1 - gap / 2, 0, 1}, {1 + gap / 2, 0, 1}});
    const auto at = [&](double s) { return Point{-1 - gap / 2 + std::cos(s), std::sin(s)}; };
    const auto ends = cut_curve(2 * pi, 6, [&](double s) { return lengths.on_particle(0, at(s)); });
    for (std::size_t i = 0; i + 2 < ends.size(); ++i) {
      const double ratio = (ends[i + 2] - ends[i + 1]) / (ends[i + 1] - ends[i]);
      EXPECT_LT(ratio, kLargestRatio) << gap << " at " << ends[i];
      EXPECT_GT(ratio, 1 / kLargestRatio) << gap << " at " << ends[i];
    }
  }
}

TEST(EdgeLengths, OfAnEmptyDomainResolveIt) {
  const auto lengths = lengths_of(BoxDomain{{0, 0}, {2, 6}, {}}, {});
  EXPECT_GT(lengths.on_wall({0, 3}), 0);
  EXPECT_LE(lengths.on_wall({0, 3}), 2.0 / 6 * (1 + 1e-12));
}

TEST(CutCurve, EndsWhereItShould) {
  const auto ends = cut_curve(3, 1, [](double s) { return 0.1 + 0.05 * s; });
  EXPECT_EQ(ends.front(), 0);
  EXPECT_EQ(ends.back(), 3);
  EXPECT_TRUE(std::ranges::is_sorted(ends));
}

TEST(CutCurve, MakesEdgesOfTheLengthThatIsWanted) {
  // Constant: 1/0.3 edges become 4 equal ones.
  EXPECT_THAT(cut_curve(1, 1, [](double) { return 0.3; }),
              ::testing::Pointwise(::testing::DoubleNear(1e-12), {0.0, 0.25, 0.5, 0.75, 1.0}));
  // A whole number stays this number despite rounding.
  EXPECT_EQ(cut_curve(1, 1, [](double) { return 0.1; }).size(), 11U);
  // Varying: no edge is longer than wanted at its longer end, and together they are as many as the
  // integral of 1/length says, rounded up.
  const auto wanted = [](double s) { return 0.02 + 0.1 * s; };
  const auto ends = cut_curve(2, 1, wanted);
  EXPECT_EQ(ends.size() - 1, static_cast<std::size_t>(std::ceil(10 * std::log(0.22 / 0.02))));
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    EXPECT_LE(ends[i + 1] - ends[i], wanted(ends[i + 1]));
}

TEST(CutCurve, MakesAtLeastTheNumberOfEdges) {
  EXPECT_EQ(cut_curve(1, 6, [](double) { return 10.0; }).size(), 7U);
}

TEST(CutCurve, RefusesLengthsThatNeverEnd) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double length : {0.0, -1.0, nan, 1e-12})
    EXPECT_THROW(cut_curve(1, 1, [&](double) { return length; }), Error) << length;
}

}  // namespace
}  // namespace viscontact::freefem_flow
