// The force that is not the fluid's: gravity, a push, a pull.
#pragma once

#include <vector>

namespace viscontact {

/// A force that is constant on intervals of time that follow each other from t = 0.
class ExternalForce {
 public:
  struct Piece {
    double until = 0;  ///< end of the piece [T]
    double value = 0;  ///< along the outward normal [M L/T^2]; negative: towards the plane
  };

  /// Pieces with increasing `until` > 0. Throws Error(kBadInput) otherwise, or if there is none.
  explicit ExternalForce(std::vector<Piece> pieces);

  /// f_ext(t); at a jump, the value after it. The last piece goes on for ever.
  double value(double time) const;

  /// int_0^t f_ext [M L/T], exact.
  double impulse(double time) const;

  /// Mean of f_ext over [from, to], from < to.
  double mean(double from, double to) const { return (impulse(to) - impulse(from)) / (to - from); }

  /// The times at which f_ext jumps, in increasing order.
  std::vector<double> jumps() const;

 private:
  std::vector<Piece> pieces_;
};

}  // namespace viscontact
