// Where two bodies are to each other: the gap and the normal of a film.
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

/// Of two particles: D_ij and e_ij of physics.md (5). Centres that coincide lie along the first axis: any direction leads apart.
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

/// Of a particle and a plane at `place`.
template <int D>
Contact<D> contact_of(const Particles& p, const Film& film, const PlanePosition& place) {
  Contact<D> contact{-1, film.second, {}, 0, film.gamma, film.impulse};
  for (std::size_t d = 0; d < D; ++d) contact.normal[d] = place.normal[d];
  const auto k = static_cast<std::size_t>(film.second);
  contact.gap = gap(place, p.position(k), p.radii[k]);
  return contact;
}

/// Either, by the sign of film.first.
template <int D>
Contact<D> contact_of(const Particles& p, const Film& film, std::span<const PlanePosition> places) {
  return film.first < 0 ? contact_of<D>(p, film, places[static_cast<std::size_t>(-1 - film.first)])
                        : contact_of<D>(p, film);
}

/// The linearised gap D + h G.v at displacements h v, flat.
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

/// As contact_of, but with the gap that a step can and should close.
///
/// It is 0 if the gap is no larger than the rounding errors of the positions and radii that it is
/// computed from: those would be impulses m D/h, larger than any load if the step is short. And an
/// overlap of up to `tolerated` [L] is not pushed out, only kept from growing. A packing that earlier
/// steps have left with such overlaps may have no room to push them out, and where it has, that
/// would be motion out of nothing.
template <int D>
Contact<D> resolved_contact_of(const Particles& p, const Film& film,
                               std::span<const PlanePosition> places, double tolerated) {
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

/// Whether two particles are so far from each other that no such displacements close
/// their linearised gap: |x_j - x_i| > r_i + r_j + |w|, |w| the length of the relative displacement
/// or more. It takes no root and no division, and tells most pairs of a list.
template <int D>
bool cannot_close(const Particles& p, const Film& film, std::span<const double> displacements) {
  const auto i = static_cast<std::size_t>(film.first), j = static_cast<std::size_t>(film.second);
  double square = 0, moved = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double apart = p.positions[j * D + d] - p.positions[i * D + d];
    square += apart * apart;
    moved += std::abs(displacements[j * D + d] - displacements[i * D + d]);
  }
  // Beyond the rounding errors that resolved_contact_of() takes for contact.
  constexpr double kAbove = 1 + 1e-9;
  const double reach = kAbove * (p.radii[i] + p.radii[j] + moved);
  return square > reach * reach;
}

/// How far a pair may move tangentially in a step, over the sum of its radii, for its linearised gap
/// to stand for its gap: they differ by half the square of that, times the sum.
inline constexpr double kLargestTurn = 0.5;

/// The displacement of the second particle relative to the first.
template <int D>
std::array<double, D> relative_displacement(const Contact<D>& contact,
                                            std::span<const double> displacements) {
  std::array<double, D> w{};
  for (std::size_t d = 0; d < D; ++d)
    w[d] = displacements[static_cast<std::size_t>(contact.second) * D + d] -
           displacements[static_cast<std::size_t>(contact.first) * D + d];
  return w;
}

/// Whether particle `contact.second` turns about `contact.first` by more than kLargestTurn in the
/// step. Never of a plane, whose linearised gap is its gap.
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

/// Whether two particles that move straight by `displacements` touch on their way. Of those that do
/// not turn too far the linearised gap decides, so that this is true.
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
