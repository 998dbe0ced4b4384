// Describes a vector that is constant between given times, such as a force [M L/T^2] or the
// velocity of a plane [L/T]. Times [T] are in the unit of the case. Forces, planes, walls of a
// fluid and driven particles use it. Nothing is checked or thrown here; particles/case checks the
// order of the pieces. A change must keep integrals exact to rounding errors, and that the mean
// over times within one piece is the value of this piece to the last bit.
#pragma once

#include <vector>

#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// A vector as a list of pieces in order of time. The first piece begins at time 0, and each other
/// piece begins where the piece before it ends. The vector is 0 after the last piece.
struct PiecewiseConstant {
  /// A time until which the vector is constant, and the value that it has until then.
  struct Piece {
    double until;  ///< end of the piece [T], > 0 and later than the end of the piece before
    Vector value;  ///< value of the vector in the piece, in any unit
  };
  std::vector<Piece> pieces;  ///< the pieces; if there are none, the vector is 0 at all times

  /// Integral of the vector from time 0 to t [T], in the unit of the vector times that of time; 0
  /// if t <= 0.
  Vector integral(double t) const;
  /// Mean of the vector over the times from `from` to `to` [T], in its unit. It needs 0 <= from <
  /// to (not checked).
  Vector mean(double from, double to) const;
  /// Value of the vector at time t >= 0 [T]. At a time when two pieces meet, it is the value of the
  /// later piece.
  Vector value(double t) const;
  /// The first end of a piece after time t [T]; infinite if no piece ends after t.
  double next_end(double t) const;
};

}  // namespace viscontact::particles
