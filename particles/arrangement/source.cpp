// When particles of a source are due (source.hpp). Times are in the unit of the case; nothing is
// thrown. A change must keep the times, which decide the steps in which particles come.
#include "viscontact/particles/arrangement/source.hpp"

#include <algorithm>
#include <cmath>

namespace viscontact::particles {

std::size_t Source::due(double time) const {
  // Rounding errors may make a time slightly too early; a particle counts as due then, too.
  constexpr double kRounding = 1e-9;
  const double past = std::min(time, end) - begin;
  if (past < -kRounding * begin) return 0;
  const double count = std::floor(rate * past * (1 + kRounding) + kRounding) + 1;
  return count < static_cast<double>(largest_count) ? static_cast<std::size_t>(std::max(count, 0.0))
                                                    : largest_count;
}

}  // namespace viscontact::particles
