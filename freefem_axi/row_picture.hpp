// One row of a tabulation with its flow and its meshes, to be drawn.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact {

/// Labels of boundary edges that a picture tells apart (axisymmetric_stokes.idp); every other one is a no-slip wall or neighbour.
namespace boundary_label {
inline constexpr int kSphere = 2;
inline constexpr int kAxis = 3;
inline constexpr int kShearFree = 5;
inline constexpr int kInterface = 8;  ///< inside the fluid, or where unbounded fluid is cut off
inline constexpr int kFarInterface = 9;
}  // namespace boundary_label

/// Triangles with quadratic sides in the half-plane of the axis: (rho, z) [L], the origin at the neighbour's nearest point.
struct CurvedMesh {
  /// Three vertices, then the middles of the sides opposite to them.
  using Triangle = std::array<std::size_t, 6>;
  struct Edge {
    int label = 0;
    std::array<std::size_t, 3> nodes{};  ///< both ends, then the middle
  };

  std::vector<std::array<double, 2>> nodes;
  std::vector<Triangle> triangles;
  std::vector<Edge> boundary;
};

/// The fields at the nodes of a mesh.
struct Flow {
  CurvedMesh mesh;
  std::vector<std::array<double, 2>> velocity;  ///< (u_rho, u_z) [L/T]
  std::vector<double>
      pressure;  ///< [M/(L T^2)]; mean 0 in a container, 0 far away in unbounded fluid
  std::vector<double>
      stream_function;  ///< psi [L^3/T]: u_rho = -(1/rho) dpsi/dz, u_z = (1/rho) dpsi/drho; 0 on the axis
};

struct RowPicture {
  ForceTableRow row;
  Flow flow;  ///< on the finest mesh
  CurvedMesh
      coarsest;  ///< the mesh that the finest one was made from, by cutting triangles into four
};

/// Solves one row again, for its picture. Throws Error(kExternalProgram) as solve_row does, or if what FreeFEM wrote is not whole.
RowPicture solve_row_for_picture(const FreeFem& freefem, const Tabulation& tabulation, double gap,
                                 double reference_velocity);

/// The text of a VTK file (.vtu) for ParaView: quadratic triangles at (rho, z, 0) with the point data velocity, pressure and
/// stream_function, in the case's units.
std::string write_vtu(const Flow& flow);

}  // namespace viscontact
