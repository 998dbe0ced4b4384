// The boundary of a mesh as the fluid solver gets it: closed loops with the fluid on their left,
// and labels. Lengths are in one unit.
#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/freefem_flow/placed_flow.hpp"
#include "viscontact/particles/setting/chords.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::CylinderDomain;
using particles::DiscDomain;
using particles::FluidMesh;
using particles::RigidConstraint;
using std::numbers::pi;
using Point = std::array<double, 2>;

MeshBoundary boundary_of(const particles::Fluid& fluid, const particles::Domain& domain,
                         const std::vector<Body>& bodies, double coarsening = 1) {
  const bool on_axis = std::holds_alternative<CylinderDomain>(domain);
  const auto particles = particles_of(bodies, on_axis ? 1 : 2);
  return mesh_boundary(fluid, domain, {&particles, {}, {}, {}}, coarsening);
}

std::vector<Point> points_of(const MeshBoundary& boundary, const MeshBoundary::Curve& curve) {
  const auto first = boundary.points.begin() + curve.first;
  return {first, first + curve.edges + 1};
}

/// Area on the left of the curves with these labels, which are closed together.
double area_of(const MeshBoundary& boundary, const std::set<int>& labels) {
  double area = 0;
  for (const auto& curve : boundary.curves) {
    if (!labels.contains(curve.label)) continue;
    const auto points = points_of(boundary, curve);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      area += (points[i][0] * points[i + 1][1] - points[i + 1][0] * points[i][1]) / 2;
  }
  return area;
}

std::multiset<int> labels_of(const MeshBoundary& boundary) {
  std::multiset<int> labels;
  for (const auto& curve : boundary.curves) labels.insert(curve.label);
  return labels;
}

/// Expects that as many curves begin at each point as end there, at the same coordinates to the
/// bit.
void expect_closed(const MeshBoundary& boundary) {
  std::map<Point, int> ends;
  for (const auto& curve : boundary.curves) {
    ASSERT_GT(curve.edges, 0);
    ASSERT_LT(static_cast<std::size_t>(curve.first + curve.edges), boundary.points.size());
    const auto points = points_of(boundary, curve);
    ++ends[points.front()];
    --ends[points.back()];
  }
  for (const auto& [point, count] : ends)
    EXPECT_EQ(count, 0) << "at " << point[0] << ", " << point[1];
}

/// The area of the polygon that n points on a circle make is smaller than the circle by about
/// 2/3 (pi/n)^2; here n >= 20.
constexpr double kOfPolygon = 0.02;

TEST(MeshBoundary, OfARoundDomainIsItsWallAndItsDiscs) {
  const std::vector<Body> bodies = {{-1.1, 0, 1}, {1.5, 0.5, 1.2}};
  for (const auto constraint : {RigidConstraint::kPenalty, RigidConstraint::kRigid}) {
    const auto boundary = boundary_of(fluid_with(24, constraint), DiscDomain{{1, 0}, 6}, bodies);
    expect_closed(boundary);
    EXPECT_NEAR(area_of(boundary, {1}), 36 * pi, kOfPolygon * 36 * pi);
    // A hole has the fluid on its left: it goes round clockwise.
    const double sign = constraint == RigidConstraint::kRigid ? -1 : 1;
    EXPECT_NEAR(area_of(boundary, {100}), sign * pi, kOfPolygon * pi);
    EXPECT_NEAR(area_of(boundary, {101}), sign * 1.44 * pi, kOfPolygon * 1.44 * pi);
    EXPECT_EQ(labels_of(boundary).count(100), 1U);
    EXPECT_EQ(labels_of(boundary).count(101), 1U);
    for (const auto& curve : boundary.curves)
      for (const auto& x : points_of(boundary, curve)) {
        if (curve.label == 1) {
          EXPECT_NEAR(std::hypot(x[0] - 1, x[1]), 6, 1e-12);
        }
        if (curve.label == 100) {
          EXPECT_NEAR(std::hypot(x[0] + 1.1, x[1]), 1, 1e-12);
        }
      }
  }
}

