// Grids of cells, one for each factor of 2 in the extents, a sweep in one dimension, and copies
// near the sides of a periodic cell.
#include "viscontact/particles/neighbours/close_pairs.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace viscontact::particles {
namespace {

struct CellGridTuning {
  // Bits that one pass of the radix sort orders. With 11 bits its table has 16 kB.
  static constexpr int kBits = 11;
  // Positions in the sample whose median is the middle of a grid.
  static constexpr std::size_t kSample = 1001;
  // Cells along an axis, so that cell numbers of three axes fit into 64 bits.
  static constexpr double kMostCells = 1 << 20;
};

struct Entry {
  std::uint64_t cell;
  std::int32_t particle;
};

/// A radix sort, which keeps the order of entries with equal cells. `most` is a bound of all cell
/// numbers.
void sort_by_cell(std::vector<Entry>& entries, std::uint64_t most) {
  constexpr int kBits = CellGridTuning::kBits;
  std::vector<Entry> sorted(entries.size());
  for (int shift = 0; shift < 64 && (most >> shift) > 0; shift += kBits) {
    std::array<std::size_t, (1 << kBits) + 1> begin{};
    const auto digit = [&](const Entry& entry) {
      return static_cast<std::size_t>((entry.cell >> shift) & ((1U << kBits) - 1));
    };
    for (const auto& entry : entries) ++begin[digit(entry) + 1];
    for (std::size_t d = 1; d < begin.size(); ++d) begin[d] += begin[d - 1];
    for (const auto& entry : entries) sorted[begin[digit(entry)]++] = entry;
    std::swap(entries, sorted);
  }
}

/// Cells of one size, numbered row by row, that cover the positions of all particles, and the
/// particles that belong to this grid.
template <int D>
class Grid {
 public:
  /// `cell` is the width of a cell [L]; `positions` has D numbers for each particle [L].
  Grid(double cell, std::span<const double> positions) : per_cell_(1 / cell) {
    const std::size_t count = positions.size() / D;
    for (std::size_t d = 0; d < D; ++d) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t k = 0; k < count; ++k) {
        low = std::min(low, positions[k * D + d]);
        high = std::max(high, positions[k * D + d]);
      }
      // Particles further than half a million cells (kMostCells / 2) from the middle are put into
      // the cells at the border. Particles of neighbouring cells remain in one cell or in
      // neighbouring ones, so that no pair is missed.
      middle_[d] = middle(positions, d);
      half_[d] = std::min(std::ceil(std::max(high - middle_[d], middle_[d] - low) * per_cell_) + 1,
                          CellGridTuning::kMostCells / 2);
      cells_[d] = static_cast<std::uint64_t>(2 * half_[d]) + 3;  // one spare cell on each side
    }
  }

  std::uint64_t last_cell() const {
    std::uint64_t product = 1;
    for (const auto cells : cells_) product *= cells;
    return product;
  }

  std::uint64_t cell_of(const double* position) const {
    std::uint64_t cell = 0;
    for (std::size_t d = D; d-- > 0;) {
      const double offset =
          std::clamp(std::floor((position[d] - middle_[d]) * per_cell_), -half_[d], half_[d]);
      cell = cell * cells_[d] + static_cast<std::uint64_t>(offset + half_[d]) + 1;
    }
    return cell;
  }

  /// `cell` and its neighbours form 3 (in the plane) or 9 (in space) runs of three cells along the
  /// first axis. Calls see(first cell of the run, number of the run) for each.
  template <class See>
  void for_rows_around(std::uint64_t cell, const See& see) const {
    constexpr std::uint64_t kLayers = D == 2 ? 1 : 3;
    const std::uint64_t row = cells_[0], layer = D == 2 ? 0 : row * cells_[1];
    for (std::uint64_t z = 0; z < kLayers; ++z)
      for (std::uint64_t y = 0; y < 3; ++y)
        see(cell - 1 - row - layer + y * row + z * layer, y + 3 * z);
  }

  std::vector<Entry> entries;  ///< in order of cell

 private:
  /// The median of a sample, which a few particles far away do not change.
  static double middle(std::span<const double> positions, std::size_t d) {
    const std::size_t count = positions.size() / D, stride = count / CellGridTuning::kSample + 1;
    std::vector<double> sample;
    for (std::size_t k = 0; k < count; k += stride) sample.push_back(positions[k * D + d]);
    const auto half = sample.begin() + std::ssize(sample) / 2;
    std::ranges::nth_element(sample, half);
    return *half;
  }

  double per_cell_;
  std::array<double, D> middle_{}, half_{};
  std::array<std::uint64_t, D> cells_{};
};

