// All laws of contact: of the film, of friction and of restitution. Before a time step they bound
// the impulse of a pair; after it they update gamma (minus the impulse that the film has absorbed)
// and what is remembered of the pair. A new law is a class in a file of its own, a member of
// ContactLaws, and, if it remembers something, a row in pair_memory.hpp. docs/extending.md shows
// how; it quotes lines of this file, so that a change of one must be made there too. Lengths,
// masses and times are in any consistent units; gamma and impulses of discs in a fluid are per
// length [M/T], all others [M L/T]. Nothing is checked or thrown. Used in setting.hpp,
// constraints/, fluid/, impacts/.
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
  /// > 0 for a particle; infinite for a plane; minus the radius for a circle around the particle.
  double first = std::numeric_limits<double>::infinity();
  double second = 0;  ///< of the second surface, which is that of a particle, > 0
};

/// The radii of the surfaces of `pair`, which are two particles, or an obstacle and a particle. The
/// obstacle is the one with the number pair.plane() in `obstacles`.
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
  FilmLaw film;  ///< how strong the film may pull
  /// Friction of the solids, only for particles that turn. In a fluid its method must be
  /// FrictionMethod::kFixedPoint, and such a case has neither restitution nor membranes.
  std::optional<FrictionLaw> friction;
  RestitutionLaw restitution;  ///< of the solids; needs a `film` with solid contact

  /// gamma_min of a pair, the value of gamma at which its solids touch, in the unit of gamma, <= 0;
  /// minus infinity if they never touch.
  double lowest_gamma(const Pair& /*pair*/, const PairMemory& /*memory*/,
                      const PairRadii& radii) const {
    return film.lowest_gamma(radii.second, radii.first);
  }

  /// Updates gamma and what the laws remember with Pair::impulse after a step of length `h` [T].
  /// `impulse_error` >= 0 is the residual of this impulse, in the unit of gamma.
  void remember(Pair& pair, PairMemories& memories, const PairRadii& radii, double impulse_error,
                double /*h*/) const {
    FilmLaw::absorb(pair, impulse_error, lowest_gamma(pair, memories.of(pair.memory), radii));
  }
};

}  // namespace viscontact::particles
