// Readers of vectors and of piecewise constant vectors, and keys with such values, for the sections
// of a case of many particles. Lengths, masses and times are in the units of the case. A wrong
// value is an Error(kBadInput) with its line. A change must keep accepting users' cases.
#pragma once

#include <cmath>
#include <string_view>

#include "viscontact/case_file/keys.hpp"
#include "viscontact/particles/piecewise_constant.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Bound of the magnitude of all numbers. Squares and cubes of numbers within it, and of their
/// inverses, are finite and not 0 in double precision (largest 1.8e308).
inline constexpr double kLargestNumber = 1e100;
/// A number whose magnitude is within the bound.
inline constexpr Allowed kModerate = {[](double v) { return std::abs(v) <= kLargestNumber; },
                                      "at most 1e100 in magnitude"};
/// A number > 0 for which the number and its inverse are within the bound.
inline constexpr Allowed kModeratelyPositive = {
    [](double v) { return v >= 1 / kLargestNumber && v <= kLargestNumber; },
    "from 1e-100 to 1e100"};
/// 0, or a number that kModeratelyPositive allows.
inline constexpr Allowed kModeratelyPositiveOr0 = {
    [](double v) { return v == 0 || (v >= 1 / kLargestNumber && v <= kLargestNumber); },
    "0, or from 1e-100 to 1e100"};

/// Reads an array with one number for each dimension of space. In a case with dimension 1 a number
/// without brackets is read, too.
void read_vector(const case_file::TomlSection& section, std::string_view key, Vector& place,
                 int dimension);

// Values of keys (keys.hpp). They refer to their arguments.

/// A vector, read by read_vector().
case_file::KeyValue vector(Vector& place, const int& dimension);
/// A constant vector, or pieces { until, value } that must last until `end_time` [T].
case_file::KeyValue pieces(PiecewiseConstant& place, const int& dimension, const double& end_time);
/// A torque or an angular velocity: for discs a number, which becomes component 2, for spheres a
/// vector.
case_file::KeyValue turn(Vector& place, const int& dimension);
/// A constant torque or angular velocity, or pieces { until, value } that must last until
/// `end_time` [T].
case_file::KeyValue pieces_of_turn(PiecewiseConstant& place, const int& dimension,
                                   const double& end_time);

}  // namespace viscontact::particles
