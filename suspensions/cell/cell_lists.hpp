// The elements of each cell of a grid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/values/vector.hpp"

namespace viscontact::suspensions {

/// The numbers of cells along three axes of these `lengths` [L]. Each cell is at least `reach` [L]
/// wide, unless it is the only one of its axis. There are at most as many cells as the `elements`,
/// or 27, because more cells would only cost time and memory.
std::array<std::int64_t, 3> cells_along(const particles::Vector& lengths, double reach,
                                        std::size_t elements);

class CellLists {
 public:
  CellLists() = default;
  /// `cell_of_each` has the cell of each element, below `cells`.
  CellLists(std::size_t cells, const std::vector<std::size_t>& cell_of_each);

  /// The elements in order of cells, and those of one cell in ascending order.
  const std::vector<std::int32_t>& elements() const { return elements_; }
  /// The place in elements() of the first element of this cell or a later one.
  std::size_t begin(std::size_t cell) const { return begin_[cell]; }
  std::size_t end(std::size_t cell) const { return begin_[cell + 1]; }

 private:
  std::vector<std::size_t> begin_;
  std::vector<std::int32_t> elements_;
};

}  // namespace viscontact::suspensions
