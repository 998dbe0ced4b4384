// Results of the blocks of a loop, combined by += in ThreadPool::sum_of_blocks.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace viscontact {

/// The largest of the values of all blocks; minus infinity if there are none.
struct MaximumOfBlocks {
  double value = -std::numeric_limits<double>::infinity();
  MaximumOfBlocks& operator+=(const MaximumOfBlocks& other) {
    value = std::max(value, other.value);
    return *this;
  }
};

/// The lists of all blocks, one after the other.
template <class T>
struct ConcatenatedBlocks {
  std::vector<T> values;
  ConcatenatedBlocks& operator+=(const ConcatenatedBlocks& other) {
    values.insert(values.end(), other.values.begin(), other.values.end());
    return *this;
  }
};

}  // namespace viscontact