TEST(MeshBoundary, OfABoxHasItsSidesInTheOrderOfTheirLabels) {
  const auto boundary = boundary_of(fluid_with(12), BoxDomain{{-1, 0}, {3, 2}, {}}, {{0, 1, 0.3}});
  expect_closed(boundary);
  EXPECT_DOUBLE_EQ(area_of(boundary, {1, 2, 3, 4}), 8);
  for (const auto& curve : boundary.curves)
    for (const auto& x : points_of(boundary, curve)) {
      if (curve.label == 1) {
        EXPECT_EQ(x[0], -1);
      }
      if (curve.label == 2) {
        EXPECT_EQ(x[0], 3);
      }
      if (curve.label == 3) {
        EXPECT_EQ(x[1], 0);
      }
      if (curve.label == 4) {
        EXPECT_EQ(x[1], 2);
      }
    }
}

TEST(MeshBoundary, OfAPeriodicDomainHasEqualPointsOnBothSides) {
  for (const auto mesh : {FluidMesh::kFitted, FluidMesh::kFixed}) {
    auto fluid = fluid_with(12);
    fluid.mesh = mesh;
    const auto boundary = boundary_of(fluid, BoxDomain{{0, 0}, {3, 2}, {true, true}},
                                      {{0.1, 1, 0.3}, {1, 1, 0.3}, {2, 0.2, 0.5}});
    expect_closed(boundary);
    EXPECT_NEAR(area_of(boundary, {kPeriodicLabel}), 6, 1e-12);
    // Each point on a periodic side is there twice, except at corners of cells, which may be there
    // more often.
    std::map<std::pair<long, long>, int> places;
    for (const auto& curve : boundary.curves) {
      if (curve.label != kPeriodicLabel) continue;
      const auto points = points_of(boundary, curve);
      for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const auto fraction = [](double x, double period) {
          return std::lround(1e9 * (x / period - std::floor(x / period + 1e-10)));
        };
        ++places[{fraction(points[i][0], 3), fraction(points[i][1], 2)}];
      }
    }
    ASSERT_FALSE(places.empty());
    for (const auto& [place, count] : places) EXPECT_EQ(count, 2);
  }
}

TEST(MeshBoundary, OfACylinderBeginsAndEndsOnTheAxis) {
  const std::vector<Body> bodies = {{0, 2, 1}, {0, 6, 0.5}};
  const CylinderDomain cylinder = {5, 10};
  for (const auto constraint : {RigidConstraint::kPenalty, RigidConstraint::kRigid}) {
    const auto boundary = boundary_of(fluid_with(24, constraint), cylinder, bodies);
    if (constraint == RigidConstraint::kRigid) {
      expect_closed(boundary);
      const double half_discs = (1 + 0.25) * pi / 2;
      EXPECT_NEAR(area_of(boundary, {1, 2, 3, kAxisLabel, 100, 101}), 50 - half_discs,
                  kOfPolygon * half_discs);
    } else {
      EXPECT_NEAR(area_of(boundary, {1, 2, 3, kAxisLabel}), 50, 1e-12);
    }
    for (const auto& curve : boundary.curves) {
      const auto points = points_of(boundary, curve);
      for (const auto& x : points) {
        EXPECT_GE(x[0], 0);
        if (curve.label == kAxisLabel) {
          EXPECT_EQ(x[0], 0);
        }
        if (curve.label == 1) {
          EXPECT_EQ(x[0], 5);
        }
        if (curve.label == 2) {
          EXPECT_EQ(x[1], 0);
        }
        if (curve.label == 3) {
          EXPECT_EQ(x[1], 10);
        }
      }
      if (curve.label == 100) {
        EXPECT_EQ(points.front(), (Point{0, 3}));
        EXPECT_EQ(points.back(), (Point{0, 1}));
      }
      if (curve.label == 101) {
        EXPECT_EQ(points.front(), (Point{0, 6.5}));
      }
    }
  }
}

