// Finds all pairs of close particles by cell lists, for any ratio of radii. Memory grows with the
// number of particles and pairs, and time also with the number of grids. All lengths are in one
// unit. Nothing is thrown. A change must keep the order of the pairs, on which the results of a
// simulation depend.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {

/// Two particles that are close to each other.
struct ClosePair {
  std::int32_t first,      ///< number of a particle, < second
      second;              ///< number of a particle
  std::int32_t image = 0;  ///< which image of `second` (periods.hpp)
  /// True if the particles and the image are the same.
  bool operator==(const ClosePair&) const = default;
};

/// All pairs of particles i and j with |x_i - x_j| < e_i + e_j, in order of first, then second,
/// where x are the positions and e the extents. `positions` is a flat array of `dimension` (1, 2 or
/// 3) finite numbers for each particle [L]. `extents` has a number > 0 for each particle [L].
///
/// Particles whose extents are within the same factor of 2 share a grid, whose cells are twice as
/// wide as the largest of these extents. Each particle looks for neighbours in its own grid and in
/// all coarser ones.
std::vector<ClosePair> close_pairs(int dimension, std::span<const double> positions,
                                   std::span<const double> extents, ThreadPool& pool);

/// All pairs with |x_j + shift - x_i| < e_i + e_j, i < j, where the shifts are those of the images
/// -13 to 13 of particle j, in order of first, second, image. `positions` has 2 or 3 numbers for
/// each extent; other arguments are those of close_pairs(). Positions may lie outside the cell by
/// less than a period.
///
/// Needs e_i + e_j < each period for all pairs: otherwise further images might be close. A particle
/// makes no pair with its own images. Particles near the sides are copied to the opposite sides,
/// and close_pairs() finds the pairs with the copies.
std::vector<ClosePair> close_pairs_in_period(const PeriodicCell& cell,
                                             std::span<const double> positions,
                                             std::span<const double> extents, ThreadPool& pool);

}  // namespace viscontact::particles
