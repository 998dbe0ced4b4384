// An arm is a link that holds the distance between the centres of two particles at a given length.
// This file has its length as a function of time. Lengths [L] and times [T] are in the units of the
// case. particles/case checks the values, also that the length is > 0 at all times; links.hpp and
// link_rows.cpp use the functions, and a change must keep rate_at() the derivative of length_at().
#pragma once

#include <array>
#include <variant>
#include <vector>

namespace viscontact::particles {

/// Linear between points. Before the first point and after the last one the length is that of the
/// point, unless there is a period.
struct PiecewiseLinearLength {
  std::vector<std::array<double, 2>>
      points;  ///< (time [T], length [L]), one at least; times increase
  /// Period [T], > the last time - the first time; between the last point and the first point of
  /// the next period the length is linear, too. 0: not periodic.
  double period = 0;
};

/// The length mean + amplitude sin(angular_frequency t + phase) at the time t.
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

/// Rate at which the length grows at time `t` >= 0 [L/T]; at a point that of the next piece.
double rate_at(const ArmLength& length, double t);

/// Least length at times from 0 to `end` >= 0 [T].
double least_length(const ArmLength& length, double end);

/// Times from 0 to `end` [T] between which the length is linear, or which sample it finely enough
/// to see where it is shortest and longest: 0, points, extrema and `end`; at most about 1e4 of
/// them. The checks of a case use them.
std::vector<double> decisive_times(const ArmLength& length, double end);

}  // namespace viscontact::particles
