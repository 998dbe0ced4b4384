// Exact integrals and means.
#include "viscontact/particles/values/piecewise_constant.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

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
  assert(from <= to);
  assert(std::ranges::is_sorted(pieces, {}, &Piece::until));
  Vector sum{};
  double begin = 0;
  for (const auto& piece : pieces) {
    if (from >= begin && to <= piece.until)
      return piece.value;  // not a sum, which would have rounding errors
    const double overlap = std::min(to, piece.until) - std::max(from, begin);
    if (overlap > 0) sum = sum + overlap * piece.value;
    begin = piece.until;
  }
  return (1 / (to - from)) * sum;
}

Vector PiecewiseConstant::value(double t) const {
  const auto piece = std::ranges::upper_bound(pieces, t, {}, &Piece::until);
  return piece == pieces.end() ? Vector{} : piece->value;
}

double PiecewiseConstant::next_end(double t) const {
  const auto piece = std::ranges::upper_bound(pieces, t, {}, &Piece::until);
  return piece == pieces.end() ? std::numeric_limits<double>::infinity() : piece->until;
}

}  // namespace viscontact::particles
