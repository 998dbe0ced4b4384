// Random numbers that are the same bits on every machine: SplitMix64 (Steele, Lea & Flood 2014).
// The distributions of the C++ library are not used, because libraries may define them differently.
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>

namespace viscontact {

/// A hash of one number: each bit of the result depends on all bits of x.
constexpr std::uint64_t splitmix_hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// The number in [0, 1) whose binary digits are the upper 53 of the 64 bits.
inline double unit_interval_of(std::uint64_t bits) {
  return std::ldexp(static_cast<double>(bits >> 11), -53);
}

/// Equal seeds give equal sequences, from which users repeat runs.
class SplitMix64 {
 public:
  /// Every seed is allowed, also 0.
  explicit SplitMix64(std::uint64_t seed) : state_(splitmix_hash(seed)) {}

  /// The next 64 random bits. Each function below makes its number from one call of next().
  std::uint64_t next() {
    const std::uint64_t bits = splitmix_hash(state_);
    state_ += 0x9e3779b97f4a7c15ULL;
    return bits;
  }

  /// A number in [0, 1).
  double unit() { return unit_interval_of(next()); }

  /// A uniformly distributed number in [from, to); rounding can give `to` itself.
  double between(double from, double to) {
    assert(from <= to);
    return from + (to - from) * unit();
  }

  /// A whole number in [0, count). The probabilities of two numbers differ by at most 1/2^64.
  std::uint64_t below(std::uint64_t count) {
    assert(count > 0);
    return next() % count;
  }

 private:
  std::uint64_t state_;
};

}  // namespace viscontact
