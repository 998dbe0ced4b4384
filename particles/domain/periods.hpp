// Periods of a domain: the cell that holds the positions, and the images of a particle. Lengths are
// in the unit of the case. The restart file stores the numbers of images, so that their meaning
// must be kept.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// The cell of a domain that is periodic along x, y, both or neither.
struct PeriodicCell {
  std::array<double, 2> from{};     ///< lowest x and y of the cell [L]
  std::array<double, 2> lengths{};  ///< periods along x and y [L]; 0 where there is no period
  /// Mean velocity gradient du/dx, du/dy, dv/dx, dv/dy of a fluid in the cell [1/T]: an image moves
  /// relative to its particle by the gradient times its shift.
  std::array<double, 4> gradient{};

  bool is_periodic() const { return lengths[0] > 0 || lengths[1] > 0; }
  bool operator==(const PeriodicCell&) const = default;
};

inline PeriodicCell cell_of(const Domain& domain) {
  const auto* box = std::get_if<BoxDomain>(&domain);
  return box == nullptr ? PeriodicCell{} : PeriodicCell{box->from, periods_of(domain)};
}

/// Number of the image that is shifted by `x` periods along x and `y` periods along y, each of them
/// -1, 0 or 1: (x + 1) + 3 (y + 1) - 4. It is 0 without a shift, and the opposite shift has the
/// opposite number.
constexpr std::int32_t image_number(int x, int y) { return x + 3 * y; }

/// Periods along x and y by which the image with number `image`, -4 to 4, is shifted.
constexpr std::array<int, 2> periods_of_image(std::int32_t image) {
  return {(image + 4) % 3 - 1, (image + 4) / 3 - 1};
}

/// Largest number of an image.
inline constexpr std::int32_t kLargestImage = 4;

/// Shift of an image [L], which is added to the position of the particle.
inline Vector shift_of(const PeriodicCell& cell, std::int32_t image) {
  const auto [x, y] = periods_of_image(image);
  return {x * cell.lengths[0], y * cell.lengths[1], 0};
}

/// Velocity of an image relative to its particle, which is `shift` [L] away from it [L/T].
inline Vector velocity_at(const PeriodicCell& cell, const Vector& shift) {
  const auto& g = cell.gradient;
  return {g[0] * shift[0] + g[1] * shift[1], g[2] * shift[0] + g[3] * shift[1], 0};
}

/// Number of periods along axis `axis` (0 or 1) that are subtracted from the coordinate `x` [L] to
/// bring it into the cell: from <= x < from + length. 0 where there is no period.
inline double periods_beyond(const PeriodicCell& cell, std::size_t axis, double x) {
  const double from = cell.from[axis], length = cell.lengths[axis];
  if (!(length > 0)) return 0;
  const double periods = std::floor((x - from) / length);
  // A coordinate that is below `from` by less than its rounding error counts as inside.
  return x - periods * length < from + length ? periods : periods + 1;
}

}  // namespace viscontact::particles
