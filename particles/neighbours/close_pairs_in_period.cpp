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
  std::vector<std::array<int, 3>> shifts;       // periods by which each point is shifted
  std::vector<std::array<int, 3>> into_cell{};  // periods subtracted to bring each particle inside
};

Copies copies_near_sides(std::size_t dimension, const PeriodicCell& cell,
                         std::span<const double> positions, std::span<const double> extents) {
  const double largest = extents.empty() ? 0 : *std::ranges::max_element(extents);
  Copies all;
  const auto add = [&](std::size_t k, const Vector& x, const std::array<int, 3>& shift) {
    const double reach = extents[k] + largest;
    Vector at{};
    for (std::size_t d = 0; d < dimension; ++d) {
      at[d] = x[d] + shift[d] * cell.lengths[d];
      if (shift[d] != 0 &&
          !(at[d] > cell.from[d] - reach && at[d] < cell.from[d] + cell.lengths[d] + reach))
        return;
    }
    const auto end = at.begin() + static_cast<std::ptrdiff_t>(dimension);
    all.positions.insert(all.positions.end(), at.begin(), end);
    all.extents.push_back(extents[k]);
    all.particles.push_back(static_cast<std::int32_t>(k));
    all.shifts.push_back(shift);
  };
  std::vector<Vector> inside(extents.size());
  for (std::size_t k = 0; k < extents.size(); ++k) {
    std::array<int, 3> beyond{};
    for (std::size_t d = 0; d < dimension; ++d) {
      const double x = positions[dimension * k + d];
      beyond[d] = static_cast<int>(periods_beyond(cell, d, x));
      inside[k][d] = x - beyond[d] * cell.lengths[d];
    }
    all.into_cell.push_back(beyond);
    add(k, inside[k], {});
  }
  std::vector<std::array<int, 3>> shifts;  // shifts of all images along periodic axes
  for (std::int32_t image = -kLargestImage; image <= kLargestImage; ++image)
    if (image != 0 && has_image(cell, image)) shifts.push_back(periods_of_image(image));
  for (std::size_t k = 0; k < extents.size(); ++k)
    for (const auto& shift : shifts) add(k, inside[k], shift);
  return all;
}

}  // namespace

std::vector<ClosePair> close_pairs_in_period(const PeriodicCell& cell,
                                             std::span<const double> positions,
                                             std::span<const double> extents, ThreadPool& pool) {
  if (extents.empty()) return {};
  const auto dimension = positions.size() / extents.size();
  const auto all = copies_near_sides(dimension, cell, positions, extents);
  std::vector<ClosePair> pairs;
  // The particles come before the copies, so that `first` is a particle or both are copies. Each
  // pair with an image is found twice, once from each of its particles.
  for (const auto& pair :
       close_pairs(static_cast<int>(dimension), all.positions, all.extents, pool)) {
    const auto a = static_cast<std::size_t>(pair.first), b = static_cast<std::size_t>(pair.second);
    const auto i = all.particles[a], j = all.particles[b];
    if (a >= extents.size() || i >= j) continue;
    auto shift = all.shifts[b];
    for (std::size_t d = 0; d < 3; ++d)
      shift[d] += all.into_cell[static_cast<std::size_t>(i)][d] -
                  all.into_cell[static_cast<std::size_t>(j)][d];
    pairs.push_back({i, j, image_number(shift[0], shift[1], shift[2])});
  }
  std::ranges::sort(pairs, {}, [](const ClosePair& pair) {
    return std::tuple(pair.first, pair.second, pair.image);
  });
  return pairs;
}

}  // namespace viscontact::particles
