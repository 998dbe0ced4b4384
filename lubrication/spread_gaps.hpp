// Sample points for functions of the gap, at which fits are checked and exported. Nothing is
// thrown. The default of 201 points is also stated in the help of `export` and in
// docs/file-formats.md. Used by fitting/, lubrication_force.cpp and motions/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace viscontact::lubrication {

/// `count` >= 2 gaps [L] in geometric progression on `interval`, 0 < first < second. The first and
/// the last gap are exactly its ends.
inline std::vector<double> spread_gaps(const std::array<double, 2>& interval, int count = 201) {
  const double low = std::log(interval[0]);
  const double high = std::log(interval[1]);
  std::vector<double> gaps;
  for (int i = 0; i < count; ++i)
    gaps.push_back(std::clamp(std::exp(std::lerp(low, high, static_cast<double>(i) / (count - 1))),
                              interval[0], interval[1]));
  gaps.front() = interval[0];
  gaps.back() = interval[1];
  return gaps;
}

}  // namespace viscontact::lubrication
