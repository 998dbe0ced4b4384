// The flow of a row and its mesh, for pictures, solved by FreeFEM: exact values on the sphere,
// units, and the text for VTK.
#include "viscontact/freefem_axi/row_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/common/vtk/vtk_xml.hpp"
#include "viscontact/freefem_axi/journal/freefem.hpp"

namespace viscontact::freefem_axi {
namespace {

Tabulation tabulation_of_radius(double radius) {
  Tabulation tabulation;
  tabulation.viscosity = 3;
  tabulation.radius = radius;
  tabulation.relative_accuracy = 1e-3;
  tabulation.container = Container{5 * radius, 10 * radius};
  return tabulation;
}

/// That the flow on the sphere, and its stream function there, are those of a sphere of radius 1
/// that moves with `velocity` at this gap.
void expect_translation(const RowPicture& picture, double gap, double velocity) {
  const auto& flow = picture.flow;
  int nodes = 0;
  for (const auto& edge : picture.boundary)
    for (const auto node : edge.nodes) {
      const double rho = flow.x[node], z = flow.y[node];
      const double psi = picture.stream_function[node];
      if (edge.kind == BoundaryKind::kAxis) {
        EXPECT_NEAR(psi, 0, 1e-20);
      }
      if (edge.kind != BoundaryKind::kSphere) continue;
      ++nodes;
      EXPECT_NEAR(std::hypot(rho, z - gap - 1), 1, 1e-12);
      // Imposed nowhere; the flow, so its flux, is exact to about the 1e-3 asked of the force,
      // near the axis rather less.
      EXPECT_NEAR(psi / velocity, rho * rho / 2, 5e-4 * rho * rho + 5e-5);
      // Imposed, but for the round-off of passing from one mesh to a part of it.
      EXPECT_NEAR(flow.velocity_x[node], 0, 1e-12);
      EXPECT_NEAR(flow.velocity_y[node], velocity, 1e-12);
    }
  EXPECT_GT(nodes, 100);
}

TEST(RowPicture, IsOfTheTranslationOfTheSphereInTheCasesUnits) {
  // Twice the lengths at equal velocity and viscosity: the same flow, half the pressure, four times
  // the stream function. The meshes are the same too, so only round-off remains; in the pressure
  // that of a linear system of condition 1e6 or so.
  const auto one = solve_row_for_picture(default_freefem(), tabulation_of_radius(1), 0.01, -1);
  const auto two = solve_row_for_picture(default_freefem(), tabulation_of_radius(2), 0.02, -1);
  expect_translation(one, 0.01, -1);
  ASSERT_EQ(one.flow.x.size(), two.flow.x.size());
  double largest = 0;
  for (const double pressure : one.flow.pressure) largest = std::max(largest, pressure);
  for (std::size_t i = 0; i < one.flow.x.size(); ++i) {
    EXPECT_NEAR(two.flow.x[i], 2 * one.flow.x[i], 1e-9);
    EXPECT_NEAR(two.flow.y[i], 2 * one.flow.y[i], 1e-9);
    EXPECT_NEAR(two.flow.velocity_y[i], one.flow.velocity_y[i], 1e-7);
    EXPECT_NEAR(two.flow.pressure[i], one.flow.pressure[i] / 2, 1e-7 * largest);
    EXPECT_NEAR(two.stream_function[i], 4 * one.stream_function[i], 1e-7);
  }
  // Reynolds' film: 3 mu |u0| r / q^2 under the sphere, up to terms of relative order q ln q =
  // 0.05.
  EXPECT_NEAR(largest / (3 * 3 * 1 / (0.01 * 0.01)), 1, 0.05);
  EXPECT_EQ(one.coarsest.triangles.size() * 16, one.flow.triangles.size());
}

TEST(RowPicture, VtkFileHasTheFlowOnTrianglesWhoseMiddlesFollowTheirSides) {
  const auto picture = solve_row_for_picture(default_freefem(), tabulation_of_radius(1), 1, -2);
  expect_translation(picture, 1, -2);
  const auto text = write_vtu(picture);
  const TemporaryFolder folder;
  const auto read = read_flow(folder.file("flow.vtu", text));
  EXPECT_EQ(read.velocity_x, picture.flow.velocity_x);
  EXPECT_EQ(read.pressure, picture.flow.pressure);
  EXPECT_EQ(VtkReader(text, "flow.vtu", "flow").array<double>("PointData", "stream_function"),
            picture.stream_function);
  ASSERT_EQ(read.triangles, picture.flow.triangles);
  // The middles are near the means of the ends. The triangles fill the container's half-plane less
  // half a disc; the sphere's sides are curved, and by the vertices alone the area errs by 1e-3 at
  // this mesh.
  double area = 0;
  for (const auto& nodes : read.triangles) {
    const auto at = [&](std::size_t i) {
      const auto node = static_cast<std::size_t>(nodes.at(i));
      return std::array<double, 2>{read.x[node], read.y[node]};
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const auto from = at(i), to = at((i + 1) % 3), middle = at(3 + i);
      EXPECT_LT(std::hypot((from[0] + to[0]) / 2 - middle[0], (from[1] + to[1]) / 2 - middle[1]),
                0.2 * std::hypot(from[0] - to[0], from[1] - to[1]));
    }
    const double twice = (at(1)[0] - at(0)[0]) * (at(2)[1] - at(0)[1]) -
                         (at(2)[0] - at(0)[0]) * (at(1)[1] - at(0)[1]);
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_NEAR(area, 5 * 10 - std::numbers::pi / 2, 5e-3);
}

}  // namespace
}  // namespace viscontact::freefem_axi
