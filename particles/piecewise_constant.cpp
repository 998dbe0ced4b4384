// Exact integrals and means of a piecewise constant vector. The vector may have any unit; times [T]
// are >= 0 in the unit of the case, and ends of pieces increase. The vector is 0 after the last
// piece. mean() needs from < to, because it divides by the difference. Nothing is checked or
// thrown. A change must keep that the mean over times within one piece is the value of the piece to
// the last bit. Used by all of particles/.
#include "viscontact/particles/piecewise_constant.hpp"

#include <algorithm>
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

/// Infinite if no piece ends after `t`.
double PiecewiseConstant::next_end(double t) const {
  const auto piece = std::ranges::upper_bound(pieces, t, {}, &Piece::until);
  return piece == pieces.end() ? std::numeric_limits<double>::infinity() : piece->until;
}

}  // namespace viscontact::particles