/// The arguments must outlive the object.
template <int D>
class Search {
 public:
  Search(std::span<const double> positions, std::span<const double> extents, ThreadPool& pool)
      : positions_(positions), extents_(extents), pool_(pool) {}

  /// In order of first, then second. Particles whose extents lie between the same two powers of 2
  /// share a grid.
  std::vector<ClosePair> pairs() {
    std::vector<int> levels(extents_.size());
    for (std::size_t k = 0; k < extents_.size(); ++k) levels[k] = std::ilogb(extents_[k]);
    auto present = levels;
    std::ranges::sort(present);
    present.erase(std::unique(present.begin(), present.end()), present.end());
    for (const int level : present) {
      double largest = 0;
      for (std::size_t k = 0; k < extents_.size(); ++k)
        if (levels[k] == level) largest = std::max(largest, extents_[k]);
      Grid<D> grid(2 * largest, positions_);
      // The pairs within the grid, then those of its particles with particles of finer grids.
      grid.entries = entries_of(grid, [&](std::size_t k) { return levels[k] == level; });
      look(grid, grid.entries, true);
      if (level != present.front())
        look(grid, entries_of(grid, [&](std::size_t k) { return levels[k] < level; }), false);
    }
    return sorted();
  }

 private:
  /// In order of their cell in `grid`.
  template <class Test>
  std::vector<Entry> entries_of(const Grid<D>& grid, const Test& test) const {
    std::vector<Entry> entries;
    for (std::size_t k = 0; k < extents_.size(); ++k)
      if (test(k))
        entries.push_back({grid.cell_of(&positions_[k * D]), static_cast<std::int32_t>(k)});
    sort_by_cell(entries, grid.last_cell());
    return entries;
  }

  bool close(std::int32_t i, std::int32_t j) const {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    double square = 0;
    for (std::size_t d = 0; d < D; ++d) {
      const double x = positions_[b * D + d] - positions_[a * D + d];
      square += x * x;
    }
    const double reach = extents_[a] + extents_[b];
    return square < reach * reach;
  }

  /// Adds the pairs of `seekers` with the particles in the grid, which are the same if `same`.
  /// Seekers are in order of cell, so that the search for the cells around them only moves forward.
  void look(const Grid<D>& grid, const std::vector<Entry>& seekers, bool same) {
    const auto& in_grid = grid.entries;
    found_ += pool_.sum_of_blocks<ConcatenatedBlocks<ClosePair>>(
        seekers.size(), [&](std::size_t begin, std::size_t end) {
          ConcatenatedBlocks<ClosePair> pairs;
          constexpr std::size_t kRows = D == 2 ? 3 : 9;
          std::array<std::size_t, kRows> run_begin{};
          grid.for_rows_around(seekers[begin].cell, [&](std::uint64_t first, std::uint64_t row) {
            run_begin[row] = static_cast<std::size_t>(
                std::ranges::lower_bound(in_grid, first, {}, &Entry::cell) - in_grid.begin());
          });
          for (std::size_t s = begin; s < end; ++s) {
            const auto& seeker = seekers[s];
            grid.for_rows_around(seeker.cell, [&](std::uint64_t first, std::uint64_t row) {
              std::size_t k = run_begin[row];
              while (k < in_grid.size() && in_grid[k].cell < first) ++k;
              run_begin[row] = k;
              for (; k < in_grid.size() && in_grid[k].cell < first + 3; ++k) {
                const auto other = in_grid[k].particle;
                if (same && other <= seeker.particle) continue;  // each pair once
                if (close(seeker.particle, other))
                  pairs.values.push_back(
                      {std::min(seeker.particle, other), std::max(seeker.particle, other)});
              }
            });
          }
          return pairs;
        });
  }

