// Gap and normal of a pair, docs/physics.md (5.1), and whether given displacements close the gap.
// All lengths and displacements are in one consistent unit of length.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/plane.hpp"
#include "viscontact/particles/projection/contact_graph.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Contact of two particles, with gap D_ij and normal e_ij of docs/physics.md (5.1). If both
/// centres coincide, the normal is the first axis, because every direction separates them.
template <int D>
Contact<D> contact_of(const Particles& p, const Film& film) {
  Contact<D> contact{film.first, film.second, {}, 0, film.gamma, film.impulse};
  const auto i = static_cast<std::size_t>(film.first), j = static_cast<std::size_t>(film.second);
  double square = 0;
  for (std::size_t d = 0; d < D; ++d) {
    contact.normal[d] = p.positions[j * D + d] - p.positions[i * D + d];
    square += contact.normal[d] * contact.normal[d];
  }
  const double distance = std::sqrt(square);
  if (distance > 0)
    for (auto& x : contact.normal) x /= distance;
  else
    contact.normal[0] = 1;
  contact.gap = distance - p.radii[i] - p.radii[j];
  return contact;
}

/// Contact of a particle and a plane that is at `place`.
template <int D>
Contact<D> contact_of(const Particles& p, const Film& film, const PlanePosition& place) {
  Contact<D> contact{-1, film.second, {}, 0, film.gamma, film.impulse};
  for (std::size_t d = 0; d < D; ++d) contact.normal[d] = place.normal[d];
  const auto k = static_cast<std::size_t>(film.second);
  contact.gap = gap(place, p.position(k), p.radii[k]);
  return contact;
}

/// Contact of either kind of pair; film.first is negative if it stands for a plane.
template <int D>
Contact<D> contact_of(const Particles& p, const Film& film, std::span<const PlanePosition> places) {
  return film.first < 0 ? contact_of<D>(p, film, places[static_cast<std::size_t>(-1 - film.first)])
                        : contact_of<D>(p, film);
}

/// Linearised gap D + h G v [L] after the displacements h v, a flat array [L].
template <int D>
double gap_after(const Contact<D>& contact, std::span<const double> displacements) {
  const double* wj = &displacements[static_cast<std::size_t>(contact.second) * D];
  double sum = contact.gap;
  if (contact.first < 0) {
    for (std::size_t d = 0; d < D; ++d) sum += contact.normal[d] * wj[d];
  } else {
    const double* wi = &displacements[static_cast<std::size_t>(contact.first) * D];
    for (std::size_t d = 0; d < D; ++d) sum += contact.normal[d] * (wj[d] - wi[d]);
  }
  return sum;
}

/// Same as contact_of, but with the gap that a step can and should close.
///
/// The gap is set to 0 if it is no larger than the rounding errors of the positions and radii that
/// it is computed from. Otherwise these errors would cause impulses m D/h, which exceed any load if
/// the step is short.
///
/// An overlap of up to `tolerated` [L] is kept from growing but not pushed out: it counts as gap 0.
/// A packing with such overlaps may have no room to push them out, and where it has room, pushing
/// them out would create motion without a force.
template <int D>
Contact<D> resolved_contact_of(const Particles& p, const Film& film,
                               std::span<const PlanePosition> places, double tolerated) {
  // The rounding error of the gap is taken as 4 units in the last place of the sum of the sizes.
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  auto contact = contact_of<D>(p, film, places);
  const auto j = static_cast<std::size_t>(film.second);
  double sizes = p.radii[j];
  for (std::size_t d = 0; d < D; ++d) sizes += std::abs(p.positions[j * D + d]);
  if (film.first >= 0) {
    const auto i = static_cast<std::size_t>(film.first);
    sizes += p.radii[i];
    for (std::size_t d = 0; d < D; ++d) sizes += std::abs(p.positions[i * D + d]);
  } else {
    const auto& place = places[static_cast<std::size_t>(-1 - film.first)];
    for (std::size_t d = 0; d < D; ++d) sizes += std::abs(place.point[d]);
  }
  if (contact.gap < 0) {
    contact.tolerated = std::min(tolerated, -contact.gap);
    contact.gap += contact.tolerated;
  }
  if (std::abs(contact.gap) <= kRounding * sizes) contact.gap = 0;
  return contact;
}

/// True if two particles are so far from each other that these displacements cannot close their
/// linearised gap: |x_j - x_i| > r_i + r_j + |w|_1, where w is the relative displacement and |w|_1,
/// the sum of its components' magnitudes, is at least its length. This test is fast, because it
/// needs no square root and no division, and it decides for most pairs of a list.
template <int D>
bool cannot_close(const Particles& p, const Film& film, std::span<const double> displacements) {
  const auto i = static_cast<std::size_t>(film.first), j = static_cast<std::size_t>(film.second);
  double square = 0, moved = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double apart = p.positions[j * D + d] - p.positions[i * D + d];
    square += apart * apart;
    moved += std::abs(displacements[j * D + d] - displacements[i * D + d]);
  }
  // The margin is larger than the rounding errors that resolved_contact_of() takes for contact.
  constexpr double kAbove = 1 + 1e-9;
  const double reach = kAbove * (p.radii[i] + p.radii[j] + moved);
  return square > reach * reach;
}

/// Largest tangential displacement of a pair in a step, divided by the sum of its radii, for which
/// the linearised gap may stand for the gap. Gap and linearised gap differ by half the square of
/// this ratio, times the sum of the radii.
inline constexpr double kLargestTurn = 0.5;

/// Displacement of the second particle relative to the first [L].
template <int D>
std::array<double, D> relative_displacement(const Contact<D>& contact,
                                            std::span<const double> displacements) {
  std::array<double, D> w{};
  for (std::size_t d = 0; d < D; ++d)
    w[d] = displacements[static_cast<std::size_t>(contact.second) * D + d] -
           displacements[static_cast<std::size_t>(contact.first) * D + d];
  return w;
}

/// True if particle `contact.second` turns about particle `contact.first` by more than kLargestTurn
/// in the step. Always false for a plane, because its linearised gap is exact.
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
  const double sum = p.radii[static_cast<std::size_t>(contact.first)] +
                     p.radii[static_cast<std::size_t>(contact.second)];
  return square - normal * normal > kLargestTurn * kLargestTurn * sum * sum;
}

/// True if two particles touch while they move along straight lines by `displacements`. Also true
/// for all pairs that do not turn too far: for them the linearised gap decides.
template <int D>
bool paths_meet(const Particles& p, const Contact<D>& contact,
                std::span<const double> displacements) {
  if (!turns_too_far(p, contact, displacements)) return true;
  const auto i = static_cast<std::size_t>(contact.first),
             j = static_cast<std::size_t>(contact.second);
  const auto w = relative_displacement(contact, displacements);
  double square = 0, along = 0;
  for (std::size_t d = 0; d < D; ++d) {
    square += w[d] * w[d];
    along -= w[d] * (p.positions[j * D + d] - p.positions[i * D + d]);
  }
  const double at = std::clamp(along / square, 0.0, 1.0);
  double nearest = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double x = p.positions[j * D + d] - p.positions[i * D + d] + at * w[d];
    nearest += x * x;
  }
  const double sum = p.radii[i] + p.radii[j];
  return nearest < sum * sum;
}

}  // namespace viscontact::particles
