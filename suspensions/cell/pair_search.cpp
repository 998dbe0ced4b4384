// A grid of cells in rows along x. Cells across the period y are displaced, so that a sphere looks
// for neighbours in an interval of x, not in numbered cells.
#include "viscontact/suspensions/cell/pair_search.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

#include "viscontact/suspensions/cell/cell_lists.hpp"
#include "viscontact/suspensions/cell/lattice_search.hpp"

namespace viscontact::suspensions {
namespace {

struct SearchTuning {
  static constexpr std::size_t kSpheres = 1024;  // in a block of a loop
  // Over the square of the largest distance: more than the rounding errors of a distance by cells.
  static constexpr double kSlack = 1 + 1e-9;
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
  Grid(const ShearedCell& cell, std::span<const double> positions, std::span<const double> radii,
       double reach)
      : period_(cell.lengths[0]) {
    const std::size_t count = radii.size();
    Vector lengths = cell.lengths;
    for (std::size_t d = 0; d < 3; ++d) {
      auto& axis = axes_[d];
      axis.is_periodic = lengths[d] > 0;
      axis.from = cell.from[d];
      if (!axis.is_periodic) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t k = 0; k < count; ++k) {
          low = std::min(low, positions[3 * k + d]);
          high = std::max(high, positions[3 * k + d]);
        }
        axis.from = low;
        lengths[d] = high - low;
      }
    }
    const auto along = cells_along(lengths, reach, count);
    for (std::size_t d = 0; d < 3; ++d) {
      axes_[d].cells = along[d];
      axes_[d].width = std::max(lengths[d] / static_cast<double>(along[d]), reach);
    }
    std::vector<std::size_t> cells(count);
    for (std::size_t k = 0; k < count; ++k) {
      std::array<std::int64_t, 3> at{};
      for (std::size_t d = 0; d < 3; ++d)
        at[d] = axes_[d].clamped(axes_[d].cell_of(positions[3 * k + d]));
      cells[k] = index_of(at);
    }
    lists_ = CellLists(static_cast<std::size_t>(along[0] * along[1] * along[2]), cells);
    spheres_.reserve(count);
    for (const auto number : lists_.elements()) {
      const auto k = static_cast<std::size_t>(number);
      spheres_.push_back({particles::point_of(positions.data(), k, 3), radii[k], number});
    }
  }

  /// False if a sphere might meet a cell from two sides.
  bool meets_cells_once() const {
    return std::ranges::all_of(axes_, [&](const Axis& axis) {
      return !axis.is_periodic || axis.cells >= 3 || &axis == &axes_[0];
    });
  }

  struct Sphere {
    Vector place{};
    double radius = 0;
    std::int32_t number = 0;
  };
  const std::vector<Sphere>& spheres() const { return spheres_; }

