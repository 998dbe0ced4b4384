// Readers of vectors and of piecewise constant vectors, and keys with such values, for the sections
// of a case of many particles. Lengths, masses and times are in the units of the case.
#pragma once

#include <cmath>
#include <string_view>

#include "viscontact/case_file/keys.hpp"
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
void read_vector(const TomlSection& section, std::string_view key, particles::Vector& place,
                 int dimension);

/// Reads a constant vector, or pieces { until, value } that must last until `end_time` [T].
void read_pieces(const TomlSection& section, std::string_view key,
                 particles::PiecewiseConstant& place, int dimension, double end_time);

/// Reads what turns: for discs a number, which becomes component 2, for spheres a vector.
void read_turn(const TomlSection& section, std::string_view key, particles::Vector& place,
               int dimension);

/// Reads a constant such value, or pieces of them.
void read_pieces_of_turn(const TomlSection& section, std::string_view key,
                         particles::PiecewiseConstant& place, int dimension, double end_time);

// Values of keys (keys.hpp), which refer to their arguments.

inline auto vector(particles::Vector& place, const int& dimension) {
  return custom("a list of numbers", read_vector, place, dimension);
}
inline auto pieces(particles::PiecewiseConstant& place, const int& dimension,
                   const double& end_time) {
  return custom("a list of numbers, or of pieces", read_pieces, place, dimension, end_time);
}
inline auto turn(particles::Vector& place, const int& dimension) {
  return custom("a number; in 3D a list", read_turn, place, dimension);
}
inline auto pieces_of_turn(particles::PiecewiseConstant& place, const int& dimension,
                           const double& end_time) {
  return custom("a number, in 3D a list; or pieces", read_pieces_of_turn, place, dimension,
                end_time);
}

}  // namespace viscontact::case_file
