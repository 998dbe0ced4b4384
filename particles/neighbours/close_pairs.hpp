// Pairs of close particles. The extent of a particle is the length up to which it looks for others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {

struct ClosePair {
  std::int32_t first,  ///< < second
      second;
  std::int32_t image = 0;  ///< of the periodic image of `second`, -13 to 13 (periods.hpp)
  bool operator==(const ClosePair&) const = default;
};

/// All pairs i < j with |x_i - x_j| < e_i + e_j of the positions x and extents e > 0, in order of
/// first, then second, on which bits of results depend. `positions` has `dimension` (1, 2 or 3)
/// finite numbers for each particle.
///
/// Particles whose extents are within the same factor of 2 share a grid, whose cells are twice as
/// wide as the largest of these extents. Each particle looks for neighbours in its own grid and in
/// all coarser ones.
std::vector<ClosePair> close_pairs(int dimension, std::span<const double> positions,
                                   std::span<const double> extents, ThreadPool& pool);

/// All close pairs in a periodic cell of 2 or 3 dimensions: particles i < j and images of j with
/// |x_j + shift - x_i| < e_i + e_j, in order of first, second, image. A particle makes no pair with
/// its own images. Positions may lie outside the cell by less than a period.
///
/// The sum e_i + e_j of any two extents must be less than each period, because otherwise images
/// that have no number might be close.
std::vector<ClosePair> close_pairs_in_period(const PeriodicCell& cell,
                                             std::span<const double> positions,
                                             std::span<const double> extents, ThreadPool& pool);

}  // namespace viscontact::particles
