// A vector that is constant between given times: a force, or the velocity of a wall.
#pragma once

#include <vector>

#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Pieces in order of time; the first begins at 0, each other where the one before ends. Beyond the last: 0.
struct PiecewiseConstant {
  struct Piece {
    double until;  ///< [T], > that of the piece before
    Vector value;
  };
  std::vector<Piece> pieces;

  /// The integral from time 0 to t >= 0.
  Vector integral(double t) const;
  /// The mean over [from, to], from < to.
  Vector mean(double from, double to) const;
};

}  // namespace viscontact::particles
