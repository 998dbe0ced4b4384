// What blocks of a loop return to be put together by Team::sum_of_blocks.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace viscontact::particles {

/// The largest of the blocks' values; of none, -infinity.
struct Largest {
  double value = -std::numeric_limits<double>::infinity();
  Largest& operator+=(const Largest& other) {
    value = std::max(value, other.value);
    return *this;
  }
};

/// The blocks' lists one after the other.
template <class T>
struct Joined {
  std::vector<T> values;
  Joined& operator+=(const Joined& other) {
    values.insert(values.end(), other.values.begin(), other.values.end());
    return *this;
  }
};

}  // namespace viscontact::particles
