// The boundary of the mesh of a fluid with membranes, which are closed curves inside the mesh, and
// rigid discs, which are holes of the mesh. scripts/membranes.edp repeats its labels.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viscontact/freefem_flow/boundary/mesh_boundary.hpp"
#include "viscontact/freefem_flow/process/solver_units.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/shapes/distance.hpp"

namespace viscontact::freefem_flow {

/// Label of membrane 0; that of membrane k is larger by k.
inline constexpr int kFirstMembraneLabel = 20;
/// Their labels must be below those of particles.
inline constexpr int kMostMembranes = kFirstParticleLabel - kFirstMembraneLabel;

/// The places of the nodes of each membrane: two rows for each of its edges, their beginning and
/// middle in turn, counter-clockwise, and the columns x and y [L].
using NodesOfMembranes = std::vector<Eigen::MatrixXd>;

/// The curves inside the domain.
struct InnerCurves {
  NodesOfMembranes membranes{};
  std::vector<particles::PlacedShape> discs{};
  int edges = 24;          ///< on each membrane; half the rows of each of `membranes`
  int edges_of_disc = 24;  ///< least number of edges on each disc
};

/// Throws Error(kNotConverged) if a node of a membrane is outside the domain or inside a disc, or
/// if a disc is not inside the domain; a place that is NaN counts as outside. `units` are those of
/// the arguments; the message has places of the case.
void check_places(const particles::Domain& domain, const InnerCurves& curves,
                  const SolverUnits& units);

/// The place of a line across a box that is periodic along x, at which a mesh can end: the distance
/// [L] from the left side of the box, which may be negative, to the middle of the widest strip
/// parallel to y that no membrane, no disc and none of their periodic images enters. It is 0 if the
/// domain is not periodic along x or if there are no curves. Throws Error(kNotConverged) if no
/// strip is wider than a thousandth of the period.
double shift_between_membranes(const particles::Domain& domain, const InnerCurves& curves);

/// The boundary of the mesh: walls and periodic sides, then the discs, and then the membranes. No
/// curve may cross a periodic side; opposite ones get the same points. The domain is a disc, or a
/// box that may be periodic along x only, or std::bad_variant_access is thrown. Throws
/// Error(kNotConverged) if an edge would be shorter than 1e-7 of its curve (cut_curve()).
MeshBoundary membrane_boundary(const particles::Domain& domain, const InnerCurves& curves);

}  // namespace viscontact::freefem_flow
