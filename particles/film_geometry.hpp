// Where two bodies are to each other: the gap and the normal of a film.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "particles/contact_graph.hpp"
#include "particles/particles.hpp"
#include "particles/plane.hpp"
#include "particles/state.hpp"

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
Contact<D> contact_of(const Particles& p, const Film& film, const PlanePlace& place) {
  Contact<D> contact{-1, film.second, {}, 0, film.gamma, film.impulse};
  for (std::size_t d = 0; d < D; ++d) contact.normal[d] = place.normal[d];
  const auto k = static_cast<std::size_t>(film.second);
  contact.gap = gap(place, p.position(k), p.radii[k]);
  return contact;
}

/// Either, by the sign of film.first.
template <int D>
Contact<D> contact_of(const Particles& p, const Film& film, std::span<const PlanePlace> places) {
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

}  // namespace viscontact::particles
