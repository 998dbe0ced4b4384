// Conditions that a number in an input must meet, each with the words for it in messages and in
// docs/case-file.md. The keys of cases, geometries and models and the readers of JSON (case_file/,
// freefem_axi/, lubrication/, reduced_model/, common/text/) use them. Numbers have any unit.
// Nothing is thrown: the reader throws for a number that is refused. A change of words changes
// messages and that page.
#pragma once

#include <string_view>

namespace viscontact {

/// A test of a number, and words that complete the sentence "it must be a number ...".
struct Allowed {
  bool (*test)(double value);  ///< true if the finite number `value` is allowed
  std::string_view words;      ///< such as "> 0"
};

/// A number greater than 0.
inline constexpr Allowed kPositive = {[](double v) { return v > 0; }, "> 0"};
/// A number that is 0 or greater.
inline constexpr Allowed kNotNegative = {[](double v) { return v >= 0; }, ">= 0"};
/// A positive or negative number.
inline constexpr Allowed kNotZero = {[](double v) { return v != 0; }, "different from 0"};
/// Any number. Readers of files refuse NaN and infinity before they ask.
inline constexpr Allowed kFinite = {[](double) { return true; }, "of finite value"};

}  // namespace viscontact
