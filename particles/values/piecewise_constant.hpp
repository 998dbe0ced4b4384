// A vector that is constant between given times, such as a force or the velocity of a plane.
#pragma once

#include <vector>

#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// A vector as a list of pieces in order of time. The first piece begins at time 0, and each other
/// piece begins where the piece before it ends. The vector is 0 after the last piece.
struct PiecewiseConstant {
  struct Piece {
    double until;  ///< [T], > 0 and later than the end of the piece before
    Vector value;  ///< in any unit
  };
  std::vector<Piece> pieces;  ///< if there are none, the vector is 0 at all times

  /// Integral of the vector from time 0 to t [T], exact to rounding errors; 0 if t <= 0.
  Vector integral(double t) const;
  /// Mean of the vector over the times from `from` to `to` [T]. Within one piece it is the value of
  /// this piece to the last bit.
  Vector mean(double from, double to) const;
  /// Value at time t >= 0 [T]. At a time when two pieces meet, it is that of the later piece.
  Vector value(double t) const;
  /// The first end of a piece after time t [T]; infinite if no piece ends after t.
  double next_end(double t) const;
};

}  // namespace viscontact::particles
