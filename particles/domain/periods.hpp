// Periodic domains: the cell, which holds one copy of each particle, and the images of particles in
// the neighbouring cells. The shift of an image is its position minus that of its particle.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// Numbers of periods along x, y and z by which an image is shifted, whole numbers of any sign [1].
using Periods = Vector;

/// The cell of a domain that is periodic along some of its axes.
struct PeriodicCell {
  Vector from{};     ///< lowest coordinates of the cell [L]
  Vector lengths{};  ///< periods along x, y and z [L], >= 0; 0: no period along this axis
  /// Mean gradient du/dx, du/dy, dv/dx, dv/dy of the velocity of a fluid in the cell [1/T], only in
  /// two dimensions. Times the shift of an image at the start, it is the velocity of the image
  /// relative to its particle.
  std::array<double, 4> gradient{};
  /// Time since the start [T], >= 0. At the start all shifts were whole periods along the axes.
  double moved_for = 0;
  /// Displacement along x of the image across the period y [L] (suspensions); then the two members
  /// above have no meaning.
  std::optional<double> offset{};
  /// The present period vectors [L], right-handed, of a cell around the middle of `from` and
  /// `lengths` that a flow strains (suspensions); then the three members above have no meaning.
  std::optional<std::array<Vector, 3>> vectors{};

  bool is_periodic() const { return lengths[0] > 0 || lengths[1] > 0 || lengths[2] > 0; }
  /// True if images move relative to their particles.
  bool is_sheared() const {
    return vectors || offset || gradient[0] * lengths[0] != 0 || gradient[2] * lengths[0] != 0 ||
           gradient[1] * lengths[1] != 0 || gradient[3] * lengths[1] != 0;
  }
  bool operator==(const PeriodicCell&) const = default;
};

/// The cell of a domain, without a mean velocity gradient.
inline PeriodicCell cell_of(const Domain& domain) {
  const auto* box = std::get_if<BoxDomain>(&domain);
  return box == nullptr ? PeriodicCell{} : PeriodicCell{box->from, periods_of(domain)};
}

/// Number of the image that is shifted by `x`, `y` and `z` periods along the axes, each of them -1,
/// 0 or 1; restart files store it. The number is 0 without a shift, and opposite shifts have
/// opposite numbers.
constexpr std::int32_t image_number(int x, int y, int z = 0) { return x + 3 * y + 9 * z; }

/// image_number(1, 1, 1).
inline constexpr std::int32_t kLargestImage = 13;

/// Periods along x, y and z, each -1, 0 or 1, by which the image with number `image` is shifted.
constexpr std::array<int, 3> periods_of_image(std::int32_t image) {
  assert(image >= -kLargestImage && image <= kLargestImage);
  const auto places = image + kLargestImage;
  return {places % 3 - 1, places / 3 % 3 - 1, places / 9 - 1};
}

/// True if the cell is periodic along each axis along which the image is shifted.
inline bool has_image(const PeriodicCell& cell, std::int32_t image) {
  const auto periods = periods_of_image(image);
  for (std::size_t d = 0; d < 3; ++d)
    if (periods[d] != 0 && !(cell.lengths[d] > 0)) return false;
  return true;
}

/// Velocity [L/T] of an image relative to its particle, if its shift at the start was `shift` [L].
inline Vector velocity_at(const PeriodicCell& cell, const Vector& shift) {
  const auto& g = cell.gradient;
  return {g[0] * shift[0] + g[1] * shift[1], g[2] * shift[0] + g[3] * shift[1], 0};
}

/// Shift [L] of an image at the start.
inline Vector shift_at_start(const PeriodicCell& cell, const Periods& periods) {
  return {periods[0] * cell.lengths[0], periods[1] * cell.lengths[1], periods[2] * cell.lengths[2]};
}

/// Velocity [L/T] of an image relative to its particle; 0 with PeriodicCell::offset and
/// PeriodicCell::vectors. Where a contact, a rigid body or a link joins an image in place of the
/// particle, this velocity is added to that of the particle.
inline Vector velocity_of_image(const PeriodicCell& cell, const Periods& periods) {
  return velocity_at(cell, shift_at_start(cell, periods));
}

/// The shift [L] of an image at the time PeriodicCell::moved_for.
inline Vector shift_of(const PeriodicCell& cell, const Periods& periods) {
  if (const auto& v = cell.vectors)
    return periods[0] * (*v)[0] + periods[1] * (*v)[1] + periods[2] * (*v)[2];
  if (cell.offset) return shift_at_start(cell, periods) + Vector{periods[1] * *cell.offset, 0, 0};
  return shift_at_start(cell, periods) + cell.moved_for * velocity_of_image(cell, periods);
}

