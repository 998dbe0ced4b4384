// Poisson's law of restitution of solids that may have a film between them, docs/physics.md (5.15).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscontact::particles {

/// gamma <= 0 is minus the impulse that the film has absorbed; the solids touch when gamma reaches
/// gamma_min. An impact, the collision of two solids, has two phases. In the compression, which
/// ends when the surfaces no longer approach each other, the film takes the first part of the
/// impulse p, until gamma is gamma_min, and the solids take the rest s:
///
///     s = max(p - (gamma - gamma_min), 0),   gamma_c = max(gamma - p, gamma_min).
///
/// In the restitution the solids push with the impulse e_d s, and the film pulls with an impulse of
/// up to -gamma_c. The impulse p' of this phase and the velocity at which the surfaces leave each
/// other obey
///
///     p' >= gamma_c + e_d s,   opening velocity >= 0,   equality in one of the two,
///     gamma after the impact = gamma_c + e_d s - p'.
struct RestitutionLaw {
  double coefficient = 0;  ///< e_d [1], 0 to 1

  bool is_on() const { return coefficient > 0; }

  /// s for a film that can take up `capacity` = gamma - gamma_min >= 0, which may be infinite.
  static double solid_impulse(double p, double capacity) { return std::max(p - capacity, 0.0); }

  /// gamma_c + e_d s, the lower bound of p'.
  double lowest_in_restitution(double gamma_c, double solid_impulse) const {
    return gamma_c + coefficient * solid_impulse;
  }

  /// gamma after an impact, within [`gamma_min`, 0]: `lowest` - `p`, where `lowest` = gamma_c + e_d
  /// s and `p` = p'; both may contain the impulse of the compression. If the difference is 0 within
  /// its rounding error, taken as 8 units in the last place, the result is exactly 0, because the
  /// film has then given back all that it had absorbed. `gamma`, before the impact, serves only to
  /// estimate this error.
  static double gamma_after(double lowest, double p, double gamma_min, double gamma) {
    const double left = lowest - p;
    const double rounding =
        8 * std::numeric_limits<double>::epsilon() * (std::abs(gamma) + std::abs(lowest));
    return left >= -rounding ? 0 : std::max(left, gamma_min);
  }
};

}  // namespace viscontact::particles
