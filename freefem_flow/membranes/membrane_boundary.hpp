// Makes the boundary of the mesh of a fluid with membranes, which are closed curves inside the
// mesh, and rigid discs, which are holes of the mesh. The domain is a disc, or a box that may be
// periodic along x only; for any other one check_places() and membrane_boundary() throw
// std::bad_variant_access. All lengths have the unit of the arguments. membrane_process.cpp uses
// this file. Curves that leave no room for a mesh throw Error(kNotConverged). Sizes of arrays and
// signs of lengths are not checked. A change of labels must also be made in scripts/membranes.edp.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/outline.hpp"

namespace viscontact::freefem_flow {

/// Label of membrane 0 in membranes.edp; that of membrane k is larger by k.
inline constexpr int kFirstMembraneLabel = 20;
/// The largest number of membranes, 80: their labels must be below those of particles.
inline constexpr int kMostMembranes = kFirstParticleLabel - kFirstMembraneLabel;

/// The places of the nodes of each membrane, as a matrix with two rows for each edge of the
/// membrane and the columns x and y [L]. The rows are the beginning and the middle of the edges in
/// turn, counter-clockwise.
using NodesOfMembranes = std::vector<Eigen::MatrixXd>;

/// The curves inside the domain.
struct InnerCurves {
  NodesOfMembranes membranes{};             ///< nodes of all membranes
  std::vector<particles::Outline> discs{};  ///< outlines of the rigid discs
  int edges = 24;          ///< on each membrane, > 0; half the rows of each of `membranes`
  int edges_of_disc = 24;  ///< least number of edges on each disc, > 0
};

/// Throws Error(kNotConverged) if a node of a membrane is outside the domain or inside a disc, or
/// if a disc is not inside the domain; a place that is NaN counts as outside. `unit` > 0 is the
/// unit of length of `curves`, measured in that of the case; the message multiplies lengths by it.
/// Distances between two membranes or two discs are not checked.
void check_places(const particles::Domain& domain, const InnerCurves& curves, double unit);

/// The place of a line across a box that is periodic along x, at which a mesh can end: the distance
/// [L] from the left side of the box to the middle of the widest strip parallel to y that no
/// membrane, no disc and none of their periodic images enters. The distance may be negative. It is
/// 0 if the domain is not periodic along x or if there are no curves. Throws Error(kNotConverged)
/// if no strip is wider than a thousandth of the period.
double shift_between_membranes(const particles::Domain& domain, const InnerCurves& curves);

/// The boundary of the mesh: walls and periodic sides, then the discs, and then the membranes.
/// Edges on walls and discs are longer at a larger distance from the nearest membrane or disc. No
/// curve may cross a periodic side (not checked). Throws Error(kNotConverged) if an edge would be
/// shorter than 1e-7 of its curve (cut_curve()).
MeshBoundary membrane_boundary(const particles::Domain& domain, const InnerCurves& curves);

}  // namespace viscontact::freefem_flow
