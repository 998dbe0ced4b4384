// A vector that is constant between given times, such as a force [M L/T^2] or the velocity of a
// plane [L/T]. Times [T] are in the unit of the case. Forces, planes, walls of a fluid and driven
// particles are described by it. Nothing is checked or thrown here; particles/case checks the order
// of the pieces. A change must keep integrals exact to rounding errors.
#pragma once

#include <vector>

#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Pieces in order of time. The first piece begins at time 0, each other piece where the piece
/// before it ends. The value is 0 after the last piece.
struct PiecewiseConstant {
  /// A time until which the vector is constant, and the value that it has until then.
  struct Piece {
    double until;  ///< end of the piece [T], > 0 and > that of the piece before
    Vector value;  ///< in the unit of the vector
  };
  std::vector<Piece> pieces;  ///< empty: the vector is 0 at all times

  /// Integral from time 0 to t >= 0 [T], in the unit of the vector times that of time.
  Vector integral(double t) const;
  /// Mean over the times from `from` to `to` [T]; needs 0 <= from < to.
  Vector mean(double from, double to) const;
  /// Value at time t >= 0 [T]; where two pieces meet, that of the later one.
  Vector value(double t) const;
  /// The first end of a piece after time t [T]; infinite if no piece ends after t.
  double next_end(double t) const;
};

}  // namespace viscontact::particles
