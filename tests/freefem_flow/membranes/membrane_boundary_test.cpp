// The boundary of the mesh around membranes.
#include "viscontact/freefem_flow/membranes/membrane_boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
    const auto boundary = membrane_boundary(box, {circle(0.3, 0, angle)}, kEdges);
    return boundary.points.size() - (kEdges + 1);
  };
  const auto points = points_of_walls(0);
  // The gap to the floor is 0.1, and edges are half of it there.
  EXPECT_GT(points, 40U);
  for (int first = 1; first < kEdges; ++first) EXPECT_EQ(points_of_walls(first), points) << first;
}

TEST(MembraneBoundary, AMembraneIsShiftedToWhereNoPeriodEnds) {
  const particles::BoxDomain box{{-2, -3}, {6, 3}, {true, false}};
  const NodesOfMembranes nodes = {circle(5.5, 0, 0), circle(-6, 1, 0)};
  // They cover 4.5 to 6.5 and 1 to 3 of the period of 8: the wider gap is from 6.5 to 9.
  EXPECT_NEAR(shift_between_membranes(box, nodes), 7.75 + 2 - 8, 1e-12);
  EXPECT_EQ(shift_between_membranes(particles::DiscDomain{{}, 9}, nodes), 0);
}

}  // namespace
}  // namespace viscontact::freefem_flow
