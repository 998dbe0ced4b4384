#include "viscontact/suspensions/cell/cell_lists.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace viscontact::suspensions {

std::array<std::int64_t, 3> cells_along(const particles::Vector& lengths, double reach,
                                        std::size_t elements) {
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::ranges::sort(axes, {}, [&](std::size_t d) { return lengths[d]; });
  // The longer axes share what the shorter ones leave. Three cells are what a search needs along a
  // period.
  double left = std::max(27.0, static_cast<double>(elements));
  std::array<std::int64_t, 3> cells{};
  for (std::size_t k = 0; k < 3; ++k) {
    // Roots of whole numbers have rounding errors.
    const double most = std::floor(std::pow(left, 1.0 / static_cast<double>(3 - k)) * (1 + 1e-9));
    const double along = std::clamp(std::floor(lengths[axes[k]] / reach), 1.0, most);
    cells[axes[k]] = static_cast<std::int64_t>(along);
    left /= along;
  }
  return cells;
}

CellLists::CellLists(std::size_t cells, const std::vector<std::size_t>& cell_of_each)
    : begin_(cells + 1, 0), elements_(cell_of_each.size()) {
  for (const std::size_t cell : cell_of_each) {
    assert(cell < cells);
    ++begin_[cell + 1];
  }
  for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
  auto next = begin_;
  for (std::size_t k = 0; k < cell_of_each.size(); ++k)
    elements_[next[cell_of_each[k]]++] = static_cast<std::int32_t>(k);
}

}  // namespace viscontact::suspensions
