#include "viscontact/particles/piecewise_constant.hpp"

#include <algorithm>

namespace viscontact::particles {

Vector PiecewiseConstant::integral(double t) const {
  Vector sum{};
  double from = 0;
  for (const auto& piece : pieces) {
    if (t <= from) break;
    sum = sum + (std::min(t, piece.until) - from) * piece.value;
    from = piece.until;
  }
  return sum;
}

Vector PiecewiseConstant::mean(double from, double to) const {
  Vector sum{};
  double begin = 0;
  for (const auto& piece : pieces) {
    if (from >= begin && to <= piece.until)
      return piece.value;  // no rounding where nothing changes
    const double overlap = std::min(to, piece.until) - std::max(from, begin);
    if (overlap > 0) sum = sum + overlap * piece.value;
    begin = piece.until;
  }
  return (1 / (to - from)) * sum;
}

}  // namespace viscontact::particles
