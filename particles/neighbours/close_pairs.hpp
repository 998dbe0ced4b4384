// Finds all pairs of close particles by cell lists, for any ratio of radii. Memory grows with the
// number of particles and pairs; time also grows with the number of grids, one for each factor of 2
// in the extents. Lengths are in any unit. Nothing is checked or thrown. neighbour_list.cpp, case/,
// fluid/ and current_contacts.cpp use it. A change must keep the order of the pairs, on which the
// bits of results depend.
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
/// for each particle [L], and `extents` one number > 0 [L]; neither is checked. Empty if no pair is
/// close.
///
/// Particles whose extents are within the same factor of 2 share a grid, whose cells are twice as
/// wide as the largest of these extents. Each particle looks for neighbours in its own grid and in
/// all coarser ones.
std::vector<ClosePair> close_pairs(int dimension, std::span<const double> positions,
                                   std::span<const double> extents, ThreadPool& pool);

/// The same in a periodic cell: all pairs i < j and images of j with |x_j + shift - x_i| < e_i +
/// e_j, where the shifts are those of the images -13 to 13, in order of first, second, image. The
/// dimension is 2 or 3. Positions may lie outside the cell by less than a period.
///
/// e_i + e_j must be less than each period for all pairs, because otherwise images that have no
/// number might be close. A particle makes no pair with its own images. Particles near the sides
/// are copied to the opposite sides, and close_pairs() finds the pairs with the copies.
std::vector<ClosePair> close_pairs_in_period(const PeriodicCell& cell,
                                             std::span<const double> positions,
                                             std::span<const double> extents, ThreadPool& pool);

}  // namespace viscontact::particles
