// All laws that the contacts of a case obey. Before a step they bound the impulse of a pair; after
// it they update gamma and what is remembered of the pair. A new law is a class of its own
// (film_law.hpp, friction_law.hpp, restitution_law.hpp), a member here, and, if it remembers
// something, a row in pair_memory.hpp. Lengths, masses and times are in any consistent units; gamma
// and impulses of discs in a fluid are per length [M/T], all others [M L/T]. The projection, the
// fluid and the blows ask them; nothing is thrown.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "viscontact/particles/contact/film_law.hpp"
#include "viscontact/particles/contact/friction_law.hpp"
#include "viscontact/particles/contact/restitution_law.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Radii of both surfaces of a pair [L].
struct PairRadii {
  /// Radius of the first surface: infinite for a plane, minus the radius for a circle around it.
  double first = std::numeric_limits<double>::infinity();
  double second = 0;  ///< of a particle, > 0
};

/// The radii of a pair of particles, or of one at an obstacle.
inline PairRadii radii_of(const Pair& pair, const Particles& particles,
                          std::span<const Plane> obstacles) {
  PairRadii radii;
  radii.second = particles.radii[index_of(pair.second)];
  if (pair.first >= 0)
    radii.first = particles.radii[index_of(pair.first)];
  else if (const auto& place = obstacles[pair.plane()].start; place.is_curved())
    radii.first = -place.radius;
  return radii;
}

/// The laws of a case.
struct ContactLaws {
  FilmLaw film;                         ///< how strong the film may pull
  std::optional<FrictionLaw> friction;  ///< of the solids; needs particles that turn. In a fluid
                                        ///< kFixedPoint, without restitution and membranes
  RestitutionLaw restitution;           ///< of the solids; needs a film law with solid contact

  /// gamma_min of a pair in the unit of gamma, <= 0; minus infinity if its solids never touch.
  double lowest_gamma(const Pair& /*pair*/, const PairMemory& /*memory*/,
                      const PairRadii& radii) const {
    return film.lowest_gamma(radii.second, radii.first);
  }

  /// Updates gamma and the memories of the laws with Pair::impulse after a step of length `h` [T].
  /// `impulse_error` is that of FilmLaw::absorb().
  void remember(Pair& pair, PairMemories& memories, const PairRadii& radii, double impulse_error,
                double /*h*/) const {
    FilmLaw::absorb(pair, impulse_error, lowest_gamma(pair, memories.of(pair.memory), radii));
  }
};

}  // namespace viscontact::particles
