// The region of a fitted periodic mesh: its area is that of the period, its edges come in pairs
// that are exact translates, and no edge cuts a disc. Lengths are in one unit.
#include "viscontact/freefem_flow/boundary/periodic_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;

double distance_of_segment(const Point& centre, const CellEdge& edge) {
  const double dx = edge.to[0] - edge.from[0], dy = edge.to[1] - edge.from[1];
  const double cx = centre[0] - edge.from[0], cy = centre[1] - edge.from[1];
  const double s = std::clamp((cx * dx + cy * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(cx - s * dx, cy - s * dy);
}

/// Area on the left of the edges.
double area_of(const std::vector<CellEdge>& edges) {
  double area = 0;
  for (const auto& e : edges) area += (e.from[0] * e.to[1] - e.to[0] * e.from[1]) / 2;
  return area;
}

struct Disc {
  particles::Vector2 centre;
  double radius;
};

// Corners are joined within a tenth of their distance from the discs, which moves the area.
void check(const BoxDomain& box, const std::vector<Disc>& discs) {
  std::vector<particles::PlacedShape> circles;
  for (const auto& disc : discs)
    circles.push_back({particles::Shape::disc(disc.radius), disc.centre});
  const auto edges = periodic_cells(box, circles);
  const std::array<double, 2> period = {box.to[0] - box.from[0], box.to[1] - box.from[1]};
  ASSERT_FALSE(edges.empty());
  // Joined corners are joined on both sides, so that nothing is lost.
  EXPECT_NEAR(area_of(edges), period[0] * period[1], 1e-10 * period[0] * period[1]);
  std::array<double, 2> sum{};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto& edge = edges[e];
    for (std::size_t d = 0; d < 2; ++d) sum[d] += edge.to[d] - edge.from[d];
    if (edge.label == kPeriodicLabel) {
      ASSERT_GE(edge.partner, 0);
      const auto& partner = edges[static_cast<std::size_t>(edge.partner)];
      EXPECT_EQ(partner.partner, static_cast<int>(e));
      for (std::size_t d = 0; d < 2; ++d) {
        const double shift = edge.from[d] - partner.to[d];
        EXPECT_NEAR(edge.to[d] - partner.from[d], shift, 1e-12 * period[d]);
        const double periods = shift / period[d];
        EXPECT_NEAR(periods, std::round(periods), 1e-12);
        if (!box.periodic[d]) {
          EXPECT_EQ(std::round(periods), 0);
        }
      }
    } else {
      EXPECT_EQ(edge.partner, -1);
      // Labels 1, 2 are sides at x, and 3, 4 sides at y.
      const std::size_t d = edge.label <= 2 ? 0 : 1;
      EXPECT_FALSE(box.periodic[d]);
      const double at = edge.label % 2 == 1 ? box.from[d] : box.to[d];
      EXPECT_NEAR(edge.from[d], at, 1e-12 * period[d]);
      EXPECT_NEAR(edge.to[d], at, 1e-12 * period[d]);
    }
    for (const auto& circle : circles)
      for (int i = box.periodic[0] ? -2 : 0; i <= (box.periodic[0] ? 2 : 0); ++i)
        for (int j = box.periodic[1] ? -2 : 0; j <= (box.periodic[1] ? 2 : 0); ++j) {
          const Point centre = {circle.centre[0] + i * period[0], circle.centre[1] + j * period[1]};
          EXPECT_GT(distance_of_segment(centre, edge), circle.shape.bounding_radius())
              << "edge " << e << " cuts the disc at " << centre[0] << ", " << centre[1];
        }
  }
  EXPECT_NEAR(std::hypot(sum[0], sum[1]), 0, 1e-10);  // closed
}

constexpr BoxDomain kUnit = {{0, 0}, {1, 1}, {true, true}};

TEST(PeriodicCells, OfOneDiscAreItsSquare) {
  check(kUnit, {{{0.5, 0.5}, 0.3}});
  const auto edges = periodic_cells(
      kUnit, std::vector<particles::PlacedShape>{{particles::Shape::disc(0.3), {0.5, 0.5}}});
  EXPECT_EQ(edges.size(), 4U);
  for (const auto& edge : edges)
    EXPECT_NEAR(std::hypot(edge.to[0] - edge.from[0], edge.to[1] - edge.from[1]), 1, 1e-12);
  // Wherever the disc is, also on the border of the box.
  check(kUnit, {{{0.3, 0.9}, 0.3}});
  check(kUnit, {{{0, 0}, 0.499}});
}

TEST(PeriodicCells, OfDegenerateLatticesClose) {
  // Square lattice: four cells meet in each corner.
  check(kUnit,
        {{{0.25, 0.25}, 0.2}, {{0.75, 0.25}, 0.2}, {{0.25, 0.75}, 0.2}, {{0.75, 0.75}, 0.2}});
  // Hexagonal lattice in its rectangle.
  const double root = std::numbers::sqrt3;
  check({{0, 0}, {1, root}, {true, true}}, {{{0.1, 0.2}, 0.45}, {{0.6, 0.2 + root / 2}, 0.45}});
  // Rhombic: two discs in a square.
  check(kUnit, {{{0.2, 0.2}, 0.3}, {{0.7, 0.7}, 0.3}});
}

TEST(PeriodicCells, KeepDiscsOfDifferentSizesWhole) {
  // Halfway between the centres is inside the large disc.
  check(kUnit, {{{0.4, 0.5}, 0.38}, {{0.9, 0.5}, 0.1}});
  check(kUnit, {{{0.5, 0.5}, 0.45}, {{0, 0}, 0.2}});
}

TEST(PeriodicCells, OfAChannelHaveItsWalls) {
  for (const bool along_x : {true, false}) {
    const BoxDomain channel = {{-1, 0}, {1, 2}, {along_x, !along_x}};
    check(channel, {{{0.1, 1}, 0.4}});
    check(channel, {{{-0.4, 0.5}, 0.4}, {{0.4, 1.4}, 0.5}});
  }
  check({{-1, 0}, {1, 2}, {true, false}}, {{{0.9, 1}, 0.4}});
}

TEST(PeriodicCells, OfRandomDiscsTileThePeriod) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform;
  for (int draw = 0; draw < 300; ++draw) {
    const BoxDomain box = {{-1, 2},
                           {-1 + 1 + 3 * uniform(random), 2 + 1 + 3 * uniform(random)},
                           {uniform(random) < 0.7, true}};
    const std::array<double, 2> period = {box.to[0] - box.from[0], box.to[1] - box.from[1]};
    std::vector<Disc> circles;
    const int tries = 1 + static_cast<int>(30 * uniform(random));
    for (int i = 0; i < tries; ++i) {
      const double x = box.from[0] + period[0] * uniform(random),
                   y = box.from[1] + period[1] * uniform(random),
                   radius = 0.05 + 0.25 * uniform(random);
      const Disc drawn{{x, y}, radius};
      constexpr double kLeastGap = 1e-3;
      bool fits = box.periodic[0] ||
                  (x - radius > box.from[0] + kLeastGap && x + radius < box.to[0] - kLeastGap);
      for (const auto& other : circles) {
        double dx = drawn.centre[0] - other.centre[0], dy = drawn.centre[1] - other.centre[1];
        if (box.periodic[0]) dx -= period[0] * std::round(dx / period[0]);
        dy -= period[1] * std::round(dy / period[1]);
        fits = fits && std::hypot(dx, dy) > radius + other.radius + kLeastGap;
      }
      if (fits) circles.push_back(drawn);
    }
    if (circles.empty()) continue;
    SCOPED_TRACE(::testing::Message() << "draw " << draw << ", " << circles.size() << " discs");
    check(box, circles);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
}  // namespace viscontact::freefem_flow
