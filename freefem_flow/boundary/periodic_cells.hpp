// The lines on which a mesh of a periodic box ends if it follows the particles, because the sides
// of the box would cut particles.
#pragma once

#include <span>
#include <vector>

#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::freefem_flow {

/// An edge of the boundary of the region that the mesh covers.
struct CellEdge {
  Point from,  ///< first end [L]; seen from here towards `to`, the region is on the left
      to;      ///< last end [L]
  /// Of the wall that the edge lies on, or kPeriodicLabel.
  int label = 0;
  /// Place in the list of edges of the edge that differs from this one by a shift of whole periods
  /// and has the opposite direction; -1 if this edge lies on a wall.
  int partner = -1;
};

/// The edges of the region that is the union of one cell for each particle, in the order of the
/// particles. A cell is that of a power diagram (Aurenhammer 1987): the points x whose power
/// distance |x - c|^2 - r^2 from the centre c of the particle with radius r is smaller than that
/// from any other particle or image, which is a particle shifted by whole periods. Exactly one such
/// shift takes a point of the plane into the region, and no cell cuts a particle, so that the
/// region can take the place of the box. An edge is left out if it is shorter than a tenth of the
/// distance of its end from the particles; its ends are joined.
///
/// `box` is periodic along at least one axis. `circles` are the particles, or the circles around
/// them, with centres in the box; they must not overlap.
std::vector<CellEdge> periodic_cells(const particles::BoxDomain& box,
                                     std::span<const particles::PlacedShape> circles);

}  // namespace viscontact::freefem_flow
