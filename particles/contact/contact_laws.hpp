// All laws of contact: of the film, of friction and of restitution. A new law is a class in a file
// of its own and a member of ContactLaws; docs/extending.md adds one as an example.
#pragma once

#include <cassert>
#include <limits>
#include <optional>
#include <span>

#include "viscontact/particles/contact/film_law.hpp"
#include "viscontact/particles/contact/friction_law.hpp"
#include "viscontact/particles/contact/restitution_law.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

struct PairRadii {
  /// > 0 for a particle, infinite for a plane, and minus the radius of a circle around the second
  /// surface.
  double first = std::numeric_limits<double>::infinity();
  double second = 0;  ///< that of a particle
};

inline PairRadii radii_of(const Pair& pair, const Particles& particles,
                          std::span<const Plane> obstacles) {
  assert(pair.first >= 0 || pair.plane() < obstacles.size());
  PairRadii radii;
  radii.second = particles.radii[index_of(pair.second)];
  if (pair.first >= 0)
    radii.first = particles.radii[index_of(pair.first)];
  else if (const auto& place = obstacles[pair.plane()].start; place.is_curved())
    radii.first = -place.radius;
  return radii;
}

struct ContactLaws {
  FilmLaw film;
  /// Without a value there is none. It needs particles that turn. In a fluid its method must be
  /// FrictionMethod::kCoulomb, and the case must have neither restitution nor membranes.
  std::optional<FrictionLaw> friction;
  /// It needs a `film` with a finite gamma_min, at which solids touch.
  RestitutionLaw restitution;

  /// gamma_min of a pair, <= 0: the value of gamma, minus the impulse that the film has absorbed,
  /// at which the solids touch, or minus infinity if they never do. Gamma and impulses are in [M
  /// L/T], of discs in a fluid in [M/T].
  double lowest_gamma(const Pair& /*pair*/, const PairMemory& /*memory*/,
                      const PairRadii& radii) const {
    return film.lowest_gamma(radii.second, radii.first);
  }

  /// Whether gamma_min of a pair is below 0.
  bool has_film(const PairRadii& radii) const { return film.is_between(radii.second, radii.first); }

  /// Updates Pair::gamma, Pair::gamma_error and what the laws remember, from Pair::impulse, after a
  /// step of length `h` [T]. `impulse_error` >= 0 is the residual of this impulse.
  void remember(Pair& pair, PairMemories& memories, const PairRadii& radii, double impulse_error,
                double /*h*/) const {
    FilmLaw::absorb(pair, impulse_error, lowest_gamma(pair, memories.of(pair.memory), radii));
  }
};

}  // namespace viscontact::particles
