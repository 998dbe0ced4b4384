// Random numbers that are the same bits on every machine: SplitMix64 (Steele, Lea & Flood 2014,
// "Fast splittable pseudorandom number generators"). particles/, sweep/, swimmer/ and bench/ use
// them. The distributions of the C++ library are not used, because each library may define them
// differently. Numbers have no unit, but those of between() have the unit of its bounds. Nothing is
// checked or thrown. Further distributions may be added. A change must keep all numbers, because
// sweeps compare them with earlier results, and users repeat runs by their seeds.
#pragma once

#include <cmath>
#include <cstdint>

namespace viscontact {

/// A hash of one number: each bit of the result depends on all bits of x. The constants are those
/// of SplitMix64.
constexpr std::uint64_t splitmix_hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// The number in [0, 1) whose binary digits are the upper 53 of the 64 bits. All 2^53 values are
/// equally likely.
inline double unit_interval_of(std::uint64_t bits) {
  return std::ldexp(static_cast<double>(bits >> 11), -53);
}

/// A sequence of random numbers. Equal seeds give equal sequences.
class SplitMix64 {
 public:
  /// Starts the sequence of this seed. Every seed is allowed, also 0.
  explicit SplitMix64(std::uint64_t seed) : state_(splitmix_hash(seed)) {}

  /// The next 64 random bits. Each function below calls next() once and makes its number from these
  /// bits.
  std::uint64_t next() {
    const std::uint64_t bits = splitmix_hash(state_);
    state_ += 0x9e3779b97f4a7c15ULL;
    return bits;
  }

  /// A number in [0, 1).
  double unit() { return unit_interval_of(next()); }

  /// A number in [from, to) of a uniform distribution, in the unit of both. to - from must be
  /// finite and >= 0 (not checked). Rounding can give `to` itself.
  double between(double from, double to) { return from + (to - from) * unit(); }

  /// A whole number in [0, count). `count` must be > 0 (not checked: 0 divides by zero). The
  /// probabilities of two numbers differ by at most 1/2^64.
  std::uint64_t below(std::uint64_t count) { return next() % count; }

 private:
  std::uint64_t state_;
};

}  // namespace viscontact
