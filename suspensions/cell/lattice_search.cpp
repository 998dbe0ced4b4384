// A grid along the period vectors, whose layers are at least as thick as pairs are long, so that
// the spheres near one are in its cell and the 26 around it.
#include "viscontact/suspensions/cell/lattice_search.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "viscontact/suspensions/cell/cell_lists.hpp"

namespace viscontact::suspensions {
namespace {

constexpr std::size_t kSpheresInBlock = 1024;  // of a loop

class LatticeGrid {
 public:
  LatticeGrid(const LatticeCell& cell, std::span<const double> positions, double reach)
      : cell_(cell) {
    const auto count = positions.size() / 3;
    cells_ = cells_along(heights_of(cell.periods), reach, count);
    std::vector<std::size_t> cells(count);
    places_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const Vector at = cell.fractions_at(particles::point_of(positions.data(), k, 3));
      auto& place = places_[k];
      for (std::size_t d = 0; d < 3; ++d)
        place[d] = std::clamp<std::int64_t>(
            static_cast<std::int64_t>(std::floor((at[d] + 0.5) * static_cast<double>(cells_[d]))),
            0, cells_[d] - 1);
      cells[k] = index_of(place);
    }
    lists_ = CellLists(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]), cells);
  }

  /// False if a sphere might meet a cell from two sides.
  bool meets_cells_once() const {
    return std::ranges::all_of(cells_, [](std::int64_t cells) { return cells >= 3; });
  }

  /// Calls see(j, shift) for each sphere j in a cell near that of sphere k, with the shift [L] of
  /// the image of j that is there.
  template <class See>
  void for_near(std::size_t k, const See& see) const {
    for (std::int64_t dz = -1; dz <= 1; ++dz)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
          std::array<std::int64_t, 3> at{places_[k][0] + dx, places_[k][1] + dy,
                                         places_[k][2] + dz};
          particles::Periods counts{};
          for (std::size_t d = 0; d < 3; ++d) {
            if (at[d] >= 0 && at[d] < cells_[d]) continue;
            counts[d] = at[d] < 0 ? -1 : 1;
            at[d] -= (at[d] < 0 ? -1 : 1) * cells_[d];
          }
          const Vector shift = cell_.shift_of(counts);
          const auto index = index_of(at);
          for (std::size_t s = lists_.begin(index); s < lists_.end(index); ++s)
            see(lists_.elements()[s], shift);
        }
  }

 private:
  std::size_t index_of(const std::array<std::int64_t, 3>& at) const {
    return static_cast<std::size_t>((at[2] * cells_[1] + at[1]) * cells_[0] + at[0]);
  }

  const LatticeCell& cell_;
  std::array<std::int64_t, 3> cells_{};
  std::vector<std::array<std::int64_t, 3>> places_;  // cell of each sphere
  CellLists lists_;
};

}  // namespace

std::vector<NearPair> near_pairs_of_lattice(const LatticeCell& cell,
                                            std::span<const double> positions,
                                            std::span<const double> radii, double range,
                                            ThreadPool* pool) {
  assert(positions.size() == 3 * radii.size());
  const LatticeGrid grid(cell, positions, largest_distance(radii, range));
  const bool meets_cells_once = grid.meets_cells_once();
  const auto add_pairs = [&](std::size_t i, std::vector<NearPair>& pairs) {
    const auto begin = pairs.size();
    const Vector at = particles::point_of(positions.data(), i, 3);
    const auto try_pair = [&](std::size_t j, const Vector& apart) {
      const double farthest = (1 + range / 2) * (radii[i] + radii[j]);
      if (dot(apart, apart) < farthest * farthest)
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), apart});
    };
    if (meets_cells_once) {
      grid.for_near(i, [&](std::int32_t number, const Vector& shift) {
        const auto j = static_cast<std::size_t>(number);
        if (j > i) try_pair(j, particles::point_of(positions.data(), j, 3) + shift - at);
      });
    } else {
      for (std::size_t j = i + 1; j < radii.size(); ++j) {
        const Vector apart = particles::point_of(positions.data(), j, 3) - at;
        try_pair(j, apart - cell.shift_of(cell.periods_towards(apart)));
      }
    }
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(begin), pairs.end(),
              [](const NearPair& a, const NearPair& b) { return a.second < b.second; });
  };
  using Found = ConcatenatedBlocks<NearPair>;
  ThreadPool one(1);
  return (pool ? *pool : one)
      .sum_of_blocks<Found>(
          radii.size(),
          [&](std::size_t begin, std::size_t end) {
            Found part;
            for (std::size_t i = begin; i < end; ++i) add_pairs(i, part.values);
            return part;
          },
          kSpheresInBlock)
      .values;
}

}  // namespace viscontact::suspensions
