// One row of a tabulation with its flow and its meshes, for pictures. Lengths, masses and times are
// in the units of the case. A change must agree with scripts/pictures.idp.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {

/// The kind of an edge of a boundary. A wall is a no-slip wall or the neighbour; an interface is
/// inside the fluid, or where unbounded fluid is cut off.
enum class BoundaryKind { kWall, kSphere, kAxis, kShearFree, kInterface };

/// Triangles with quadratic sides in the half-plane (rho, z) [L]. The origin is the point of the
/// neighbour that is nearest to the sphere.
struct CurvedMesh {
  /// Three vertices, then the mid-side nodes opposite to them.
  using Triangle = std::array<std::size_t, 6>;
  /// A curved edge of the boundary.
  struct Edge {
    BoundaryKind kind = BoundaryKind::kWall;  ///< what the edge bounds
    std::array<std::size_t, 3> nodes{};       ///< both ends, then the mid-side node
  };

  std::vector<std::array<double, 2>> nodes;  ///< (rho, z) [L]
  std::vector<Triangle> triangles;           ///< numbers of nodes, from 0
  std::vector<Edge> boundary;                ///< edges of the boundary, and interfaces
};

/// The flow at the nodes of a mesh.
struct Flow {
  CurvedMesh mesh;                              ///< of the whole fluid
  std::vector<std::array<double, 2>> velocity;  ///< (u_rho, u_z) [L/T]
  /// [M/(L T^2)]; its mean is 0 in a container, and it is 0 far away in unbounded fluid.
  std::vector<double> pressure;
  /// psi [L^3/T], with u_rho = -(1/rho) dpsi/dz and u_z = (1/rho) dpsi/drho; 0 on the axis. Only of
  /// the approach.
  std::vector<double> stream_function;
  /// u_phi [L/T] of the other motions. If the sphere slides or rolls, the flow is (u_rho cos phi,
  /// u_phi sin phi, u_z cos phi) and the pressure p cos phi; velocity and pressure are those at phi
  /// = 0.
  std::vector<double> azimuthal_velocity{};
};

/// A row with what a picture shows of it.
struct RowPicture {
  lubrication::MotionKind motion = lubrication::MotionKind::kApproach;  ///< of the sphere
  double gap = 0;                                                       ///< q [L]
  double reference_velocity = 0;  ///< u0 [L/T], or w0 [1/T] of a sphere that turns
  Flow flow;                      ///< on the finest mesh
  /// The mesh that the finest mesh was made from, by repeated division of triangles into four.
  CurvedMesh coarsest;
};

/// Solves one row again for its picture. Throws the errors of solve_row(), and
/// Error(kExternalProgram) if the mesh or the flow that FreeFEM wrote is incomplete.
RowPicture solve_row_for_picture(
    const FreeFem& freefem, const Tabulation& tabulation, double gap, double reference_velocity,
    lubrication::MotionKind motion = lubrication::MotionKind::kApproach);

/// The text of a VTK file (.vtu) for ParaView: quadratic triangles at (rho, z, 0) with the point
/// data velocity, pressure and stream_function or azimuthal_velocity in the units of the case.
std::string write_vtu(const Flow& flow);

}  // namespace viscontact::freefem_axi
