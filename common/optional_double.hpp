// A number that may be missing. It takes no more memory than a double, which a change must keep,
// because the rows of trajectories contain such numbers.
#pragma once

#include <cassert>
#include <cmath>
#include <limits>

namespace viscontact {

/// Like std::optional<double>, but no larger than a double, because millions of rows store several
/// of these values. NaN stands for a missing value; therefore a value must not be NaN, and sources
/// that include this file must not be compiled with -ffast-math, which ignores NaN.
class OptionalDouble {
 public:
  constexpr OptionalDouble() = default;
  /// `value` must not be NaN, because NaN stands for a missing value.
  // The conversion is implicit, as in std::optional.
  // NOLINTNEXTLINE(google-explicit-constructor)
  constexpr OptionalDouble(double value) : value_(value) {}

  bool has_value() const { return !std::isnan(value_); }  ///< false if the value is missing
  explicit operator bool() const { return has_value(); }  ///< same as has_value()
  /// The value, which must not be missing (asserted).
  double operator*() const {
    assert(has_value());
    return value_;
  }
  double value() const { return **this; }  ///< same as operator*

  /// True if both values are equal or both are missing.
  friend bool operator==(const OptionalDouble& a, const OptionalDouble& b) {
    return a.value_ == b.value_ || (!a && !b);
  }

 private:
  double value_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace viscontact
