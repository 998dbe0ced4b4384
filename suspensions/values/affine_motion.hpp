// How a linear flow u = G x carries points in a step.
#pragma once

#include <array>
#include <cstddef>

#include "viscontact/suspensions/values/matrix.hpp"
#include "viscontact/suspensions/values/stress.hpp"

namespace viscontact::suspensions {

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

/// The mean of exp(s G) x over 0 < s < t, so that exp(t G) x = x + t G (mean), and so that a point
/// that moves with the constant velocity v relative to the flow is displaced by t (mean of v).
inline Vector mean_carried(const Matrix& gradient, double t, const Vector& x) {
  Vector sum = x, term = x;
  for (int k = 1; k < 30 && norm(term) > 0; ++k) {
    term = (t / (k + 1)) * times(gradient, term);
    sum = sum + term;
  }
  return sum;
}

/// The matrix of carried() or mean_carried().
inline Matrix matrix_of(Vector (*map)(const Matrix&, double, const Vector&), const Matrix& gradient,
                        double t) {
  Matrix matrix{};
  for (std::size_t j = 0; j < 3; ++j) {
    Vector unit{};
    unit[j] = 1;
    const Vector column = map(gradient, t, unit);
    for (std::size_t i = 0; i < 3; ++i) matrix[i][j] = column[i];
  }
  return matrix;
}

/// The mean over 0 < s < t of the path exp(s G) x + s (mean of exp(. G) v over s).
inline Vector mean_path(const Matrix& gradient, double t, const Vector& x, const Vector& v) {
  Vector sum = mean_carried(gradient, t, x), term = (t / 2) * v;
  for (int k = 1; k < 30 && norm(term) > 0; ++k) {
    sum = sum + term;
    term = (t / (k + 2)) * times(gradient, term);
  }
  return sum;
}

}  // namespace viscontact::suspensions
