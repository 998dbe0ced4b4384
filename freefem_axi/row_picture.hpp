// The flow around a sphere at one gap and one velocity, with its meshes, for pictures. rho is the
// distance from the axis of symmetry, z the height, phi the angle about the axis.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "viscontact/common/vtk/flow_vtk.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {

/// The kind of an edge of a boundary. kWall is a wall of the container without slip, or the body
/// beside the sphere (the neighbour, such as a plane); kShearFree is a surface without shear
/// stress; kInterface is a line inside the fluid, or the line where unbounded fluid is cut off.
enum class BoundaryKind { kWall, kSphere, kAxis, kShearFree, kInterface };

/// A curved edge of a boundary.
struct BoundaryEdge {
  BoundaryKind kind = BoundaryKind::kWall;  ///< what is on the other side of the edge
  /// The nodes at both ends of the edge and then the one in its middle, as numbers from 0.
  std::array<std::size_t, 3> nodes{};
};

/// The flow of one row of a table, in the units of the case.
struct RowPicture {
  lubrication::MotionKind motion = lubrication::MotionKind::kApproach;  ///< of the sphere
  double gap = 0;                                                       ///< [L], > 0
  double reference_velocity = 0;  ///< [L/T], or [1/T] of a sphere that turns; not 0
  /// The flow on the finest mesh in the half-plane (rho, z), whose origin is the point of the
  /// neighbour that is nearest to the sphere: places [L], velocity [L/T] and pressure [M/(L T^2)]
  /// at the nodes. The pressure has the mean 0 in a container, and is 0 far away in unbounded
  /// fluid. If the sphere slides or rolls, the velocity is (u_rho cos phi, u_phi sin phi, u_z cos
  /// phi) and the pressure p cos phi; `flow` has u_rho, u_z and p.
  FlowField flow;
  std::vector<BoundaryEdge> boundary;  ///< of the fluid; also lines inside it (kInterface)
  /// For the approach: the stream function psi [L^3/T], one number for each node, with u_rho =
  /// -(1/rho) dpsi/dz and u_z = (1/rho) dpsi/drho; psi is 0 on the axis. Empty for other motions.
  std::vector<double> stream_function;
  /// For the other motions: u_phi [L/T], one number for each node. Empty for the approach.
  std::vector<double> azimuthal_velocity;
  /// The mesh [L] from which the finest mesh was made, by repeated division of triangles into four.
  QuadraticMesh coarsest;
};

/// Solves the flow at the gap `gap` [L] > 0 and the velocity `reference_velocity` [L/T], or angular
/// velocity [1/T] for kRoll and kSpin, not 0. Throws Error(kExternalProgram) if FreeFEM fails, also
/// because its scripts refuse a number, or writes an incomplete mesh, Error(kBadInput) for an
/// unknown geometry or a force that a double cannot hold, std::out_of_range if geometry_parameters
/// are missing, and Error(kInterrupted) at a stop.
RowPicture solve_row_for_picture(
    const FreeFem& freefem, const Tabulation& tabulation, double gap, double reference_velocity,
    lubrication::MotionKind motion = lubrication::MotionKind::kApproach);

/// The text of a VTK file (.vtu) for ParaView: the flow, and stream_function or azimuthal_velocity.
std::string write_vtu(const RowPicture& picture);

}  // namespace viscontact::freefem_axi
