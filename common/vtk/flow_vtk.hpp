// The flow of a fluid on a mesh of quadratic triangles in a plane, and its VTK file for ParaView.
// freefem_axi/ and freefem_flow/ make flows, report/flow/ draws them, freefem_axi/ and particles/
// write the files, and particles/picture/ reads them. Lengths, masses and times are in the units of
// the case. A file that cannot be read, or whose triangles have nodes that do not exist, throws
// Error(kBadInput). Lengths of lists that are written, and whether numbers are finite, are not
// checked. Further arrays may be added. A change must keep the order of nodes, which is that of
// VTK, and the names of the arrays in the file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace viscontact {

/// Triangles in a plane whose sides are parabolas. For a flow that is symmetric about an axis, the
/// plane is a half-plane: x >= 0 is the distance from the axis, and y the place along it.
struct QuadraticMesh {
  std::vector<double> x;  ///< of each node [L]
  std::vector<double> y;  ///< of each node [L], as many as x
  /// The nodes of each triangle, as indices of x from 0: three corners counter-clockwise, then the
  /// middles of the sides between corners 0 and 1, 1 and 2, 2 and 0, as VTK numbers them.
  std::vector<std::array<std::int32_t, 6>> triangles;
};

/// Velocity and pressure at the nodes of a mesh: each list has one number for each node.
struct FlowField : QuadraticMesh {
  std::vector<double> velocity_x;  ///< along x, of each node [L/T]
  std::vector<double> velocity_y;  ///< along y, of each node [L/T]
  std::vector<double> pressure;    ///< of each node [M/(L T^2)]
};

/// The content of a VTK file of the type UnstructuredGrid (VTK's file formats, "XML file formats";
/// inline binary): quadratic triangles (VTK's cell type 22) with velocity [L/T], pressure [M/(L
/// T^2)] and speed [L/T] at their nodes. `more` is empty or has a value for each node, in any unit;
/// these values become the array `more_name`. In the file, x and y of a node are the coordinates x
/// and y of VTK, and z = 0. If `on_axis` is true, they are the coordinates x >= 0 and z of VTK, and
/// y = 0, so that z is the axis. Lengths of lists are not checked; nothing is thrown.
std::string write_flow(const FlowField& flow, bool on_axis = false, std::string_view more_name = {},
                       const std::vector<double>& more = {});

/// Reads mesh, velocity and pressure from a file that write_flow wrote on a machine with the same
/// byte order. The numbers have the same bits. Throws Error(kBadInput), which names the file, if it
/// cannot be read, is not such a file or was cut short; whether numbers are finite is not checked.
FlowField read_flow(const std::filesystem::path& path);

}  // namespace viscontact