  /// Calls see(other) for each pair of `sphere` that may have a gap below `range` mean radii, in
  /// cells after that of the sphere or in its row. Of two spheres in one row the first number sees
  /// the other.
  template <class See>
  void for_near(const Sphere& sphere, const ShearedCell& cell, double reach, double range,
                const See& see) const {
    static constexpr std::array<std::array<std::int64_t, 2>, 5> kRows{
        {{0, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
    for (const auto& [dy, dz] : kRows) {
      std::int64_t y = axes_[1].clamped(axes_[1].cell_of(sphere.place[1])) + dy,
                   z = axes_[2].clamped(axes_[2].cell_of(sphere.place[2])) + dz;
      // The image of the sphere that the neighbours in the cells see.
      Vector image = sphere.place;
      if (y < 0 || y >= axes_[1].cells) {
        if (!axes_[1].is_periodic) continue;
        const double side = y < 0 ? 1 : -1;
        image[0] += side * cell.offset;
        image[1] += side * cell.lengths[1];
        y += y < 0 ? axes_[1].cells : -axes_[1].cells;
      }
      if (z < 0 || z >= axes_[2].cells) {
        if (!axes_[2].is_periodic) continue;
        image[2] += z < 0 ? cell.lengths[2] : -cell.lengths[2];
        z += z < 0 ? axes_[2].cells : -axes_[2].cells;
      }
      const auto see_near = [&](const Sphere& other, double shift) {
        double x = other.place[0] + shift - image[0];
        if (std::isnan(shift)) x = std::remainder(other.place[0] - image[0], period_);
        const double v = other.place[1] - image[1], w = other.place[2] - image[2];
        const double farthest = (1 + range / 2) * (sphere.radius + other.radius);
        if (x * x + v * v + w * w > SearchTuning::kSlack * farthest * farthest) return;
        if (dy != 0 || dz != 0 || other.number > sphere.number) see(other);
      };
      for_row(image[0] - reach, image[0] + reach, y, z, see_near);
    }
  }

 private:
  std::size_t index_of(const std::array<std::int64_t, 3>& at) const {
    return static_cast<std::size_t>((at[2] * axes_[1].cells + at[1]) * axes_[0].cells + at[0]);
  }
  /// Calls see(sphere, shift along x of the image); the shift is NaN if it is not known.
  template <class See>
  void for_row(double low, double high, std::int64_t y, std::int64_t z, const See& see) const {
    const auto& axis = axes_[0];
    std::int64_t first = axis.cell_of(low), last = axis.cell_of(high);
    bool has_all = false;
    if (!axis.is_periodic) {
      first = axis.clamped(first);
      last = axis.clamped(last);
    } else if (last - first >= axis.cells) {
      has_all = true;
      first = 0;
      last = axis.cells - 1;
    }
    for (std::int64_t c = first; c <= last;) {
      const std::int64_t x = ((c % axis.cells) + axis.cells) % axis.cells;
      // The cells up to the end of the row.
      const std::int64_t end = std::min(last - c + x + 1, axis.cells);
      const double shift = has_all ? std::numeric_limits<double>::quiet_NaN()
                                   : static_cast<double>((c - x) / axis.cells) * period_;
      const auto index = index_of({x, y, z});
      const auto stop = lists_.begin(index + static_cast<std::size_t>(end - x));
      for (std::size_t s = lists_.begin(index); s < stop; ++s) see(spheres_[s], shift);
      c += end - x;
    }
  }

  double period_ = 0;  // along x
  std::array<Axis, 3> axes_{};
  CellLists lists_;
  std::vector<Sphere> spheres_;  // in order of lists_
};

}  // namespace

double largest_distance(std::span<const double> radii, double range) {
  const double largest = radii.empty() ? 0 : *std::ranges::max_element(radii);
  return (2 + range) * largest;
}

std::vector<NearPair> near_pairs(const ShearedCell& cell, std::span<const double> positions,
                                 std::span<const double> radii, double range, ThreadPool* pool) {
  assert(positions.size() == 3 * radii.size());
  std::vector<NearPair> pairs;
  if (radii.empty()) return pairs;
  if (cell.lattice) return near_pairs_of_lattice(*cell.lattice, positions, radii, range, pool);
  const double reach = largest_distance(radii, range);
  const Grid grid(cell, positions, radii, reach);
  const auto try_pair = [&](std::size_t i, std::size_t j, std::vector<NearPair>& found) {
    const Vector apart = cell.nearest(particles::point_of(positions.data(), j, 3) -
                                      particles::point_of(positions.data(), i, 3));
    const double farthest = (1 + range / 2) * (radii[i] + radii[j]);
    if (dot(apart, apart) < farthest * farthest)
      found.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), apart});
  };
  if (!grid.meets_cells_once()) {
    for (std::size_t i = 0; i < radii.size(); ++i)
      for (std::size_t j = i + 1; j < radii.size(); ++j) try_pair(i, j, pairs);
    return pairs;
  }
  std::vector<std::vector<NearPair>> found((radii.size() - 1) / SearchTuning::kSpheres + 1);
  ThreadPool one(1);
  (pool ? *pool : one)
      .for_blocks(
          radii.size(),
          [&](std::size_t begin, std::size_t end) {
            auto& part = found[begin / SearchTuning::kSpheres];
            for (std::size_t s = begin; s < end; ++s) {
              const auto& sphere = grid.spheres()[s];
              grid.for_near(sphere, cell, reach, range, [&](const auto& other) {
                const auto [i, j] = std::minmax(sphere.number, other.number);
                try_pair(static_cast<std::size_t>(i), static_cast<std::size_t>(j), part);
              });
            }
          },
          SearchTuning::kSpheres);
  // In order of first, second.
  std::vector<std::size_t> next(radii.size() + 1, 0);
  for (const auto& part : found)
    for (const auto& pair : part) ++next[static_cast<std::size_t>(pair.first) + 1];
  for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
  pairs.resize(next.back());
  for (const auto& part : found)
    for (const auto& pair : part) pairs[next[static_cast<std::size_t>(pair.first)]++] = pair;
  std::size_t begin = 0;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const auto from = pairs.begin() + static_cast<std::ptrdiff_t>(begin);
    std::sort(from, pairs.begin() + static_cast<std::ptrdiff_t>(next[k]),
              [](const NearPair& a, const NearPair& b) { return a.second < b.second; });
    begin = next[k];
  }
  return pairs;
}

}  // namespace viscontact::suspensions
