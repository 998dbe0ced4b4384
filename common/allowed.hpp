// What a number of a user's may be, and how to say so.
#pragma once

#include <string_view>

namespace viscontact {

struct Allowed {
  bool (*test)(double value);
  std::string_view words;
};

inline constexpr Allowed kPositive = {[](double v) { return v > 0; }, "> 0"};
inline constexpr Allowed kNotNegative = {[](double v) { return v >= 0; }, ">= 0"};
inline constexpr Allowed kNotZero = {[](double v) { return v != 0; }, "different from 0"};
inline constexpr Allowed kFinite = {[](double) { return true; }, "of finite value"};

}  // namespace viscontact
