// A number that may be missing, as small as a number.
#pragma once

#include <cassert>
#include <cmath>
#include <limits>

namespace viscontact {

/// What std::optional<double> is for values that are never NaN, in the size of a double: rows of millions hold several.
class OptionalDouble {
 public:
  constexpr OptionalDouble() = default;
  constexpr OptionalDouble(double value)
      : value_(value) {}  // NOLINT(google-explicit-constructor): as std::optional

  bool has_value() const { return !std::isnan(value_); }
  explicit operator bool() const { return has_value(); }
  double operator*() const {
    assert(has_value());
    return value_;
  }
  double value() const { return **this; }

  /// Equal values, or both missing.
  friend bool operator==(const OptionalDouble& a, const OptionalDouble& b) {
    return a.value_ == b.value_ || (!a && !b);
  }

 private:
  double value_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace viscontact
