// The boundary of the mesh of a fluid with particles, as the fluid solver gets it. scripts/ and
// docs/fluid-solver.md repeat its labels.
#pragma once

#include <array>
#include <cassert>
#include <vector>

#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/fluid.hpp"

namespace viscontact::freefem_flow {

/// Label of the axis of a cylinder. Walls have the labels: a box 1 left, 2 right, 3 bottom, 4 top;
/// a disc 1; a cylinder 1 side, 2 floor, 3 lid.
inline constexpr int kAxisLabel = 5;
/// Label of a line inside a particle, which does not bound the fluid.
inline constexpr int kInsideLabel = 8;
/// Label of the sides that are periodic images of each other.
inline constexpr int kPeriodicLabel = 9;
/// Label of the surface of particle 0; that of particle k is larger by k.
inline constexpr int kFirstParticleLabel = 100;

/// Curves, each a chain of straight edges. The fluid is on the left of each outer curve, and of
/// holes.
struct MeshBoundary {
  struct Curve {
    int first = 0;  ///< the curve goes through the points first, first + 1, ..., first + edges
    int edges = 0;
    int label = 0;  ///< one of those above, or of a membrane (membranes/membrane_boundary.hpp)
  };
  std::vector<std::array<double, 2>> points;  ///< (x, y), or (distance from the axis, z) [L]
  std::vector<Curve> curves;                  ///< curves may share points

  /// Adds the curve through the points `more` [L], and these points.
  void add(const std::vector<std::array<double, 2>>& more, int label) {
    assert(more.size() >= 2);
    curves.push_back({static_cast<int>(points.size()), static_cast<int>(more.size()) - 1, label});
    points.insert(points.end(), more.begin(), more.end());
  }
};

/// The boundary of a mesh for these particles, which are inside the domain. The edges are about
/// `coarsening` times as long as `fluid.edges_per_particle` says, and shorter where a gap is narrow
/// (boundary/edge_lengths.hpp). If `fluid.mesh` is kFixed, the particles are not in the boundary.
/// If it is kFitted, their surfaces are curves of the boundary: holes of the mesh if
/// `fluid.constraint` is kRigid, otherwise lines inside the mesh. In a box with periodic sides a
/// fitted mesh ends on lines between particles (boundary/periodic_cells.hpp). Opposite periodic
/// sides get the same points. Throws Error(kNotConverged) if a gap is too narrow for an edge, or if
/// discs of one body overlap across a periodic side; with kRigid they may overlap elsewhere. Throws
/// std::bad_variant_access if there is no domain.
MeshBoundary mesh_boundary(const particles::Fluid& fluid, const particles::Domain& domain,
                           const particles::FluidParticles& bodies, double coarsening = 1);

}  // namespace viscontact::freefem_flow