  std::vector<ClosePair> sorted() const {
    std::vector<std::size_t> begin(extents_.size() + 1, 0);
    for (const auto& pair : found_.values) ++begin[static_cast<std::size_t>(pair.first) + 1];
    for (std::size_t k = 0; k + 1 < begin.size(); ++k) begin[k + 1] += begin[k];
    std::vector<ClosePair> pairs(found_.values.size());
    auto next = begin;
    for (const auto& pair : found_.values)
      pairs[next[static_cast<std::size_t>(pair.first)]++] = pair;
    for (std::size_t k = 0; k + 1 < begin.size(); ++k)
      std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(begin[k]),
                pairs.begin() + static_cast<std::ptrdiff_t>(begin[k + 1]),
                [](const ClosePair& a, const ClosePair& b) { return a.second < b.second; });
    return pairs;
  }

  std::span<const double> positions_, extents_;
  ThreadPool& pool_;
  ConcatenatedBlocks<ClosePair> found_;
};

/// Compares each particle, in order of the lower ends position - extent, with those before it whose
/// intervals reach it.
std::vector<ClosePair> close_pairs_on_line(std::span<const double> positions,
                                           std::span<const double> extents) {
  std::vector<std::int32_t> order(extents.size());
  std::iota(order.begin(), order.end(), 0);
  const auto low = [&](std::int32_t k) {
    const auto i = static_cast<std::size_t>(k);
    return positions[i] - extents[i];
  };
  std::ranges::sort(order, {}, low);
  std::vector<ClosePair> pairs;
  std::vector<std::int32_t> reaching;
  for (const auto j : order) {
    const auto b = static_cast<std::size_t>(j);
    std::erase_if(reaching, [&](std::int32_t i) {
      const auto a = static_cast<std::size_t>(i);
      return positions[a] + extents[a] < low(j);
    });
    for (const auto i : reaching) {
      const auto a = static_cast<std::size_t>(i);
      if (std::abs(positions[b] - positions[a]) < extents[a] + extents[b])
        pairs.push_back({std::min(i, j), std::max(i, j)});
    }
    reaching.push_back(j);
  }
  std::ranges::sort(pairs, {},
                    [](const ClosePair& pair) { return std::pair(pair.first, pair.second); });
  return pairs;
}

}  // namespace

std::vector<ClosePair> close_pairs(int dimension, std::span<const double> positions,
                                   std::span<const double> extents, ThreadPool& pool) {
  assert(dimension >= 1 && dimension <= 3);
  assert(positions.size() == extents.size() * static_cast<std::size_t>(dimension));
  assert(std::ranges::all_of(extents, [](double extent) { return extent > 0; }));
  if (extents.empty()) return {};
  if (dimension == 1) return close_pairs_on_line(positions, extents);
  return dimension == 2 ? Search<2>(positions, extents, pool).pairs()
                        : Search<3>(positions, extents, pool).pairs();
}

namespace {

/// All particles, moved into the cell, and then copies near its sides.
struct Copies {
  std::vector<double> positions, extents;
  std::vector<std::int32_t> particles;          // that the point is an image of
  std::vector<std::array<int, 3>> shifts;       // periods from the cell to the copy
  std::vector<std::array<int, 3>> into_cell{};  // of each particle: periods that were subtracted
};

/// A copy is added if it is near enough to be close to a particle inside the cell.
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
  std::vector<std::array<int, 3>> shifts;  // of all images that the cell has
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
  assert(positions.size() % extents.size() == 0);
  const auto dimension = positions.size() / extents.size();
  const auto all = copies_near_sides(dimension, cell, positions, extents);
  std::vector<ClosePair> pairs;
  // The particles come before the copies. Therefore `first` of a pair is a particle, unless both
  // are copies; pairs of two copies are skipped. A pair with an image is found twice, once from
  // each of its particles; the pair with i < j is kept.
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
