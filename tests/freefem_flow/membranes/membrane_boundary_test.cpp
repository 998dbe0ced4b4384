// The boundary of the mesh around membranes.
#include "viscontact/freefem_flow/membranes/membrane_boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "viscontact/common/error.hpp"

namespace viscontact::freefem_flow {
namespace {

constexpr int kEdges = 12;

/// The nodes of a circle of radius 1, whose first node has this angle.
Eigen::MatrixXd circle(double x, double y, double angle) {
  Eigen::MatrixXd nodes(2 * kEdges, 2);
  for (int i = 0; i < 2 * kEdges; ++i) {
    const double t = angle + std::numbers::pi * i / kEdges;
    nodes.row(i) << x + std::cos(t), y + std::sin(t);
  }
  return nodes;
}

// Walls near a membrane have short edges, wherever its first bead is.
TEST(MembraneBoundary, DoesNotDependOnTheFirstBead) {
  const particles::BoxDomain box{{-4, -1.1}, {4, 6}, {false, false}};
  const auto points_of_walls = [&](int first) {
    const double angle = 2 * std::numbers::pi * first / kEdges;
    const auto boundary = membrane_boundary(
        box, {.membranes = {circle(0.3, 0, angle)}, .discs = {}, .edges = kEdges});
    return boundary.points.size() - (kEdges + 1);
  };
  const auto points = points_of_walls(0);
  // The gap to the floor is 0.1, and edges are half of it there.
  EXPECT_GT(points, 40U);
  for (int first = 1; first < kEdges; ++first) EXPECT_EQ(points_of_walls(first), points) << first;
}

TEST(MembraneBoundary, AMembraneIsShiftedToWhereNoPeriodEnds) {
  const particles::BoxDomain box{{-2, -3}, {6, 3}, {true, false}};
  InnerCurves curves{.membranes = {circle(5.5, 0, 0), circle(-6, 1, 0)}};
  // They cover 4.5 to 6.5 and 1 to 3 of the period of 8: the wider gap is from 6.5 to 9.
  EXPECT_NEAR(shift_between_membranes(box, curves), 7.75 + 2 - 8, 1e-12);
  EXPECT_EQ(shift_between_membranes(particles::DiscDomain{{}, 9}, curves), 0);
  // A disc at 0 covers 7.5 to 8.5: the widest gap is then from 3 to 4.5.
  curves.discs.push_back({particles::Shape::disc(0.5), {0, 2}});
  EXPECT_NEAR(shift_between_membranes(box, curves), 3.75 + 2, 1e-12);
}

TEST(MembraneBoundary, DiscsAreHolesWithShortEdgesInNarrowGaps) {
  const particles::BoxDomain box{{-6, -6}, {6, 6}, {false, false}};
  const auto edges_of = [&](double x) {
    const auto boundary = membrane_boundary(box, {.membranes = {circle(0, 0, 0)},
                                                  .discs = {{particles::Shape::disc(0.5), {x, 0}}},
                                                  .edges = kEdges,
                                                  .edges_of_disc = 12});
    const auto& disc = boundary.curves[boundary.curves.size() - 2];
    EXPECT_EQ(disc.label, kFirstParticleLabel);
    EXPECT_EQ(boundary.curves.back().label, kFirstMembraneLabel);
    // Clockwise, because the fluid is on the left.
    double area = 0;
    for (int i = disc.first; i < disc.first + disc.edges; ++i) {
      const auto &a = boundary.points[static_cast<std::size_t>(i)],
                 &b = boundary.points[static_cast<std::size_t>(i) + 1];
      area += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    EXPECT_NEAR(area, -std::numbers::pi / 4, 0.05);
    return disc.edges;
  };
  EXPECT_EQ(edges_of(4), 12);
  EXPECT_GT(edges_of(1.55), 16);
}

TEST(MembraneBoundary, CurvesThatMeetAreErrors) {
  const particles::BoxDomain box{{-6, -6}, {6, 6}, {false, false}};
  const auto check = [&](double x) {
    check_places(box,
                 {.membranes = {circle(0, 0, 0)}, .discs = {{particles::Shape::disc(0.5), {x, 0}}}},
                 {});
  };
  EXPECT_NO_THROW(check(0));
  EXPECT_NO_THROW(check(1.6));
  EXPECT_THROW(check(0.7), Error);
  EXPECT_THROW(check(5.7), Error);
}

}  // namespace
}  // namespace viscontact::freefem_flow
