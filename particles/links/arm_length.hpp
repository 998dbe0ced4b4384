// The length of an arm as a function of time. Lengths and times are in the units of the case.
#pragma once

#include <array>
#include <variant>
#include <vector>

namespace viscontact::particles {

/// Linear between points (time, length). Before the first point and after the last one the length
/// is that of the point, unless there is a period.
struct PiecewiseLinearLength {
  std::vector<std::array<double, 2>> points;  ///< times increasing, at least one
  /// Period [T], > the last time - the first time; between the last point and the first point of
  /// the next period the length is linear, too. 0: not periodic.
  double period = 0;
};

/// mean + amplitude sin(angular_frequency t + phase).
struct SinusoidalLength {
  double mean = 0,               ///< [L]
      amplitude = 0;             ///< [L]
  double angular_frequency = 0,  ///< [1/T]
      phase = 0;                 ///< [rad]
};

/// Length of an arm as a function of time.
using ArmLength = std::variant<PiecewiseLinearLength, SinusoidalLength>;

/// Length at time `t` >= 0 [T].
double length_at(const ArmLength& length, double t);

/// Rate at which the length grows at time `t` >= 0, at a corner that of the piece that begins there
/// [L/T].
double rate_at(const ArmLength& length, double t);

/// Least length at times from 0 to `end` >= 0 [T].
double least_length(const ArmLength& length, double end);

/// Times from 0 to `end` [T] between which the length is linear, or which sample it finely enough to
/// see where it is shortest and longest: 0, corners, extrema and `end`; at most about 1e4 of them.
std::vector<double> decisive_times(const ArmLength& length, double end);

}  // namespace viscontact::particles
