// Vectors of three components in one register of four numbers, of which the last is 0.
#pragma once

#include <cstddef>

#include "viscontact/particles/values/vector.hpp"

namespace viscontact::suspensions {

using particles::dot;
using particles::norm;
using particles::Vector;
using particles::operator+;
using particles::operator-;
using particles::operator*;

using Lanes [[gnu::vector_size(32)]] = double;
// GCC's alignof(Lanes), by which memory is allocated, is less without AVX; its code for AVX takes
// this alignment for granted.
inline constexpr std::size_t kLaneAlignment = sizeof(Lanes);

inline double dot(const Lanes& a, const Lanes& b) {
  const Lanes c = a * b;
  return c[0] + c[1] + c[2];
}

inline Lanes cross(const Lanes& a, const Lanes& b) {
  return __builtin_shufflevector(a, a, 1, 2, 0, 3) * __builtin_shufflevector(b, b, 2, 0, 1, 3) -
         __builtin_shufflevector(a, a, 2, 0, 1, 3) * __builtin_shufflevector(b, b, 1, 2, 0, 3);
}

inline Lanes lanes_of(const Vector& a) { return Lanes{a[0], a[1], a[2], 0}; }
inline Vector vector_of(const Lanes& a) { return {a[0], a[1], a[2]}; }

/// The velocity [L/T] and angular velocity [1/T] of a sphere, or the force [M L/T^2] and torque
/// [M L^2/T^2] on it.
struct alignas(kLaneAlignment) Motion {
  Lanes along{};
  Lanes turn{};
};

}  // namespace viscontact::suspensions
