// How a linear flow u = G x carries points in a step.
#pragma once

#include <array>
#include <cstddef>

#include "viscontact/suspensions/stress.hpp"

namespace viscontact::suspensions {

using Matrix = std::array<Vector, 3>;

/// exp(t G) x.
inline Vector carried(const Matrix& gradient, double t, const Vector& x) {
  Vector sum = x, term = x;
  // Steps are short against 1/G, so that the terms fall fast; in simple shear the third is 0.
  for (int k = 1; k < 30 && norm(term) > 0; ++k) {
    term = (t / k) * times(gradient, term);
    sum = sum + term;
  }
  return sum;
}

/// The mean of exp(s G) x over 0 < s < t, so that exp(t G) x = x + t G (mean).
inline Vector mean_carried(const Matrix& gradient, double t, const Vector& x) {
  Vector sum = x, term = x;
  for (int k = 1; k < 30 && norm(term) > 0; ++k) {
    term = (t / (k + 1)) * times(gradient, term);
    sum = sum + term;
  }
  return sum;
}

}  // namespace viscontact::suspensions
