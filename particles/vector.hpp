// Vectors of the plane or of space, and access to flat arrays of them, of any dimension and in any
// unit. All of particles/ uses them; nothing is checked or thrown. Eigen::Vector3d is not used,
// because each source that includes this file would take a second longer to compile, and because a
// default Eigen vector is not zero, as Vector{} is.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace viscontact::particles {

/// A vector with three components. In two dimensions the third component is 0; on an axis only the
/// first, along the axis, is not 0.
using Vector = std::array<double, 3>;

/// Inner product.
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// Sum.
inline Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
/// Difference.
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
/// Product of a number and a vector.
inline Vector operator*(double s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
/// Vector product. That of two vectors of the plane is along the third axis.
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Length. It is infinite if its square overflows.
inline double norm(const Vector& a) { return std::sqrt(dot(a, a)); }

/// Vector k of a flat array with `dimension` (1, 2 or 3) numbers for each vector.
inline Vector point_of(const double* values, std::size_t k, int dimension) {
  const double* at = values + k * static_cast<std::size_t>(dimension);
  return {at[0], dimension > 1 ? at[1] : 0.0, dimension > 2 ? at[2] : 0.0};
}

/// The larger of two numbers, or NaN if one of them is not a number.
inline double largest_or_nan(double a, double b) { return a != a || b <= a ? a : b; }

}  // namespace viscontact::particles
