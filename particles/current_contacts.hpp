// The contacts of a state, for whoever looks at it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "viscontact/particles/simulation.hpp"

namespace viscontact::particles {

struct CurrentContact {
  std::int32_t first;      ///< particle, or -1 - k: plane k
  std::int32_t second;     ///< particle
  double gap;              ///< [L]
  double gamma;            ///< [M L/T]
  double gamma_error = 0;  ///< Film::gamma_error [M L/T]
};

/// The names of both partners in files: a particle's id, then that of the other particle or
/// -1, -2, ... for the first, second plane.
std::pair<std::int32_t, std::int32_t> ids_of(const Particles& particles,
                                             const CurrentContact& contact);

/// The films that hold (gamma < 0) and what touches without (gap <= tolerance of the solver): pairs, then walls, in order.
std::vector<CurrentContact> contacts_of(const Setting& setting, const State& state);

/// Largest Film::gamma_error of all films [M L/T].
double largest_gamma_error(const State& state);

/// Largest overlap of two particles, or of one and a plane, over the mean radius; 0 if there is none. Of all pairs, not only those in the list.
double largest_overlap(const Setting& setting, const State& state);

}  // namespace viscontact::particles
