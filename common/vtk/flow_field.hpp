// The flow of a fluid on a mesh of quadratic triangles in a plane. freefem_axi/ and freefem_flow/
// make it, report/flow/ draws it and flow_vtk.hpp writes it. A change must keep the order of nodes,
// which is that of VTK. Lengths, masses and times are in the units of the case.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace viscontact {

/// Triangles in a plane whose sides are parabolas. Of a flow that is symmetric about an axis, the
/// plane is a half-plane: x >= 0 is the distance from the axis, and y the place along it.
struct QuadraticMesh {
  std::vector<double> x;  ///< of each node [L]
  std::vector<double> y;  ///< of each node [L]
  /// The nodes of each triangle: three corners counter-clockwise, then the middles of the sides
  /// between corners 0 and 1, 1 and 2, 2 and 0, as VTK numbers them.
  std::vector<std::array<std::int32_t, 6>> triangles;
};

/// Velocity and pressure at the nodes of a mesh.
struct FlowField : QuadraticMesh {
  std::vector<double> velocity_x;  ///< along x, of each node [L/T]
  std::vector<double> velocity_y;  ///< along y, of each node [L/T]
  std::vector<double> pressure;    ///< of each node [M/(L T^2)]
};

}  // namespace viscontact
