// Random lengths and medians for benchmarks over random rows.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "viscontact/common/splitmix.hpp"

namespace viscontact {

/// A random number between `from` and `to`, whose logarithm is uniformly distributed.
inline double log_uniform(SplitMix64& random, double from, double to) {
  assert(from > 0 && to > 0);
  return from * std::pow(to / from, random.unit());
}

/// Of an even number of values, the larger of the two in the middle.
inline double median(std::vector<double> values) {
  assert(!values.empty());
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace viscontact
