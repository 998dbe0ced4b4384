// The flow of a row and its mesh, for pictures, solved by FreeFEM: exact values on the sphere,
// units, and the text for VTK.
#include "viscontact/freefem_axi/row_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/freefem.hpp"

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

TEST(RowPicture, StreamFunctionOnTheSphereIsThatOfItsTranslation) {
  for (const double gap : {0.01, 1.0}) {
    const auto picture = solve_row_for_picture(default_freefem(), tabulation_of_radius(1), gap, -2);
    const auto& mesh = picture.flow.mesh;
    int nodes = 0;
    for (const auto& edge : mesh.boundary)
      for (const auto node : edge.nodes) {
        const auto [rho, z] = mesh.nodes[node];
        const double psi = picture.flow.stream_function[node];
        if (edge.kind == BoundaryKind::kAxis) {
          EXPECT_NEAR(psi, 0, 1e-20);
        }
        if (edge.kind != BoundaryKind::kSphere) continue;
        ++nodes;
        EXPECT_NEAR(std::hypot(rho, z - gap - 1), 1, 1e-12);
        // Imposed nowhere; the flow, so its flux, is exact to about the 1e-3 asked of the force,
        // near the axis rather less.
        EXPECT_NEAR(psi, -2 * rho * rho / 2, 1e-3 * rho * rho + 1e-4);
        // Imposed, but for the round-off of passing from one mesh to a part of it.
        EXPECT_NEAR(picture.flow.velocity[node][0], 0, 1e-12);
        EXPECT_NEAR(picture.flow.velocity[node][1], -2, 1e-12);
      }
    EXPECT_GT(nodes, 100);
  }
}

TEST(RowPicture, PressureVelocityAndLengthsAreInTheCasesUnits) {
  // Twice the lengths at equal velocity and viscosity: the same flow, half the pressure, four times
  // the stream function. The meshes are the same too, so only round-off remains; in the pressure
  // that of a linear system of condition 1e6 or so.
  const auto one = solve_row_for_picture(default_freefem(), tabulation_of_radius(1), 0.01, -1);
  const auto two = solve_row_for_picture(default_freefem(), tabulation_of_radius(2), 0.02, -1);
  ASSERT_EQ(one.flow.mesh.nodes.size(), two.flow.mesh.nodes.size());
  double largest = 0;
  for (const double pressure : one.flow.pressure) largest = std::max(largest, pressure);
  for (std::size_t i = 0; i < one.flow.mesh.nodes.size(); ++i) {
    EXPECT_NEAR(two.flow.mesh.nodes[i][0], 2 * one.flow.mesh.nodes[i][0], 1e-9);
    EXPECT_NEAR(two.flow.mesh.nodes[i][1], 2 * one.flow.mesh.nodes[i][1], 1e-9);
    EXPECT_NEAR(two.flow.velocity[i][1], one.flow.velocity[i][1], 1e-7);
    EXPECT_NEAR(two.flow.pressure[i], one.flow.pressure[i] / 2, 1e-7 * largest);
    EXPECT_NEAR(two.flow.stream_function[i], 4 * one.flow.stream_function[i], 1e-7);
  }
  // Reynolds' film: 3 mu |u0| r / q^2 under the sphere, up to terms of relative order q ln q =
  // 0.05.
  EXPECT_NEAR(largest / (3 * 3 * 1 / (0.01 * 0.01)), 1, 0.05);
  EXPECT_EQ(one.coarsest.triangles.size() * 16, one.flow.mesh.triangles.size());
}

/// The numbers of a VTK data array whose start tag contains `attribute`.
std::vector<double> data_array(const std::string& vtu, const std::string& attribute) {
  const auto place = vtu.find(attribute);
  if (place == std::string::npos) throw std::invalid_argument("no " + attribute);
  const auto start = vtu.find('>', place + attribute.size()) + 1;
  std::istringstream text(vtu.substr(start, vtu.find('<', start) - start));
  std::vector<double> numbers;
  for (double number = 0; text >> number;) numbers.push_back(number);
  return numbers;
}

TEST(RowPicture, VtkTextHasPointsTrianglesAndFields) {
  const auto vtu =
      write_vtu(solve_row_for_picture(default_freefem(), tabulation_of_radius(1), 1, -1).flow);
  const auto count = [&](const std::string& name) {
    return std::stoul(vtu.substr(vtu.find(name + "=\"") + name.size() + 2));
  };
  const auto points = count("NumberOfPoints"), cells = count("NumberOfCells");
  EXPECT_EQ(data_array(vtu, "Name=\"velocity\"").size(), 3 * points);
  EXPECT_EQ(data_array(vtu, "Name=\"pressure\"").size(), points);
  EXPECT_EQ(data_array(vtu, "Name=\"stream_function\"").size(), points);
  EXPECT_EQ(data_array(vtu, "Name=\"offsets\"").size(), cells);
  EXPECT_EQ(data_array(vtu, "Name=\"types\""),
            std::vector<double>(cells, 22));  // quadratic triangle
  const auto place = data_array(vtu, "<Points>\n<DataArray");
  const auto nodes = data_array(vtu, "Name=\"connectivity\"");
  ASSERT_EQ(place.size(), 3 * points);
  ASSERT_EQ(nodes.size(), 6 * cells);
  // The middles follow their sides: they are near the means of the ends. The triangles fill the
  // container's half-plane less half a disc; the sphere's sides are curved, and by the vertices
  // alone the area errs by 1e-3 at this mesh.
  double area = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    const auto at = [&](std::size_t i, std::size_t axis) {
      return place[3 * static_cast<std::size_t>(nodes[6 * c + i]) + axis];
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const double length = std::hypot(at(i, 0) - at(j, 0), at(i, 1) - at(j, 1));
      EXPECT_LT(std::hypot((at(i, 0) + at(j, 0)) / 2 - at(3 + i, 0),
                           (at(i, 1) + at(j, 1)) / 2 - at(3 + i, 1)),
                0.2 * length);
    }
    const double twice = (at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) -
                         (at(2, 0) - at(0, 0)) * (at(1, 1) - at(0, 1));
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_NEAR(area, 5 * 10 - std::numbers::pi / 2, 5e-3);
}

}  // namespace
}  // namespace viscontact::freefem_axi
