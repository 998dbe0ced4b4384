// The boundary of the mesh around membranes, which are curves inside it. All lengths have one unit.
// membrane_process.cpp uses it. A change of labels must be made in membranes.edp, too.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/freefem_flow/mesh_boundary.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/outline.hpp"

namespace viscontact::freefem_flow {

/// Label of membrane 0 in membranes.edp; that of membrane k is larger by k.
inline constexpr int kFirstMembraneLabel = 20;
/// Labels of membranes end before those of particles, so that no more membranes can be computed.
inline constexpr int kMostMembranes = kFirstParticleLabel - kFirstMembraneLabel;

/// The places of the nodes of each membrane, (x, y) in a row: the ends and the middles of its edges
/// in turn, counter-clockwise.
using NodesOfMembranes = std::vector<Eigen::MatrixXd>;

/// The curves inside the domain.
struct InnerCurves {
  NodesOfMembranes membranes{};             ///< of all membranes [L]
  std::vector<particles::Outline> discs{};  ///< rigid discs, holes of the mesh
  int edges = 24;                           ///< on each membrane
  int edges_of_disc = 24;                   ///< on each disc, more where a gap is narrow
};

/// Throws Error(kNotConverged) if a node of a membrane is not in the domain or in a disc, or if a
/// disc leaves the domain. The message has lengths in a unit that is smaller by the factor `unit`.
void check_places(const particles::Domain& domain, const InnerCurves& curves, double unit);

/// The shift along x after which no membrane and no disc crosses the sides of a box that is
/// periodic along x; 0 for other domains. Throws Error(kNotConverged) if there is none.
double shift_between_membranes(const particles::Domain& domain, const InnerCurves& curves);

/// The boundary of the mesh: walls and periodic sides, the discs, and then the membranes. Edges on
/// walls and discs grow with the distance from the nearest membrane or disc.
MeshBoundary membrane_boundary(const particles::Domain& domain, const InnerCurves& curves);

}  // namespace viscontact::freefem_flow
