// Due times are the same on every machine: compiled with -ffp-contract=off.
#include "viscontact/particles/setting/source.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace viscontact::particles {

std::size_t Source::due(double time) const {
  assert(rate > 0);
  // A particle counts as due although `time` is too early by a rounding error. A billionth is far
  // above rounding errors, and far below the time between two particles.
  constexpr double kRounding = 1e-9;
  const double past = std::min(time, end) - begin;
  if (past < -kRounding * begin) return 0;
  const double count = std::floor(rate * past * (1 + kRounding) + kRounding) + 1;
  return count < static_cast<double>(largest_count) ? static_cast<std::size_t>(std::max(count, 0.0))
                                                    : largest_count;
}

}  // namespace viscontact::particles
