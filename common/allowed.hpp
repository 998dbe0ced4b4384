// Conditions that a number in an input must meet, each with the words for it in messages and in
// docs/case-file.md. case_file/, freefem_axi/, lubrication/, reduced_model/ and common/text/ use
// them for the keys of cases, geometries, models and JSON files. Numbers have any unit. Nothing is
// thrown here: the code that reads a number throws if its test is false. Further conditions may be
// added. A change of a test refuses or accepts other files of users; a change of words changes
// messages and docs/case-file.md.
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
/// A number that is greater or less than 0.
inline constexpr Allowed kNotZero = {[](double v) { return v != 0; }, "different from 0"};
/// Any finite number: the test is always true, because readers of files refuse NaN and infinity
/// before they call it.
inline constexpr Allowed kFinite = {[](double) { return true; }, "of finite value"};

}  // namespace viscontact
