// How strongly films that pull stiffen their particles across their directions, docs/physics.md
// (5.21).
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// The share of the geometric stiffness of a film that is a spring in the step. `kappa` is that of
/// the particle with the larger one: the sum over its films that pull, with impulses p, of h |p|/(l
/// m), with the sum l of both radii. Without springs a step is stable if no kappa is above 2. A
/// pair that collides pulls for a step only, with a kappa of its displacement over l: it shall keep
/// its angular momentum exactly, so that springs begin late.
inline double share_of_film(double kappa) { return std::clamp(2 * (kappa - 1), 0.0, 1.0); }

/// The largest kappa at which a step with restitution takes the normals of films at its end. With
/// these a pair that turns never gains energy, but vibrations across films are damped by a share of
/// kappa, and grow above 0.5. Gases that rebound, with films, gained 1e-6 of their energy with
/// normals at the beginning for all films, and nothing with this limit.
inline constexpr double kLargestWithEndNormals = 0.02;

/// kappa of all particles if pair f has the impulse `impulse_of(f)` [M L/T]; empty if no film
/// pulls. `mobilities` are h/m [T/M] of a step with forces for the time h.
template <class PairOf, class ImpulseOf>
std::vector<double> kappas_of_films(const Particles& particles, std::span<const double> mobilities,
                                    std::size_t pairs, const PairOf& pair_of,
                                    const ImpulseOf& impulse_of) {
  assert(mobilities.size() >= particles.count());
  std::vector<double> kappas;
  for (std::size_t f = 0; f < pairs; ++f) {
    const Pair& pair = pair_of(f);
    const double impulse = impulse_of(f);
    if (pair.first < 0 || !(impulse < 0)) continue;
    kappas.resize(particles.count());
    const auto i = index_of(pair.first), j = index_of(pair.second);
    for (const auto k : {i, j})
      kappas[k] -= impulse * mobilities[k] / (particles.radii[i] + particles.radii[j]);
  }
  return kappas;
}

}  // namespace viscontact::particles
