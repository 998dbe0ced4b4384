// The boundary of the mesh around membranes, which are curves inside it. All lengths have one unit.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/freefem_flow/mesh_boundary.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::freefem_flow {

/// Label of membrane 0 in membranes.edp; that of membrane k is larger by k.
inline constexpr int kFirstMembraneLabel = 20;
/// Labels of membranes end before those of particles, so that no more membranes can be computed.
inline constexpr int kMostMembranes = kFirstParticleLabel - kFirstMembraneLabel;

/// The places of the nodes of each membrane, (x, y) in a row: the ends and the middles of its edges
/// in turn, counter-clockwise.
using NodesOfMembranes = std::vector<Eigen::MatrixXd>;

/// Throws Error(kNotConverged) if a node of a membrane is not in the domain. The message has
/// lengths in a unit that is smaller by the factor `unit`.
void check_places(const particles::Domain& domain, const NodesOfMembranes& nodes, double unit);

/// The shift along x after which no membrane crosses the sides of a box that is periodic along x; 0
/// for other domains. Throws Error(kNotConverged) if there is none.
double shift_between_membranes(const particles::Domain& domain, const NodesOfMembranes& nodes);

/// The boundary of the mesh: walls and periodic sides, and then the membranes, each of which has
/// `edges` edges. Edges on walls grow with the distance from the membranes.
MeshBoundary membrane_boundary(const particles::Domain& domain, const NodesOfMembranes& nodes,
                               int edges);

}  // namespace viscontact::freefem_flow
