// Gap and normal of two particles, or of a particle and an obstacle, docs/physics.md (5.1). Arrays
// `displacements` have D numbers [L] for each particle and then for each plane under a load.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

class ShapedContact;

/// A contact in the problem of a time step: two particles that may touch, or a particle and an
/// obstacle. A film in the gap keeps them together while gamma < 0, minus the impulse that it has
/// absorbed [M L/T].
template <int D>
struct Contact {
  std::int32_t first = -1;  ///< a particle; -1 at an obstacle or the stop of a hinge
  std::int32_t second = 0;
  std::array<double, D> normal;  ///< unit normal from `first` (or the obstacle) to `second`
  /// Distance of the surfaces at the beginning of the step plus `tolerated` [L]. A plane is taken
  /// at its position at the end of the step.
  double gap = 0;
  double lowest = 0;  ///< lower bound of the impulse: gamma before the step [M L/T]
  /// Impulse in the step [M L/T], > 0 if it pushes: a guess, then the solution.
  double impulse = 0;
  /// Largest residual with which the contact counts as converged [L].
  double allowed = 0;
  double tolerated = 0;    ///< overlap that the step does not remove [L]; see resolved()
  std::int32_t image = 0;  ///< periodic image of `second` that meets `first`, -13 to 13
  /// If `first` is negative: number of the obstacle, or -1 for a stop of a hinge.
  std::int32_t obstacle = 0;
  /// Change of the gap per impulse [T/M], > 0 in a problem to be solved. Without a fluid it is h
  /// (1/m_i + 1/m_j) with the masses of both; a particle whose motion is given, and an obstacle
  /// other than a plane under a load, adds nothing.
  double w = 0;
  /// Change of the gap per counter-clockwise turn [rad] of both particles [L]. They are 0 without a
  /// fluid (see `shaped`), and in a fluid for discs except at stops of hinges.
  std::array<double, 2> levers{};
  /// Entry of a plane under a load (PlaneLoad) in the arrays of displacements and mobilities; -1
  /// for others.
  std::int32_t loaded_plane = -1;
  /// True: the contact takes part only if its gap would close otherwise.
  bool is_optional = false;
  /// The surfaces, without a fluid, if one of them is not round; null for discs and spheres.
  const ShapedContact* shaped = nullptr;

  /// The entry of the first body in these arrays; -1 if its motion is given.
  std::int32_t first_entry() const { return loaded_plane >= 0 ? loaded_plane : first; }
  /// The gap of a stop, a bound of a hinge's angle, changes only by turns (`levers`).
  bool is_stop() const { return first < 0 && obstacle < 0; }
};

/// The vector from the centre of `first` to that of image `image` of `second` [L].
template <int D>
std::array<double, D> separation(const Particles& p, std::int32_t first, std::int32_t second,
                                 std::int32_t image) {
  const auto i = index_of(first), j = index_of(second);
  std::array<double, D> x;
  for (std::size_t d = 0; d < D; ++d) x[d] = p.positions[j * D + d] - p.positions[i * D + d];
  if (image != 0) {
    const Vector shift = shift_of(p.cell, image);
    for (std::size_t d = 0; d < D; ++d) x[d] += shift[d];
  }
  return x;
}

/// Contact with a plane or circle at `place`. The gap is the distance of the surfaces, < 0 if they
/// overlap. The members `w`, `allowed`, `tolerated` and `levers` keep their defaults.
template <int D>
Contact<D> contact_of(const Particles& p, const Pair& pair, const PlanePosition& place) {
  assert(pair.first < 0);
  const auto j = index_of(pair.second);
  Contact<D> contact{-1, pair.second, {}, 0, pair.gamma, pair.impulse};
  const Vector normal = normal_at(place, p.position(j));
  for (std::size_t d = 0; d < D; ++d) contact.normal[d] = normal[d];
  contact.gap = gap(place, p.position(j), p.radii[j]);
  contact.obstacle = -1 - pair.first;
  return contact;
}

