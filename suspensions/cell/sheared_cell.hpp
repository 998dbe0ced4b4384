// A cell with periods along x, y and z whose images across y are displaced along x, (9.3), or with
// any period vectors.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/suspensions/cell/strained_lattice.hpp"
#include "viscontact/suspensions/values/lanes.hpp"

namespace viscontact::suspensions {

/// The cell around `middle` of a lattice.
struct LatticeCell {
  Lattice periods{};   ///< reduced [L]
  Matrix fractions{};  ///< fractions_of(periods) [1/L]
  Vector middle{};     ///< [L]

  LatticeCell(const Lattice& lattice, const Vector& middle_of_cell)
      : periods(lattice), fractions(fractions_of(lattice)), middle(middle_of_cell) {}

  /// Coordinates of `x` [L] along the periods, which are from -1/2 to 1/2 in the cell.
  Vector fractions_at(const Vector& x) const { return numbers_of(x - middle); }
  Vector numbers_of(const Vector& apart) const {
    return {dot(fractions[0], apart), dot(fractions[1], apart), dot(fractions[2], apart)};
  }
  Vector shift_of(const particles::Periods& counts) const {
    return counts[0] * periods[0] + counts[1] * periods[1] + counts[2] * periods[2];
  }
  /// Right for vectors from the nearest image that are below half of each height of the cell.
  particles::Periods periods_towards(const Vector& apart) const {
    auto counts = numbers_of(apart);
    for (auto& count : counts) count = std::round(count);
    return counts;
  }
  Vector wrapped(const Vector& x) const { return x - shift_of(periods_towards(x - middle)); }
};

struct ShearedCell {
  Vector from{};      ///< lowest coordinates [L]
  Vector lengths{};   ///< periods [L], 0 along an axis without a period
  double offset = 0;  ///< displacement along x of the image across the period y [L]
  /// In place of the members above.
  std::optional<LatticeCell> lattice{};

  /// The least distance of opposite faces along an axis with a period [L]; infinite without one.
  double least_height() const {
    double least = std::numeric_limits<double>::infinity();
    for (const double height : lattice ? heights_of(lattice->periods) : lengths)
      if (height > 0) least = std::min(least, height);
    return least;
  }

  /// Whole numbers of periods whose shift is nearest to `apart` [L], first along y.
  particles::Periods periods_towards(const Vector& apart) const {
    if (lattice) return lattice->periods_towards(apart);
    particles::Periods periods{};
    if (lengths[1] > 0) periods[1] = std::round(apart[1] / lengths[1]);
    if (lengths[0] > 0) periods[0] = std::round((apart[0] - periods[1] * offset) / lengths[0]);
    if (lengths[2] > 0) periods[2] = std::round(apart[2] / lengths[2]);
    return periods;
  }
  Vector shift_of(const particles::Periods& periods) const {
    if (lattice) return lattice->shift_of(periods);
    return {periods[0] * lengths[0] + periods[1] * offset, periods[1] * lengths[1],
            periods[2] * lengths[2]};
  }
  /// The vector [L] from the nearest image of one sphere to another, where `apart` is that from the
  /// first to the second sphere.
  Vector nearest(const Vector& apart) const { return apart - shift_of(periods_towards(apart)); }

  /// The image of `x` [L] that is in the cell.
  Vector wrapped(const Vector& x) const {
    if (lattice) return lattice->wrapped(x);
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
