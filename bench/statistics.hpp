// Random lengths and medians for benchmarks over random rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "viscontact/common/splitmix.hpp"

namespace viscontact {

/// A number between `from` and `to`, both > 0, of which the logarithm is uniform.
inline double log_uniform(SplitMix64& random, double from, double to) {
  return from * std::pow(to / from, random.unit());
}

/// The median of at least one value; of an even number, the larger of the two in the middle.
inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace viscontact