/// The same for two particles, or an obstacle of `places`. If two centres coincide, the normal is
/// the first axis, because every direction separates them.
template <int D>
Contact<D> contact_of(const Particles& p, const Pair& pair, std::span<const PlanePosition> places) {
  if (pair.first < 0) return contact_of<D>(p, pair, places[pair.plane()]);
  Contact<D> contact{pair.first, pair.second, {}, 0, pair.gamma, pair.impulse};
  contact.image = pair.image;
  contact.normal = separation<D>(p, pair.first, pair.second, pair.image);
  double square = 0;
  for (std::size_t d = 0; d < D; ++d) square += contact.normal[d] * contact.normal[d];
  const double distance = std::sqrt(square);
  if (distance > 0)
    for (auto& x : contact.normal) x /= distance;
  else
    contact.normal[0] = 1;
  contact.gap = distance - p.radii[index_of(pair.first)] - p.radii[index_of(pair.second)];
  return contact;
}

/// Linearised gap [L] after the step: Contact::gap plus the relative displacement along the normal.
/// An obstacle without a load is taken as fixed.
template <int D>
double gap_after(const Contact<D>& contact, std::span<const double> displacements) {
  const double* wj = &displacements[index_of(contact.second) * D];
  double sum = contact.gap;
  if (contact.first_entry() < 0) {
    for (std::size_t d = 0; d < D; ++d) sum += contact.normal[d] * wj[d];
  } else {
    const double* wi = &displacements[index_of(contact.first_entry()) * D];
    for (std::size_t d = 0; d < D; ++d) sum += contact.normal[d] * (wj[d] - wi[d]);
  }
  return sum;
}

template <int D>
std::array<double, D> relative_displacement(const Contact<D>& contact,
                                            std::span<const double> displacements) {
  assert(contact.first >= 0);
  std::array<double, D> w{};
  for (std::size_t d = 0; d < D; ++d)
    w[d] = displacements[index_of(contact.second) * D + d] -
           displacements[index_of(contact.first) * D + d];
  return w;
}

/// The gap [L] after the step along the line through both centres after it. It is at least the
/// linearised gap, gap_after(), and equal to it at an obstacle, and if the particles have passed
/// each other.
template <int D>
double distance_after(const Particles& p, const Contact<D>& contact,
                      std::span<const double> displacements) {
  const double linear = gap_after(contact, displacements);
  if (contact.first < 0) return linear;
  auto apart = separation<D>(p, contact.first, contact.second, contact.image);
  const auto moved = relative_displacement(contact, displacements);
  double along = 0;
  for (std::size_t d = 0; d < D; ++d) {
    apart[d] += moved[d];
    along += contact.normal[d] * apart[d];
  }
  if (along <= 0) return linear;
  double square = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double across = apart[d] - along * contact.normal[d];
    square += across * across;
  }
  // The difference of the hypotenuse and of its part along the normal, without cancellation.
  return linear + square / (along + std::sqrt(along * along + square));
}

/// The `contact` that contact_of() gave for `pair`, with the gap from which the step starts.
///
/// A gap is set to 0 if the rounding errors of positions and radii explain it. In a step of length
/// h a gap q causes an impulse m q/h on a mass m, so that in a short step such an error would
/// exceed any load. An overlap of up to `tolerated` [L] counts as the gap 0. The step then keeps it
/// from growing but does not remove it, because a packing may have no space for that, and because
/// particles would move without a force. Of a larger overlap the step removes the part beyond
/// `tolerated`.
template <int D>
Contact<D> resolved(Contact<D> contact, const Particles& p, const Pair& pair,
                    std::span<const PlanePosition> places, double tolerated) {
  assert(!(tolerated < 0));
  // The rounding error is taken as 4 units in the last place of the sum of the sizes.
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  const auto j = index_of(pair.second);
  double sizes = p.radii[j];
  for (std::size_t d = 0; d < D; ++d) sizes += std::abs(p.positions[j * D + d]);
  if (pair.first >= 0) sizes += p.radii[index_of(pair.first)];
  const double* partner =
      pair.first < 0 ? places[pair.plane()].point.data() : &p.positions[index_of(pair.first) * D];
  for (std::size_t d = 0; d < D; ++d) sizes += std::abs(partner[d]);
  if (pair.first < 0) sizes += places[pair.plane()].radius;
  if (pair.image != 0)
    for (const double length : p.cell.lengths) sizes += length;
  if (contact.gap < 0) {
    contact.tolerated = std::min(tolerated, -contact.gap);
    contact.gap += contact.tolerated;
  }
  if (std::abs(contact.gap) <= kRounding * sizes) contact.gap = 0;
  return contact;
}

