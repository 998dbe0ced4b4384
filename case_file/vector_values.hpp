// Readers of vectors and of piecewise constant vectors, which several sections of a case of many
// particles share. Lengths, masses and times are in the units of the case.
#pragma once

#include <cmath>
#include <string_view>

#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/common/allowed.hpp"
#include "viscontact/particles/piecewise_constant.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::case_file {

/// Squares and cubes of numbers within this bound, and of their inverses, are finite and not 0.
inline constexpr double kLargestNumber = 1e100;
/// A number whose magnitude is within the bound.
inline constexpr Allowed kModerate = {[](double v) { return std::abs(v) <= kLargestNumber; },
                                      "at most 1e100 in magnitude"};
/// A number > 0 that is within the bound, and its inverse, too.
inline constexpr Allowed kModeratelyPositive = {
    [](double v) { return v >= 1 / kLargestNumber && v <= kLargestNumber; },
    "from 1e-100 to 1e100"};
/// The same, or 0.
inline constexpr Allowed kModeratelyPositiveOr0 = {
    [](double v) { return v == 0 || (v >= 1 / kLargestNumber && v <= kLargestNumber); },
    "0, or from 1e-100 to 1e100"};

/// Reads an array with one number for each dimension of space. In a case with dimension 1 a number
/// without brackets is read, too.
particles::Vector read_vector(const TomlSection& section, std::string_view key, int dimension);

/// Reads a constant vector, or pieces { until, value } that must last until `end_time` [T].
particles::PiecewiseConstant read_pieces(const TomlSection& section, std::string_view key,
                                         int dimension, double end_time);

/// Reads a constant number, or pieces { until, value } of numbers that must last until `end_time`
/// [T]. The number is component 2 of the vectors, as for a torque or an angular velocity of a disc.
particles::PiecewiseConstant read_pieces_of_numbers(const TomlSection& section,
                                                    std::string_view key, double end_time);

}  // namespace viscontact::case_file
