// Finds close pairs across the sides of a periodic cell by copies of the particles near them
// (close_pairs.hpp). Lengths are in one unit; nothing is checked or thrown. A change must keep the
// order of the pairs. Used by neighbour_list.cpp.
#include <algorithm>
#include <array>
#include <tuple>

#include "viscontact/particles/neighbours/close_pairs.hpp"

namespace viscontact::particles {
namespace {

/// The particles in the cell, and copies of those near its sides.
struct Copies {
  std::vector<double> positions, extents;
  std::vector<std::int32_t> particles;          // particle of each point
  std::vector<std::array<int, 2>> shifts;       // periods by which each point is shifted
  std::vector<std::array<int, 2>> into_cell{};  // periods subtracted to bring each particle inside
};

Copies copies_near_sides(const PeriodicCell& cell, std::span<const double> positions,
                         std::span<const double> extents) {
  const double largest = extents.empty() ? 0 : *std::ranges::max_element(extents);
  Copies all;
  const auto add = [&](std::size_t k, const std::array<double, 2>& x, int right, int up) {
    const double reach = extents[k] + largest;
    const std::array<int, 2> shift = {right, up};
    std::array<double, 2> at{};
    for (std::size_t d = 0; d < 2; ++d) {
      at[d] = x[d] + shift[d] * cell.lengths[d];
      if (shift[d] != 0 && !(cell.lengths[d] > 0 && at[d] > cell.from[d] - reach &&
                             at[d] < cell.from[d] + cell.lengths[d] + reach))
        return;
    }
    all.positions.insert(all.positions.end(), at.begin(), at.end());
    all.extents.push_back(extents[k]);
    all.particles.push_back(static_cast<std::int32_t>(k));
    all.shifts.push_back(shift);
  };
  std::vector<std::array<double, 2>> inside(extents.size());
  for (std::size_t k = 0; k < extents.size(); ++k) {
    std::array<int, 2> beyond{};
    for (std::size_t d = 0; d < 2; ++d) {
      const double x = positions[2 * k + d];
      beyond[d] = static_cast<int>(periods_beyond(cell, d, x));
      inside[k][d] = x - beyond[d] * cell.lengths[d];
    }
    all.into_cell.push_back(beyond);
    add(k, inside[k], 0, 0);
  }
  for (std::size_t k = 0; k < extents.size(); ++k)
    for (int up = -1; up <= 1; ++up)
      for (int right = -1; right <= 1; ++right)
        if (right != 0 || up != 0) add(k, inside[k], right, up);
  return all;
}

}  // namespace

std::vector<ClosePair> close_pairs_in_period(const PeriodicCell& cell,
                                             std::span<const double> positions,
                                             std::span<const double> extents, ThreadPool& pool) {
  const auto all = copies_near_sides(cell, positions, extents);
  std::vector<ClosePair> pairs;
  // The particles come before the copies, so that `first` is a particle or both are copies. Each
  // pair with an image is found twice, once from each of its particles.
  for (const auto& pair : close_pairs(2, all.positions, all.extents, pool)) {
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    const auto i = all.particles[a], j = all.particles[b];
    if (a >= extents.size() || i >= j) continue;
    const auto &of_i = all.into_cell[static_cast<std::size_t>(i)],
               &of_j = all.into_cell[static_cast<std::size_t>(j)];
    pairs.push_back(
        {i, j,
         image_number(all.shifts[b][0] + of_i[0] - of_j[0], all.shifts[b][1] + of_i[1] - of_j[1])});
  }
  std::ranges::sort(pairs, {}, [](const ClosePair& pair) {
    return std::tuple(pair.first, pair.second, pair.image);
  });
  return pairs;
}

}  // namespace viscontact::particles