/// True if the displacements cannot make the linearised gap of two particles smaller than `margin`
/// [L]: |x_j - x_i| > r_i + r_j + |d|_1 + margin with centres x, radii r and the sum |d|_1 of the
/// magnitudes of the components of the relative displacement. This test needs no square root and no
/// division, and is true for most pairs of a neighbour list.
template <int D>
bool cannot_close(const Particles& p, const Pair& pair, std::span<const double> displacements,
                  double margin = 0) {
  assert(pair.first >= 0 && margin >= 0);
  const auto i = index_of(pair.first), j = index_of(pair.second);
  const auto apart = separation<D>(p, pair.first, pair.second, pair.image);
  double square = 0, moved = 0;
  for (std::size_t d = 0; d < D; ++d) {
    square += apart[d] * apart[d];
    moved += std::abs(displacements[j * D + d] - displacements[i * D + d]);
  }
  // 1e-9 of the distance is larger than the gaps that resolved() takes for rounding errors.
  constexpr double kAbove = 1 + 1e-9;
  const double farthest = kAbove * (p.radii[i] + p.radii[j] + moved + margin);
  return square > farthest * farthest;
}

/// Largest tangential displacement of a pair in a step over the sum of its radii [1] for which the
/// linearised gap is used. The two gaps differ by about half the square of this ratio times the sum
/// of the radii, with 0.5 by about an eighth of this sum.
inline constexpr double kLargestTurn = 0.5;

/// True if the second particle moves around the first one by more than kLargestTurn. Always false
/// for a plane, whose linearised gap is exact, and for a circle, which the step replaces by its
/// tangent (domain.hpp).
template <int D>
bool turns_too_far(const Particles& p, const Contact<D>& contact,
                   std::span<const double> displacements) {
  if (contact.first < 0) return false;
  const auto w = relative_displacement(contact, displacements);
  double square = 0, normal = 0;
  for (std::size_t d = 0; d < D; ++d) {
    square += w[d] * w[d];
    normal += w[d] * contact.normal[d];
  }
  const double sum = p.radii[index_of(contact.first)] + p.radii[index_of(contact.second)];
  return square - normal * normal > kLargestTurn * kLargestTurn * sum * sum;
}

/// True if the linearised gap may be used: if turns_too_far() is false, or if the particles overlap
/// while they move along straight lines by `displacements`.
template <int D>
bool paths_meet(const Particles& p, const Contact<D>& contact,
                std::span<const double> displacements) {
  if (!turns_too_far(p, contact, displacements)) return true;
  const auto w = relative_displacement(contact, displacements);
  const auto apart = separation<D>(p, contact.first, contact.second, contact.image);
  double square = 0, along = 0;
  for (std::size_t d = 0; d < D; ++d) {
    square += w[d] * w[d];
    along -= w[d] * apart[d];
  }
  const double at = std::clamp(along / square, 0.0, 1.0);
  double nearest = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double x = apart[d] + at * w[d];
    nearest += x * x;
  }
  const double sum = p.radii[index_of(contact.first)] + p.radii[index_of(contact.second)];
  return nearest < sum * sum;
}

}  // namespace viscontact::particles
