// Where a fitted mesh of a periodic domain ends: halfway between particles. Lengths are in the unit
// of the case; nothing is thrown. mesh_boundary.cpp uses it. A change must give each edge a
// partner.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::freefem_flow {

/// An edge of the region that the cells of all particles cover together.
struct CellEdge {
  Point from,  ///< first end [L]; the region is on the left of the way from here to `to`
      to;      ///< last end [L]
  /// Label of the wall that the edge lies on; kPeriodicLabel elsewhere.
  int label = 0;
  /// The edge at the same place of the period, which has the opposite direction; -1 for a wall.
  int partner = -1;
};

/// The edges of the region that is the union of the Laguerre cells of all particles (Aurenhammer
/// 1987, "Power diagrams"): the points x whose power distance |x - c|^2 - r^2 is least for this
/// particle among all particles and images. Each point of the period is in exactly one cell, and no
/// cell cuts a particle. The region therefore represents the periodic domain as well as the box
/// does. Edges that are very short against their distance from the particles are left out, their
/// ends joined.
///
/// `circles`: the particles, at least one, with centres in the box. Their circles, which are those
/// around ellipses, do not overlap.
std::vector<CellEdge> periodic_cells(const particles::BoxDomain& box,
                                     std::span<const particles::Outline> circles);

}  // namespace viscontact::freefem_flow
