// Polynomials c0 + c1 tau + c2 tau^2 + ..., given by at least one coefficient c0, c1, ... If tau
// has the unit U and the values have the unit V, then c_k has the unit V/U^k.
#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

#include "viscontact/common/root_finding.hpp"

namespace viscontact::reduced_model::polynomial {

/// The sum of weighted(c_k, k) tau^(k - first) for k >= first. Another order of operations changes
/// the last digits of trajectories.
template <class Weighted>
double horner(std::span<const double> coefficients, double tau, std::size_t first,
              const Weighted& weighted) {
  double sum = 0;
  for (std::size_t k = coefficients.size(); k-- > first;)
    sum = sum * tau + weighted(coefficients[k], static_cast<double>(k));
  return sum;
}

/// Value of the polynomial at tau [V].
inline double value(std::span<const double> coefficients, double tau) {
  return horner(coefficients, tau, 0, [](double c, double) { return c; });
}

/// Value of the derivative at tau [V/U].
inline double slope(std::span<const double> coefficients, double tau) {
  return horner(coefficients, tau, 1, [](double c, double k) { return k * c; });
}

/// int_0^tau of the polynomial [V U].
inline double integral(std::span<const double> coefficients, double tau) {
  return horner(coefficients, tau, 0, [](double c, double k) { return c / (k + 1); }) * tau;
}

/// int_0^tau int_0^s of the polynomial [V U^2].
inline double double_integral(std::span<const double> coefficients, double tau) {
  return horner(coefficients, tau, 0, [](double c, double k) { return c / ((k + 1) * (k + 2)); }) *
         tau * tau;
}

/// Mean [V] of the polynomial over [a, b], 0 <= a < b [U]. The quotient (b^{k+1} - a^{k+1})/(b - a)
/// is computed as a sum of products, so that a short interval loses no digits.
inline double mean(std::span<const double> coefficients, double a, double b) {
  double mean = 0;
  double sum = 1;    // sum of b^i a^(k-i), i = 0..k
  double power = 1;  // a^k
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    mean += coefficients[k] / static_cast<double>(k + 1) * sum;
    power *= a;
    sum = sum * b + power;
  }
  return mean;
}

/// The same polynomial about another point: p(tau + shift) in powers of tau, of the same degree.
inline std::vector<double> shifted(std::vector<double> coefficients, double shift) {
  if (shift == 0) return coefficients;
  for (std::size_t i = 0; i + 1 < coefficients.size(); ++i)  // repeated Horner scheme
    for (std::size_t k = coefficients.size() - 1; k-- > i;)
      coefficients[k] += shift * coefficients[k + 1];
  return coefficients;
}

/// The points [U] in (0, length), in increasing order, at which the derivative changes its sign,
/// and some of the points at which the derivative only touches 0. The polynomial is monotone
/// between two neighbouring points.
inline std::vector<double> turning_points(const std::vector<double>& coefficients, double length) {
  if (coefficients.size() < 3) return {};
  std::vector<double> derivative;
  for (std::size_t k = 1; k < coefficients.size(); ++k)
    derivative.push_back(static_cast<double>(k) * coefficients[k]);
  std::vector<double> stops = {0};
  std::ranges::copy(turning_points(derivative, length), std::back_inserter(stops));
  stops.push_back(length);
  std::vector<double> turns;
  for (std::size_t n = 1; n < stops.size(); ++n) {
    const double before = value(derivative, stops[n - 1]), after = value(derivative, stops[n]);
    if (before * after < 0)
      turns.push_back(bisect_first_true(stops[n - 1], stops[n], [&](double tau) {
        return (value(derivative, tau) > 0) == (after > 0);
      }));
    else if (after == 0 && n + 1 < stops.size())
      turns.push_back(stops[n]);
  }
  return turns;
}

}  // namespace viscontact::reduced_model::polynomial
