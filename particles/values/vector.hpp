// Vectors of up to three components. They are no Eigen::Vector3d, because each source would take a
// second longer to compile, and because a default Eigen vector is not zero.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "viscontact/common/index.hpp"

namespace viscontact::particles {

/// In two dimensions the third component is 0. For particles on an axis the first component is
/// along the axis, and the other two are 0.
using Vector = std::array<double, 3>;

inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
/// The product of two vectors in the plane of the first two axes is along the third axis.
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Euclidean length. It is infinite if the square of the length overflows (lengths above 1e154),
/// and 0 if the square underflows (lengths below 1e-162).
inline double norm(const Vector& a) { return std::sqrt(dot(a, a)); }

/// Vector k, counted from 0, of a flat array with `dimension` (1, 2 or 3) numbers for each vector.
/// Missing components are 0.
inline Vector point_of(const double* values, std::size_t k, int dimension) {
  assert(dimension >= 1 && dimension <= 3);
  const double* at = values + k * static_cast<std::size_t>(dimension);
  return {at[0], dimension > 1 ? at[1] : 0.0, dimension > 2 ? at[2] : 0.0};
}

}  // namespace viscontact::particles
