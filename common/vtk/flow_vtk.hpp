// The flow of a fluid on a mesh of quadratic triangles in a plane, and its VTK file for ParaView.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace viscontact {

/// Triangles in a plane whose sides are parabolas, in the units of the case. For a flow that is
/// symmetric about an axis, the plane is a half-plane: x >= 0 is the distance from the axis.
struct QuadraticMesh {
  std::vector<double> x;  ///< [L]
  std::vector<double> y;  ///< [L], as many as x
  /// The nodes of each triangle, as indices of x from 0: three corners counter-clockwise, then the
  /// middles of the sides between corners 0 and 1, 1 and 2, 2 and 0, as VTK numbers them.
  std::vector<std::array<std::int32_t, 6>> triangles;
};

/// Each list has one number for each node.
struct FlowField : QuadraticMesh {
  std::vector<double> velocity_x;  ///< [L/T]
  std::vector<double> velocity_y;  ///< [L/T]
  std::vector<double> pressure;    ///< [M/(L T^2)]
};

/// The content of a VTK file of the type UnstructuredGrid: quadratic triangles with the arrays
/// "velocity", "pressure" and "speed" at their nodes. `more` is empty or has a value for each node,
/// in any unit; these values become the array `more_name`. x and y of a node are the coordinates x
/// and y of VTK. If `on_axis` is true, they are the coordinates x and z, so that z is the axis, and
/// the file says so by the field "axisymmetric".
std::string write_flow(const FlowField& flow, bool on_axis = false, std::string_view more_name = {},
                       const std::vector<double>& more = {});

/// Reads a file that write_flow() wrote on a machine with the same byte order; the numbers, which
/// may not be finite, have the same bits. Throws Error(kBadInput), which names the file, if it
/// cannot be read, is not such a file or was cut short, or if a triangle has a node that does not
/// exist.
FlowField read_flow(const std::filesystem::path& path);

}  // namespace viscontact
