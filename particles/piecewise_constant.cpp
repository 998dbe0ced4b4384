// Computes exact integrals and means of a vector that is piecewise constant in time. The vector may
// have any unit; times [T] are >= 0 in the unit of the case. The first piece begins at the time 0,
// and each other piece begins where the one before it ends (`until`); the ends must increase. The
// vector is 0 after the last piece, and everywhere if there are no pieces. Nothing is checked or
// thrown. A change must keep that the mean over times within one piece is the value of the piece to
// the last bit. All of particles/ uses this file.
#include "viscontact/particles/piecewise_constant.hpp"

#include <algorithm>
#include <limits>

namespace viscontact::particles {

/// The integral from 0 to `t` [T], in the unit of the vector times that of time; 0 if t <= 0.
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

/// The mean over the times from `from` to `to` [T], in the unit of the vector. It needs from < to,
/// because it divides by the difference (not checked).
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

/// The value at the time `t` [T]; where two pieces meet, that of the later piece.
Vector PiecewiseConstant::value(double t) const {
  const auto piece = std::ranges::upper_bound(pieces, t, {}, &Piece::until);
  return piece == pieces.end() ? Vector{} : piece->value;
}

/// The first end of a piece that is later than `t` [T]; infinite if no piece ends after `t`.
double PiecewiseConstant::next_end(double t) const {
  const auto piece = std::ranges::upper_bound(pieces, t, {}, &Piece::until);
  return piece == pieces.end() ? std::numeric_limits<double>::infinity() : piece->until;
}

}  // namespace viscontact::particles
