// Conditions that a number in an input must meet, each with the words for it in messages.
#pragma once

#include <string_view>

namespace viscontact {

/// A test of a number, and words that complete the sentence "it must be a number ...".
struct Allowed {
  bool (*test)(double value);
  std::string_view words;
};

inline constexpr Allowed kPositive = {[](double v) { return v > 0; }, "> 0"};
inline constexpr Allowed kNotNegative = {[](double v) { return v >= 0; }, ">= 0"};
inline constexpr Allowed kNotZero = {[](double v) { return v != 0; }, "different from 0"};
inline constexpr Allowed kFinite = {[](double) { return true; }, "of finite value"};

}  // namespace viscontact
