// The search of near pairs in a cell with any period vectors.
#pragma once

#include <span>
#include <vector>

#include "viscontact/suspensions/cell/pair_search.hpp"

namespace viscontact::suspensions {

/// near_pairs() of a lattice. Takes a time proportional to the number of spheres if each height of
/// the cell is at least three distances of pairs.
std::vector<NearPair> near_pairs_of_lattice(const LatticeCell& cell,
                                            std::span<const double> positions,
                                            std::span<const double> radii, double range,
                                            ThreadPool* pool);

}  // namespace viscontact::suspensions
