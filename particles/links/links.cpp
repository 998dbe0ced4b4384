// Lengths of arms as functions of time.
#include "viscontact/particles/links/links.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

namespace viscontact::particles {
namespace {

// About the largest number of times at which a length is checked.
constexpr std::size_t kMostTimes = 10000;

/// The linear piece that holds at a time, between two points (time, length).
struct Piece {
  std::array<double, 2> from, to;
  double rate() const { return (to[1] - from[1]) / (to[0] - from[0]); }
};

/// The piece that holds at `t`, which is moved by periods into the first one; at the time of a
/// point the next piece. Without a period, nothing before the first point, and from the last one
/// on.
std::optional<Piece> piece_at(const PiecewiseLinearLength& length, double& t) {
  assert(!length.points.empty());
  const auto& points = length.points;
  const double first = points.front()[0];
  if (length.period > 0) t -= length.period * std::floor((t - first) / length.period);
  const auto next = std::ranges::upper_bound(points, t, {}, [](const auto& p) { return p[0]; });
  if (next == points.begin() || (next == points.end() && !(length.period > 0))) return {};
  if (next == points.end()) return Piece{points.back(), {first + length.period, points.front()[1]}};
  return Piece{*(next - 1), *next};
}

double value_at(const PiecewiseLinearLength& length, double t) {
  const auto piece = piece_at(length, t);
  if (!piece)
    return (t < length.points.front()[0] ? length.points.front() : length.points.back())[1];
  const double share = (t - piece->from[0]) / (piece->to[0] - piece->from[0]);
  return (1 - share) * piece->from[1] + share * piece->to[1];
}

double value_at(const SinusoidalLength& length, double t) {
  return length.mean + length.amplitude * std::sin(length.angular_frequency * t + length.phase);
}

double rate_of(const PiecewiseLinearLength& length, double t) {
  const auto piece = piece_at(length, t);
  return piece ? piece->rate() : 0;
}

double rate_of(const SinusoidalLength& length, double t) {
  return length.amplitude * length.angular_frequency *
         std::cos(length.angular_frequency * t + length.phase);
}

/// Later periods are left out when there are more than kMostTimes times.
void add_times(const PiecewiseLinearLength& length, double end, std::vector<double>& times) {
  for (std::int64_t n = 0; static_cast<double>(n) * length.period <= end; ++n) {
    for (const auto& point : length.points) {
      const double time = point[0] + static_cast<double>(n) * length.period;
      if (time > 0 && time < end) times.push_back(time);
    }
    if (!(length.period > 0) || times.size() > kMostTimes) break;
  }
}

void add_times(const SinusoidalLength& length, double end, std::vector<double>& times) {
  // The times are an eighth of a period apart and include all extrema. Between two of them the
  // length differs from its chord by at most 8 percent of the amplitude.
  const double frequency = std::abs(length.angular_frequency);
  if (!(frequency > 0)) return;
  const double step = std::numbers::pi / 4 / frequency;
  const double phase = length.angular_frequency > 0 ? length.phase : -length.phase;
  const double first = std::ceil(phase / (std::numbers::pi / 4));
  for (double n = first; times.size() < kMostTimes; ++n) {
    const double time = n * step - phase / frequency;
    if (time >= end) break;
    if (time > 0) times.push_back(time);
  }
}

}  // namespace

double length_at(const ArmLength& length, double t) {
  return std::visit([&](const auto& of) { return value_at(of, t); }, length);
}

double rate_at(const ArmLength& length, double t) {
  return std::visit([&](const auto& of) { return rate_of(of, t); }, length);
}

std::vector<double> decisive_times(const ArmLength& length, double end) {
  assert(end >= 0);
  std::vector<double> times = {0};
  std::visit([&](const auto& of) { add_times(of, end, times); }, length);
  times.push_back(end);
  return times;
}

double least_length(const ArmLength& length, double end) {
  // All minima are at decisive_times().
  double least = std::numeric_limits<double>::infinity();
  for (const double time : decisive_times(length, end))
    least = std::min(least, length_at(length, time));
  return least;
}

}  // namespace viscontact::particles
