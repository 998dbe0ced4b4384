// Symmetric tensors: strain rates and stresses.
#pragma once

#include <array>
#include <cstddef>

#include "viscontact/suspensions/values/lanes.hpp"

namespace viscontact::suspensions {

/// Components xx, yy, zz, yz, xz, xy.
struct SymmetricTensor {
  std::array<double, 6> components{};

  double operator()(std::size_t i, std::size_t j) const {
    return components[i == j ? i : 6 - i - j];
  }
  Vector times(const Vector& a) const {
    Vector result{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) result[i] += (*this)(i, j) * a[j];
    return result;
  }
  double trace() const { return components[0] + components[1] + components[2]; }
  /// The inner product, which counts components off the diagonal twice.
  double contracted(const SymmetricTensor& other) const {
    double sum = 0;
    for (std::size_t c = 0; c < 6; ++c)
      sum += (c < 3 ? 1 : 2) * components[c] * other.components[c];
    return sum;
  }
  /// Adds `factor` times the symmetric part of the dyad of two vectors.
  void add_dyad(double factor, const Vector& a, const Vector& b) {
    for (std::size_t i = 0; i < 3; ++i) components[i] += factor * a[i] * b[i];
    components[3] += factor * (a[1] * b[2] + a[2] * b[1]) / 2;
    components[4] += factor * (a[0] * b[2] + a[2] * b[0]) / 2;
    components[5] += factor * (a[0] * b[1] + a[1] * b[0]) / 2;
  }
  void add_isotropic(double value) {
    for (std::size_t i = 0; i < 3; ++i) components[i] += value;
  }
  void add(double factor, const SymmetricTensor& other) {
    for (std::size_t c = 0; c < 6; ++c) components[c] += factor * other.components[c];
  }
};

/// The symmetric part of a gradient.
inline SymmetricTensor strain_rate_of(const std::array<Vector, 3>& gradient) {
  SymmetricTensor strain;
  for (std::size_t i = 0; i < 3; ++i) {
    Vector unit{};
    unit[i] = 1;
    strain.add_dyad(1, unit, gradient[i]);
  }
  return strain;
}

/// Half of the curl: the angular velocity of the flow.
inline Vector rotation_of(const std::array<Vector, 3>& g) {
  return {(g[2][1] - g[1][2]) / 2, (g[0][2] - g[2][0]) / 2, (g[1][0] - g[0][1]) / 2};
}

inline Vector times(const std::array<Vector, 3>& g, const Vector& x) {
  return {dot(g[0], x), dot(g[1], x), dot(g[2], x)};
}

}  // namespace viscontact::suspensions