/// The same, of the image with number `image`, -13 to 13.
inline Vector velocity_of_image(const PeriodicCell& cell, std::int32_t image) {
  const auto [x, y, z] = periods_of_image(image);
  return velocity_of_image(cell, Periods{double(x), double(y), double(z)});
}
/// The same, of the image with number `image`, -13 to 13.
inline Vector shift_of(const PeriodicCell& cell, std::int32_t image) {
  const auto [x, y, z] = periods_of_image(image);
  return shift_of(cell, Periods{double(x), double(y), double(z)});
}

/// The inverse of the motion of the cell, applied to `apart` [L]. The motion has multiplied the
/// shift of each image at the start by the matrix I + moved_for gradient. The result is infinite or
/// NaN if this matrix is singular.
inline Vector before_the_motion(const PeriodicCell& cell, const Vector& apart) {
  if (cell.offset)
    return {apart[0] - *cell.offset * (apart[1] / cell.lengths[1]), apart[1], apart[2]};
  const double t = cell.is_sheared() ? cell.moved_for : 0;
  const auto& g = cell.gradient;
  const double determinant = (1 + t * g[0]) * (1 + t * g[3]) - t * t * g[1] * g[2];
  return {((1 + t * g[3]) * apart[0] - t * g[1] * apart[1]) / determinant,
          ((1 + t * g[0]) * apart[1] - t * g[2] * apart[0]) / determinant, apart[2]};
}

/// The numbers c with x = sum of c_k vectors[k].
inline Vector fractions_of(const std::array<Vector, 3>& vectors, const Vector& x) {
  const auto& [a, b, c] = vectors;
  const double volume = dot(cross(a, b), c);
  return {dot(cross(b, c), x) / volume, dot(cross(c, a), x) / volume, dot(cross(a, b), x) / volume};
}

/// One over the distances [L] of the opposite faces of a cell.
inline Vector one_over_heights(const std::array<Vector, 3>& vectors) {
  const auto& [a, b, c] = vectors;
  const double volume = dot(cross(a, b), c);
  return {norm(cross(b, c)) / volume, norm(cross(c, a)) / volume, norm(cross(a, b)) / volume};
}

/// Whether a point [L] is in the cell, or beside it by less than `reach` [L]. Along an axis without
/// a period all points are.
inline bool is_near_cell(const PeriodicCell& cell, const Vector& x, double reach) {
  if (cell.vectors) {
    const Vector at = fractions_of(*cell.vectors, x - (cell.from + 0.5 * cell.lengths));
    const Vector margin = reach * one_over_heights(*cell.vectors);
    for (std::size_t d = 0; d < 3; ++d)
      if (!(std::abs(at[d]) < 0.5 + margin[d])) return false;
    return true;
  }
  for (std::size_t d = 0; d < 3; ++d)
    if (cell.lengths[d] > 0 &&
        !(x[d] > cell.from[d] - reach && x[d] < cell.from[d] + cell.lengths[d] + reach))
      return false;
  return true;
}

/// The whole numbers of periods whose shift is nearest to the vector `apart` [L] from one particle
/// to another; in a sheared cell that which would be nearest before the motion of the cell,
/// before_the_motion().
inline Periods periods_towards(const PeriodicCell& cell, const Vector& apart) {
  if (cell.vectors) {
    auto counts = fractions_of(*cell.vectors, apart);
    for (auto& count : counts) count = std::round(count);
    return counts;
  }
  const auto at_start = before_the_motion(cell, apart);
  Periods periods{};
  for (std::size_t d = 0; d < 3; ++d)
    if (cell.lengths[d] > 0) periods[d] = std::round(at_start[d] / cell.lengths[d]);
  return periods;
}

/// The vector [L] from the nearest image of one particle to another particle, where `apart` is that
/// from the first to the second particle.
inline Vector nearest_image(const PeriodicCell& cell, const Vector& apart) {
  return apart - shift_of(cell, periods_towards(cell, apart));
}

/// Number of periods along axis `axis`, 0 to 2, that must be subtracted from the coordinate `x` [L]
/// to bring it into the cell, where from <= x < from + length.
inline double periods_beyond(const PeriodicCell& cell, std::size_t axis, double x) {
  assert(axis < 3);
  const double from = cell.from[axis], length = cell.lengths[axis];
  if (!(length > 0)) return 0;
  const double periods = std::floor((x - from) / length);
  // A coordinate below `from` by less than its rounding error counts as inside, because subtracting
  // -1 period would give from + length.
  return x - periods * length < from + length ? periods : periods + 1;
}

}  // namespace viscontact::particles
