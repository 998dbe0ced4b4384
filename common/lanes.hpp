// Vectors of three components in one register of four numbers, of which the last is 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace viscontact {

using Lanes [[gnu::vector_size(32)]] = double;
// GCC's alignof(Lanes), by which memory is allocated, is less without AVX; its code for AVX, as in
// by_fastest_instructions(), takes this alignment for granted.
inline constexpr std::size_t kLaneAlignment = sizeof(Lanes);

// No function that returns Lanes is called from code for other processors.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"
inline double dot(const Lanes& a, const Lanes& b) {
  const Lanes c = a * b;
  return c[0] + c[1] + c[2];
}

inline Lanes cross(const Lanes& a, const Lanes& b) {
  return __builtin_shufflevector(a, a, 1, 2, 0, 3) * __builtin_shufflevector(b, b, 2, 0, 1, 3) -
         __builtin_shufflevector(a, a, 2, 0, 1, 3) * __builtin_shufflevector(b, b, 1, 2, 0, 3);
}

/// dot(a, b) in each component, which takes fewer instructions than to copy it to them.
inline Lanes dots(const Lanes& a, const Lanes& b) {
  const Lanes c = a * b;
  return c + __builtin_shufflevector(c, c, 1, 2, 0, 3) + __builtin_shufflevector(c, c, 2, 0, 1, 3);
}

/// Four numbers from any address.
inline Lanes four_at(const double* address) {
  Lanes four;
  std::memcpy(&four, address, sizeof four);
  return four;
}

/// The first three components.
inline Lanes first_three(const Lanes& a) {
  using Bits [[gnu::vector_size(sizeof(Lanes))]] = std::int64_t;
  return reinterpret_cast<Lanes>(reinterpret_cast<Bits>(a) & Bits{-1, -1, -1, 0});
}
#pragma GCC diagnostic pop

}  // namespace viscontact
