// What a film remembers of an impulse, docs/physics.md (5.3). Units are those of the case.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Sets gamma^{n+1} = gamma^n - h lambda of a pair whose impulse is h lambda, within
/// [`lower_bound`, 0]. A gamma that is 0 within the rounding error of this difference is set to 0:
/// the film has given back all that it had absorbed. `impulse_error` >= 0 is the residual of the
/// impulse; all are impulses [M L/T].
inline void absorb_impulse(Pair& pair, double impulse_error, double lower_bound) {
  const double gamma = pair.gamma - pair.impulse;
  const double rounding =
      std::numeric_limits<double>::epsilon() * (std::abs(pair.gamma) + std::abs(pair.impulse));
  const double error = pair.gamma_error + impulse_error + rounding;
  const bool spent = gamma >= -rounding;
  const double bound = spent ? 0 : lower_bound;
  pair.gamma = spent ? 0.0 : std::max(gamma, bound);
  pair.gamma_error = spent || pair.gamma == bound ? 0 : error;
}

}  // namespace viscontact::particles
