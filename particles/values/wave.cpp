// Exact means, and the path between the zeros of a wave.
#include "viscontact/particles/values/wave.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

namespace viscontact::particles {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// Of the largest magnitude: smaller values are rounding errors of the phase.
constexpr double kRounding = 1e-12;
// Of the largest magnitude: the rounding errors of a difference of paths in a million steps.
constexpr double kSamePath = 1e-9;

}  // namespace

double Wave::value(double t) const {
  const double found = mean + amplitude * std::sin(angular_frequency * t + phase);
  return std::abs(found) <= kRounding * largest() ? 0 : found;
}

double Wave::mean_over(double from, double to) const {
  assert(from < to);
  const double half = angular_frequency * (to - from) / 2;
  const double middle = angular_frequency * (from + (to - from) / 2) + phase;
  const double found = mean + amplitude * std::sin(middle) * (half > 0 ? std::sin(half) / half : 1);
  return std::abs(found) <= kRounding * largest() ? 0 : found;
}

double Wave::largest() const { return std::abs(mean) + std::abs(amplitude); }

double Wave::integral(double t) const {
  return mean * t - amplitude / angular_frequency * std::cos(angular_frequency * t + phase);
}

std::array<double, 2> Wave::zeros() const {
  assert(std::abs(mean) < std::abs(amplitude));
  const double rising = std::asin(-mean / amplitude), falling = std::numbers::pi - rising;
  const auto first_time = [&](double of_phase) {
    const double ahead = of_phase - phase;
    return (ahead - kTurn * std::floor(ahead / kTurn)) / angular_frequency;
  };
  std::array times{first_time(rising), first_time(falling)};
  std::ranges::sort(times);
  return times;
}

std::pair<double, double> Wave::integrals() const {
  if (mean == 0) {
    const double middle = amplitude / angular_frequency * std::cos(phase);
    const double size = std::abs(amplitude) / angular_frequency;
    return {middle - size, middle + size};
  }
  // Extremes at the later zeros are farther along the mean.
  double least = 0, largest = 0;
  if (std::abs(mean) < std::abs(amplitude))
    for (const double zero : zeros()) {
      const double sum = integral(zero) - integral(0);
      least = std::min(least, sum);
      largest = std::max(largest, sum);
    }
  (mean < 0 ? least : largest) = std::copysign(std::numeric_limits<double>::infinity(), mean);
  return {least, largest};
}

double Wave::mean_magnitude_over(double from, double to) const {
  const double net = std::abs(mean_over(from, to));
  const double all = (path_until(to) - path_until(from)) / (to - from);
  // Without a change of sign both are the same but for rounding errors, of which `net` has less.
  return all > net + kSamePath * largest() ? all : net;
}

double Wave::path_until(double t) const {
  assert(angular_frequency > 0 && t >= 0);
  if (std::abs(mean) >= std::abs(amplitude)) return std::abs(integral(t) - integral(0));
  const double period = kTurn / angular_frequency, periods = std::floor(t / period);
  const auto changes = zeros();
  const auto within = [&](double rest) {
    double sum = 0, before = 0;
    for (const double zero : {changes[0], changes[1], rest}) {
      const double until = std::min(zero, rest);
      sum += std::abs(integral(until) - integral(before));
      before = until;
    }
    return sum;
  };
  return (periods > 0 ? periods * within(period) : 0) + within(t - periods * period);
}

double Wave::time_of_path(double path) const {
  assert(path >= 0 && largest() > 0);
  const double period = kTurn / angular_frequency;
  const double periods = std::floor(path / path_until(period));
  double low = periods * period, high = low + period;
  for (int k = 0; k < 200; ++k) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) break;
    (path_until(middle) < path ? low : high) = middle;
  }
  return high;
}

}  // namespace viscontact::particles
