// The boundary of a mesh, as the fluid solver gets it (docs/fluid-solver.md). Lengths are in the
// unit of the case. flow_process.hpp sends it. A change of labels must be made in
// freefem_flow/scripts, too. Gaps too narrow for a mesh are an Error(kNotConverged).
#pragma once

#include <array>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::freefem_flow {

/// Label of the axis of a cylinder. Walls have the labels of the protocol: a box 1 left, 2 right,
/// 3 bottom, 4 top; a disc 1; a cylinder 1 side, 2 floor, 3 lid.
inline constexpr int kAxisLabel = 5;
/// Label of a curve inside a particle, which bounds nothing.
inline constexpr int kInsideLabel = 8;
/// Label of the sides that are periodic images of each other.
inline constexpr int kPeriodicLabel = 9;
/// Label of the surface of particle 0; that of particle k is larger by k.
inline constexpr int kFirstParticleLabel = 100;

/// Curves, each a chain of straight edges. The fluid is on the left of each outer curve.
struct MeshBoundary {
  /// A chain of edges between points that follow each other.
  struct Curve {
    int first = 0;  ///< the curve goes through the points first, first + 1, ..., first + edges
    int edges = 0;  ///< number of edges, > 0
    int label = 0;  ///< one of the labels above
  };
  std::vector<std::array<double, 2>> points;  ///< (x, y), or (distance from the axis, z) [L]
  std::vector<Curve> curves;                  ///< they may share points

  /// Adds the curve through these points, at least two, and the points.
  void add(const std::vector<std::array<double, 2>>& more, int label) {
    curves.push_back({static_cast<int>(points.size()), static_cast<int>(more.size()) - 1, label});
    points.insert(points.end(), more.begin(), more.end());
  }
};

/// The boundary of a mesh for these particles, whose gaps must be greater than 0, except that discs
/// of one body may overlap if the rigid motions are unknowns. With a fitted mesh, edges get shorter
/// where a gap is narrow (boundary/edge_lengths.hpp), and the particles' surfaces are curves: holes
/// of the mesh if the rigid motions are unknowns, else lines inside it. Where the domain is
/// periodic, a fitted mesh does not end at straight sides, which would cut particles, but halfway
/// between neighbours (boundary/periodic_cells.hpp). The edges are about `coarsening` > 0 times as
/// long as the fluid says.
MeshBoundary mesh_boundary(const particles::Fluid& fluid, const particles::Domain& domain,
                           const particles::FluidParticles& bodies, double coarsening = 1);

}  // namespace viscontact::freefem_flow
