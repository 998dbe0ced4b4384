// Numbers of entries as indices, and the maximum that keeps NaN.
#pragma once

#include <cstddef>
#include <cstdint>

namespace viscontact {

/// A number that counts from 0, such as that of a particle, as the type of an index.
constexpr std::size_t index_of(std::int32_t number) { return static_cast<std::size_t>(number); }

/// The larger of two numbers, or NaN if one of them is NaN.
inline double largest_or_nan(double a, double b) { return a != a || b <= a ? a : b; }

}  // namespace viscontact
