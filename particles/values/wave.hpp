// A number that oscillates, such as the rate of a shear flow.
#pragma once

#include <array>
#include <utility>

namespace viscontact::particles {

/// mean + amplitude sin(angular_frequency t + phase) at the time t.
struct Wave {
  double mean = 0, amplitude = 0;  ///< in any unit
  double angular_frequency = 0;    ///< [1/T], > 0
  double phase = 0;                ///< [rad]

  double value(double t) const;
  /// The mean over the times between `from` and `to` > `from` [T]. Exactly 0 where only rounding
  /// errors are left.
  double mean_over(double from, double to) const;
  /// The integral of the magnitude over the times from 0 to t >= 0 [T].
  double path_until(double t) const;
  /// The mean of the magnitude, likewise, for `from` >= 0: that of mean_over() if the sign does not
  /// change.
  double mean_magnitude_over(double from, double to) const;
  /// The least and the largest integral from 0 to any time >= 0. One of them is infinite unless the
  /// mean is 0.
  std::pair<double, double> integrals() const;
  /// The time [T] at which path_until() is `path` >= 0, to rounding errors. The wave is not 0.
  double time_of_path(double path) const;
  double largest() const;  ///< magnitude

 private:
  double integral(double t) const;
  /// The times in the first period, not before 0, at which the sign changes, increasing [T]. The
  /// amplitude is greater than the mean.
  std::array<double, 2> zeros() const;
};

}  // namespace viscontact::particles
