// Random numbers that are the same in each run of a test.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace viscontact {

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double uniform(double from, double to) {
    return std::uniform_real_distribution(from, to)(generator_);
  }
  /// 10^x with x uniform in [from, to].
  double decades(double from, double to) { return std::pow(10, uniform(from, to)); }
  int integer(int from, int to) { return std::uniform_int_distribution(from, to)(generator_); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  /// A random unit vector, uniform over all directions.
  std::array<double, 3> direction(int dimension) {
    std::normal_distribution<double> normal;
    for (;;) {
      const std::array v{normal(generator_), normal(generator_),
                         dimension == 3 ? normal(generator_) : 0.0};
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      if (length > 0.1) return {1 / length * v[0], 1 / length * v[1], 1 / length * v[2]};
    }
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace viscontact
