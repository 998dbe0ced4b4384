// Which pairs of particles are close: cell lists for any spread of radii.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"

namespace viscontact::particles {

struct Pair {
  std::int32_t first, second;  ///< first < second
  bool operator==(const Pair&) const = default;
};

/// All pairs with |x_i - x_j| < e_i + e_j, in order of first, then second. `positions`: flat, `dimension` (2 or 3) numbers each, finite [L];
/// `extents`: e > 0 [L]. Time and memory grow with the number of particles and of pairs, whatever the spread of the extents: particles of like extent
/// (within a factor 2) share a grid of cells of twice the largest of them, and each looks for neighbours in its own grid and in the coarser ones.
std::vector<Pair> close_pairs(int dimension, std::span<const double> positions,
                              std::span<const double> extents, ThreadPool& pool);

}  // namespace viscontact::particles