TEST(MeshBoundary, OfDiscsOfABodyThatOverlapIsThatOfTheirUnion) {
  auto particles = particles_of({{0, 0, 1}, {1.5, 0.3, 0.8}, {-1.2, 0.9, 0.7}, {3.5, 0, 1}}, 2);
  particles.masses.assign(4, 0);
  particles.velocities.assign(8, 0);
  particles.angles.assign(4, 0);
  particles.angular_velocities.assign(4, 0);
  particles.inertias.assign(4, 0);
  add_rigid_body(particles, {{0, 1, 2}});
  auto fluid = fluid_with(24, RigidConstraint::kRigid);
  fluid.cut_areas = cut_areas_of(fluid, particles);
  const auto boundary = mesh_boundary(fluid, DiscDomain{{}, 6}, {&particles, {}, {}, {}}, 1);
  expect_closed(boundary);
  EXPECT_EQ(labels_of(boundary), (std::multiset<int>{1, 100, 100, 101, 102, 103}));
  double area = 0;
  for (std::size_t k = 0; k < 4; ++k) area += fluid.size_of(particles.shape(k), k);
  EXPECT_NEAR(area_of(boundary, {100, 101, 102, 103}), -area, kOfPolygon * area);
  // No edge is shorter than half of the wanted length, but for chord over arc: where circles meet
  // there is no narrow gap.
  for (const auto& curve : boundary.curves) {
    if (curve.label <= 100 || curve.label >= 103) continue;
    const auto points = points_of(boundary, curve);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      EXPECT_GT(std::hypot(points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1]),
                0.49 * 2 * pi * 0.7 / 24);
  }
}

TEST(MeshBoundary, ThatIsFixedDoesNotKnowTheParticles) {
  auto fluid = fluid_with(12);
  fluid.mesh = FluidMesh::kFixed;
  const auto one = boundary_of(fluid, DiscDomain{{}, 5}, {{1, 0, 1}, {-2, 0, 1}});
  const auto other = boundary_of(fluid, DiscDomain{{}, 5}, {{0, 1, 1}, {0, 3.9, 1}});
  EXPECT_EQ(labels_of(one), (std::multiset<int>{1}));
  EXPECT_EQ(one.points, other.points);
}

TEST(MeshBoundary, ThatIsCoarserHasFewerPoints) {
  const std::vector<Body> bodies = {{-1.1, 0, 1}, {1.1, 0, 1}};
  const auto fine = boundary_of(fluid_with(24), DiscDomain{{}, 6}, bodies);
  const auto coarse = boundary_of(fluid_with(24), DiscDomain{{}, 6}, bodies, 2);
  EXPECT_LT(static_cast<double>(coarse.points.size()),
            0.7 * static_cast<double>(fine.points.size()));
}

TEST(MeshBoundary, OfANarrowGapHasFewPoints) {
  // The edges grow with the distance from the gap, so that their number grows as 1/sqrt(gap).
  const double gap = 1e-3;
  const std::vector<Body> bodies = {{-1 - gap / 2, 0, 1}, {1 + gap / 2, 0, 1}};
  EXPECT_LT(boundary_of(fluid_with(24), DiscDomain{{}, 6}, bodies).points.size(), 1500U);
}

TEST(MeshBoundary, OfParticlesThatTouchIsRefused) {
  for (const double gap : {0.0, -0.1})
    EXPECT_THAT(failure(ErrorKind::kNotConverged,
                        [&] {
                          boundary_of(fluid_with(24), DiscDomain{{}, 6},
                                      {{-1 - gap / 2, 0, 1}, {1 + gap / 2, 0, 1}});
                        }),
                Names("fluid.threshold_gap", "time_step"));
}

TEST(MeshBoundary, OfManyDiscsIsMadeFast) {
  // A step with 1024 discs may take 13 s, a twentieth of it for its boundary. Here it is 0.2 s.
  std::vector<Body> bodies;
  for (int i = 0; i < 32; ++i)
    for (int j = 0; j < 32; ++j)
      bodies.push_back({2.5 * i + 0.2 * std::sin(7 * i + 3 * j) + 1.2,
                        2.5 * j + 0.2 * std::sin(5 * i - 11 * j) + 1.2, 1});
  const auto start = std::clock();
  boundary_of(fluid_with(12), BoxDomain{{0, 0}, {80, 80}, {true, true}}, bodies);
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 5);
}

}  // namespace
}  // namespace viscontact::freefem_flow
