// Legendre polynomials by recurrence, and the quadrature that has its nodes at their zeros.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace viscontact {

/// The Legendre polynomials P_n and P_{n-1} and the derivatives P_n' and P_{n-1}' at x, for n = 1;
/// each advance() raises n by 1. The relative error is that of rounding, except near zeros.
struct Legendre {
  long double x, n = 1, p = x, derivative = 1, p_before = 1, derivative_before = 0;

  explicit Legendre(long double argument) : x(argument) {}
  void advance() {
    const long double p_next = ((2 * n + 1) * x * p - n * p_before) / (n + 1);
    const long double derivative_next = derivative_before + (2 * n + 1) * p;
    p_before = p;
    derivative_before = derivative;
    p = p_next;
    derivative = derivative_next;
    n += 1;
  }
};

struct QuadratureNode {
  long double x, weight;
};

/// Nodes and weights of the quadrature on [-1, 1], which is exact for polynomials of degree 2 count
/// - 1.
inline std::vector<QuadratureNode> gauss_legendre(int count) {
  std::vector<QuadratureNode> nodes;
  for (int i = 0; i < count; ++i) {
    long double x = std::cos(std::numbers::pi_v<long double> * (i + 0.75L) / (count + 0.5L));
    long double derivative = 0;
    // The first guess has at least 4 digits, and each step of Newton's method doubles their number.
    // The last step makes the derivative as precise as the zero.
    for (int iteration = 0; iteration < 5; ++iteration) {
      Legendre legendre(x);
      while (legendre.n < count) legendre.advance();
      derivative = count * (legendre.p_before - x * legendre.p) / (1 - x * x);
      x -= legendre.p / derivative;
    }
    nodes.push_back({x, 2 / ((1 - x * x) * derivative * derivative)});
  }
  return nodes;
}

}  // namespace viscontact
