// Conditions on numbers in inputs, with the words for messages and docs/case-file.md.
#pragma once

#include <string_view>

namespace viscontact {

/// The words complete the sentence "it must be a number ...".
struct Allowed {
  bool (*test)(double value);  ///< of a finite number
  std::string_view words;      ///< such as "> 0"
};

inline constexpr Allowed kPositive = {[](double v) { return v > 0; }, "> 0"};
inline constexpr Allowed kNotNegative = {[](double v) { return v >= 0; }, ">= 0"};
inline constexpr Allowed kNotZero = {[](double v) { return v != 0; }, "different from 0"};
/// The test is always true, because readers of files refuse NaN and infinity before they call it.
inline constexpr Allowed kFinite = {[](double) { return true; }, "of finite value"};

}  // namespace viscontact
