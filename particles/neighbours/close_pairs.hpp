// Finds all pairs of close particles by cell lists, for any ratio of radii. Memory grows with the
// number of particles and pairs, and time also with the number of grids. All lengths are in one
// unit.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"

namespace viscontact::particles {

struct ClosePair {
  std::int32_t first, second;  ///< first < second
  bool operator==(const ClosePair&) const = default;
};

/// All pairs with |x_i - x_j| < e_i + e_j, in order of first, then second. `positions`: a flat
/// array of `dimension` (2 or 3) finite numbers for each particle [L]. `extents`: e > 0 of each
/// particle [L].
///
/// Particles whose extents are within the same factor of 2 share a grid, whose cells are twice as
/// wide as the largest of these extents. Each particle looks for neighbours in its own grid and in
/// all coarser ones.
std::vector<ClosePair> close_pairs(int dimension, std::span<const double> positions,
                                   std::span<const double> extents, ThreadPool& pool);

}  // namespace viscontact::particles
