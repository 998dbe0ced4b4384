// A cell with periods along x, y and z whose images across y are displaced along x, (9.3).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/suspensions/lanes.hpp"

namespace viscontact::suspensions {

struct ShearedCell {
  Vector from{};      ///< lowest coordinates [L]
  Vector lengths{};   ///< periods [L], 0 along an axis without a period
  double offset = 0;  ///< displacement along x of the image across the period y [L]

  /// Whole numbers of periods whose shift is nearest to `apart` [L], first along y.
  particles::Periods periods_towards(const Vector& apart) const {
    particles::Periods periods{};
    if (lengths[1] > 0) periods[1] = std::round(apart[1] / lengths[1]);
    if (lengths[0] > 0) periods[0] = std::round((apart[0] - periods[1] * offset) / lengths[0]);
    if (lengths[2] > 0) periods[2] = std::round(apart[2] / lengths[2]);
    return periods;
  }
  Vector shift_of(const particles::Periods& periods) const {
    return {periods[0] * lengths[0] + periods[1] * offset, periods[1] * lengths[1],
            periods[2] * lengths[2]};
  }
  /// The vector [L] from the nearest image of one sphere to another, where `apart` is that from the
  /// first to the second sphere.
  Vector nearest(const Vector& apart) const { return apart - shift_of(periods_towards(apart)); }

  /// The image of `x` [L] that is in the cell.
  Vector wrapped(const Vector& x) const {
    Vector at = x;
    for (const std::size_t d : {1U, 0U, 2U}) {
      const double periods = periods_beyond(d, at[d]);
      at[d] -= periods * lengths[d];
      if (d == 1) at[0] -= periods * offset;
    }
    return at;
  }

  /// The offset moved by `displacement` [L], between -1/2 and 1/2 of the period along x.
  double moved_offset(double displacement) const {
    const double moved = offset + displacement;
    return lengths[0] > 0 ? moved - lengths[0] * std::round(moved / lengths[0]) : moved;
  }

 private:
  double periods_beyond(std::size_t axis, double x) const {
    return particles::periods_beyond({from, lengths}, axis, x);
  }
};

}  // namespace viscontact::suspensions
