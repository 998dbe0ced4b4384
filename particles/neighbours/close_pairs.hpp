// Finds all pairs of close particles by grids of cells, for any ratio of their extents (the extent
// of a particle is the length up to which it looks for others, such as radius plus a margin).
// Memory grows with the numbers of particles and pairs. Time also grows with the number of grids,
// of which there is one for each factor of 2 in the extents. Lengths are in any unit. Nothing is
// checked or thrown. neighbour_list.cpp, case/, fluid/ and current_contacts.cpp use this file. A
// change must keep the order of the pairs, on which the bits of results depend; the widths of the
// cells and the factor 2 are free choices, which only change the time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {

/// Two particles that are close to each other.
struct ClosePair {
  std::int32_t first,      ///< number of a particle, its place in `extents`, < second
      second;              ///< number of a particle
  std::int32_t image = 0;  ///< number of the periodic image of `second`, -13 to 13 (periods.hpp)
  /// True if all members are equal.
  bool operator==(const ClosePair&) const = default;
};

/// All pairs of particles i < j with |x_i - x_j| < e_i + e_j, where x are the positions and e the
/// extents, in order of first, then second. `positions` has `dimension` (1, 2 or 3) finite numbers
/// for each particle [L], and `extents` has one number > 0 for each particle [L]; neither is
/// checked. `pool` has the threads that search. The result is empty if no pair is close.
///
/// Particles whose extents are within the same factor of 2 share a grid, whose cells are twice as
/// wide as the largest of these extents. Each particle looks for neighbours in its own grid and in
/// all coarser ones.
std::vector<ClosePair> close_pairs(int dimension, std::span<const double> positions,
                                   std::span<const double> extents, ThreadPool& pool);

/// All close pairs in a periodic cell of 2 or 3 dimensions: particles i < j and images of j with
/// |x_j + shift - x_i| < e_i + e_j, where `shift` is that of an image with a number from -13 to 13
/// (periods.hpp). They are in order of first, second, image. Arrays are as in close_pairs().
/// Positions may lie outside the cell by less than a period.
///
/// The sum e_i + e_j of any two extents must be less than each period (not checked), because
/// otherwise images that have no number might be close. A particle makes no pair with its own
/// images. Particles near the sides are copied to the opposite sides, and close_pairs() finds the
/// pairs with the copies.
std::vector<ClosePair> close_pairs_in_period(const PeriodicCell& cell,
                                             std::span<const double> positions,
                                             std::span<const double> extents, ThreadPool& pool);

}  // namespace viscontact::particles
