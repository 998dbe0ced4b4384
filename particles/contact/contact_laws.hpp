// All laws of contact: of the film, of friction and of restitution. Before a time step they bound
// the impulse of a pair. After the step they update gamma, which is minus the impulse that the film
// has absorbed, and what is remembered of the pair. Lengths, masses and times are in any consistent
// units. Impulses and gamma of discs in a fluid are per length [M/T], all others in [M L/T].
// Nothing is checked or thrown. setting.hpp, constraints/, fluid/ and impacts/ use the laws. A new
// law is a class in a file of its own, a member of ContactLaws and, if it remembers something, a
// row in pair_memory.hpp. docs/extending.md adds one as an example and quotes lines of this file:
// whoever changes such a line must change the quotation, too.
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
  /// Radius of the first surface: > 0 for a particle, infinite for a plane, and minus the radius of
  /// the circle for a circle around the second surface.
  double first = std::numeric_limits<double>::infinity();
  double second = 0;  ///< radius of the second surface, which is that of a particle, > 0
};

/// The radii of the surfaces of `pair`, which are two particles, or an obstacle and a particle. The
/// obstacle is that at place pair.plane() of `obstacles`, which must exist.
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
  /// Friction of the solids; without a value there is none. It needs particles that turn. In a
  /// fluid its method must be FrictionMethod::kFixedPoint, and the case must have neither
  /// restitution nor membranes.
  std::optional<FrictionLaw> friction;
  /// Restitution of the solids. It needs a `film` with a finite gamma_min, at which solids touch.
  RestitutionLaw restitution;

  /// gamma_min of a pair, <= 0, in the unit of gamma: the value of gamma at which the solids of the
  /// pair touch, or minus infinity if they never touch.
  double lowest_gamma(const Pair& /*pair*/, const PairMemory& /*memory*/,
                      const PairRadii& radii) const {
    return film.lowest_gamma(radii.second, radii.first);
  }

  /// Updates Pair::gamma, Pair::gamma_error and what the laws remember, from Pair::impulse, after a
  /// step of length `h` [T], > 0. `impulse_error` >= 0 is the residual of this impulse, in the unit
  /// of gamma.
  void remember(Pair& pair, PairMemories& memories, const PairRadii& radii, double impulse_error,
                double /*h*/) const {
    FilmLaw::absorb(pair, impulse_error, lowest_gamma(pair, memories.of(pair.memory), radii));
  }
};

}  // namespace viscontact::particles
