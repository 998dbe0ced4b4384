// A grid of cells in rows along x. Cells across the period y are displaced, so that a sphere looks
// for neighbours in an interval of x, not in numbered cells.
#include "viscontact/suspensions/pair_search.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace viscontact::suspensions {
namespace {

struct SearchTuning {
  // Cells along an axis without a period, so that few spheres far apart need little memory.
  static constexpr double kMostCells = 100;
};

struct Axis {
  double from = 0, width = 0;  // of a cell
  std::int64_t cells = 1;
  bool is_periodic = false;

  std::int64_t cell_of(double x) const {
    return static_cast<std::int64_t>(std::floor((x - from) / width));
  }
  std::int64_t clamped(std::int64_t cell) const {
    return std::clamp<std::int64_t>(cell, 0, cells - 1);
  }
};

class Grid {
 public:
  Grid(const ShearedCell& cell, std::span<const double> positions, double reach)
      : positions_(positions) {
    const std::size_t count = positions.size() / 3;
    for (std::size_t d = 0; d < 3; ++d) {
      auto& axis = axes_[d];
      axis.is_periodic = cell.lengths[d] > 0;
      double length = cell.lengths[d];
      axis.from = cell.from[d];
      if (!axis.is_periodic) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t k = 0; k < count; ++k) {
          low = std::min(low, positions[3 * k + d]);
          high = std::max(high, positions[3 * k + d]);
        }
        axis.from = low;
        length = high - low;
      }
      axis.cells = static_cast<std::int64_t>(std::clamp(
          std::floor(length / reach), 1.0, axis.is_periodic ? 1e6 : SearchTuning::kMostCells));
      axis.width = std::max(length / static_cast<double>(axis.cells), reach);
    }
    begin_.assign(static_cast<std::size_t>(axes_[0].cells * axes_[1].cells * axes_[2].cells) + 1,
                  0);
    std::vector<std::size_t> cells(count);
    for (std::size_t k = 0; k < count; ++k) {
      std::array<std::int64_t, 3> at{};
      for (std::size_t d = 0; d < 3; ++d)
        at[d] = axes_[d].clamped(axes_[d].cell_of(positions[3 * k + d]));
      cells[k] = index_of(at);
      ++begin_[cells[k] + 1];
    }
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    spheres_.resize(count);
    auto next = begin_;
    for (std::size_t k = 0; k < count; ++k)
      spheres_[next[cells[k]]++] = static_cast<std::int32_t>(k);
  }

  /// False if a sphere might meet a cell from two sides.
  bool suits() const {
    return std::ranges::all_of(axes_, [&](const Axis& axis) {
      return !axis.is_periodic || axis.cells >= 3 || &axis == &axes_[0];
    });
  }

  /// Calls see(j) for each sphere in a cell that may be within `reach` of sphere k.
  template <class See>
  void for_near(std::size_t k, const ShearedCell& cell, double reach, const See& see) const {
    std::array<std::int64_t, 3> middle{};
    for (std::size_t d = 1; d < 3; ++d)
      middle[d] = axes_[d].clamped(axes_[d].cell_of(positions_[3 * k + d]));
    for (std::int64_t dz = -1; dz <= 1; ++dz)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        std::int64_t y = middle[1] + dy, z = middle[2] + dz;
        double x = positions_[3 * k];
        // The image of the sphere that the neighbours in the cell see.
        if (y < 0 || y >= axes_[1].cells) {
          if (!axes_[1].is_periodic) continue;
          x += y < 0 ? cell.offset : -cell.offset;
          y += y < 0 ? axes_[1].cells : -axes_[1].cells;
        }
        if (z < 0 || z >= axes_[2].cells) {
          if (!axes_[2].is_periodic) continue;
          z += z < 0 ? axes_[2].cells : -axes_[2].cells;
        }
        for_row(x - reach, x + reach, y, z, see);
      }
  }

 private:
  std::size_t index_of(const std::array<std::int64_t, 3>& at) const {
    return static_cast<std::size_t>((at[2] * axes_[1].cells + at[1]) * axes_[0].cells + at[0]);
  }
  template <class See>
  void for_row(double low, double high, std::int64_t y, std::int64_t z, const See& see) const {
    const auto& axis = axes_[0];
    std::int64_t first = axis.cell_of(low), last = axis.cell_of(high);
    if (!axis.is_periodic) {
      first = axis.clamped(first);
      last = axis.clamped(last);
    } else if (last - first >= axis.cells) {
      first = 0;
      last = axis.cells - 1;
    }
    for (std::int64_t c = first; c <= last; ++c) {
      const std::int64_t x = ((c % axis.cells) + axis.cells) % axis.cells;
      const auto index = index_of({x, y, z});
      for (std::size_t s = begin_[index]; s < begin_[index + 1]; ++s) see(spheres_[s]);
    }
  }

  std::span<const double> positions_;
  std::array<Axis, 3> axes_{};
  std::vector<std::size_t> begin_;     // of each cell in spheres_
  std::vector<std::int32_t> spheres_;  // in order of cell
};

}  // namespace

double largest_distance(std::span<const double> radii, double range) {
  const double largest = radii.empty() ? 0 : *std::ranges::max_element(radii);
  return (2 + range) * largest;
}

std::vector<NearPair> near_pairs(const ShearedCell& cell, std::span<const double> positions,
                                 std::span<const double> radii, double range) {
  assert(positions.size() == 3 * radii.size());
  std::vector<NearPair> pairs;
  if (radii.empty()) return pairs;
  const double reach = largest_distance(radii, range);
  const Grid grid(cell, positions, reach);
  const auto try_pair = [&](std::size_t i, std::size_t j) {
    const Vector apart = cell.nearest(particles::point_of(positions.data(), j, 3) -
                                      particles::point_of(positions.data(), i, 3));
    const double farthest = (1 + range / 2) * (radii[i] + radii[j]);
    if (dot(apart, apart) < farthest * farthest)
      pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), apart});
  };
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const auto begin = pairs.size();
    if (grid.suits())
      grid.for_near(i, cell, reach, [&](std::int32_t j) {
        if (static_cast<std::size_t>(j) > i) try_pair(i, static_cast<std::size_t>(j));
      });
    else
      for (std::size_t j = i + 1; j < radii.size(); ++j) try_pair(i, j);
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(begin), pairs.end(),
              [](const NearPair& a, const NearPair& b) { return a.second < b.second; });
  }
  return pairs;
}

}  // namespace viscontact::suspensions
