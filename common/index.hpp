// Numbers of entries as indices, and the maximum that keeps NaN.
#pragma once

#include <cstddef>
#include <cstdint>

namespace viscontact {

/// The number of a particle, its place in the arrays, from 0, as the type of an index.
constexpr std::size_t index_of(std::int32_t number) { return static_cast<std::size_t>(number); }

/// The larger of two numbers, or NaN if one of them is NaN.
inline double largest_or_nan(double a, double b) { return a != a || b <= a ? a : b; }

}  // namespace viscontact
