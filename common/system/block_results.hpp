// What blocks of a loop return to be put together by ThreadPool::sum_of_blocks.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace viscontact {

/// The largest of the blocks' values; of none, -infinity.
struct MaximumOfBlocks {
  double value = -std::numeric_limits<double>::infinity();
  MaximumOfBlocks& operator+=(const MaximumOfBlocks& other) {
    value = std::max(value, other.value);
    return *this;
  }
};

/// The blocks' lists one after the other.
template <class T>
struct ConcatenatedBlocks {
  std::vector<T> values;
  ConcatenatedBlocks& operator+=(const ConcatenatedBlocks& other) {
    values.insert(values.end(), other.values.begin(), other.values.end());
    return *this;
  }
};

}  // namespace viscontact
