// Vectors in the plane.
#pragma once

#include <array>
#include <cmath>

namespace viscontact::particles {

using Vector2 = std::array<double, 2>;

inline Vector2 operator+(const Vector2& a, const Vector2& b) { return {a[0] + b[0], a[1] + b[1]}; }
inline Vector2 operator-(const Vector2& a, const Vector2& b) { return {a[0] - b[0], a[1] - b[1]}; }
inline Vector2 operator-(const Vector2& a) { return {-a[0], -a[1]}; }
inline Vector2 operator*(double factor, const Vector2& a) { return {factor * a[0], factor * a[1]}; }

inline double dot(const Vector2& a, const Vector2& b) { return a[0] * b[0] + a[1] * b[1]; }
/// > 0 if `b` is counter-clockwise of `a`.
inline double cross(const Vector2& a, const Vector2& b) { return a[0] * b[1] - a[1] * b[0]; }
/// std::hypot takes ten times as long, and is better only for lengths beyond 1e150.
inline double norm(const Vector2& a) { return std::sqrt(dot(a, a)); }
/// The vector of length 1 along `a`, which is not 0.
inline Vector2 unit(const Vector2& a) { return (1 / norm(a)) * a; }
/// `a` after a quarter turn counter-clockwise.
inline Vector2 quarter_turn(const Vector2& a) { return {-a[1], a[0]}; }

/// The vector with the components `a` along `axis`, a unit vector, and its quarter turn.
inline Vector2 from_axes(const Vector2& axis, const Vector2& a) {
  return {axis[0] * a[0] - axis[1] * a[1], axis[1] * a[0] + axis[0] * a[1]};
}
/// The components of `a` along `axis`, a unit vector, and its quarter turn.
inline Vector2 along_axes(const Vector2& axis, const Vector2& a) {
  return {dot(axis, a), cross(axis, a)};
}

}  // namespace viscontact::particles
