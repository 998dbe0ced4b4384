// The pairs of spheres whose gaps are below the range of lubrication, by a grid of cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/suspensions/cell/sheared_cell.hpp"

namespace viscontact::suspensions {

struct NearPair {
  std::int32_t first = 0, second = 0;  ///< first < second
  Vector apart{};                      ///< from the first to the nearest image of the second [L]
};

/// All pairs with a gap below `range` mean radii, in order of first, second. `positions` has three
/// coordinates [L] for each of the `radii` [L] and lies in the cell. Takes a time proportional to
/// the number of spheres, if the cell is at least three distances of pairs wide along y and z.
std::vector<NearPair> near_pairs(const ShearedCell& cell, std::span<const double> positions,
                                 std::span<const double> radii, double range,
                                 ThreadPool* pool = nullptr);

/// The largest distance [L] of the centres of a pair.
double largest_distance(std::span<const double> radii, double range);

}  // namespace viscontact::suspensions
