// Random lengths and medians for benchmarks over random rows. Numbers have any dimension; nothing
// is checked or thrown. The benchmarks of this folder use it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "viscontact/common/splitmix.hpp"

namespace viscontact {

/// A random number between `from` and `to`, both > 0, whose logarithm is uniformly distributed.
inline double log_uniform(SplitMix64& random, double from, double to) {
  return from * std::pow(to / from, random.unit());
}

/// The median of at least one value; of an even number, the larger of the two in the middle.
inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace viscontact
