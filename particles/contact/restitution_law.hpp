// Restitution of solids that hit each other and may have a film between them, docs/physics.md
// (5.15), by Poisson's law: the impulse that the solids give back is a share of the impulse that
// they took. gamma <= 0 is minus the impulse that the film has absorbed; the solids touch when
// gamma reaches gamma_min. Impulses and gamma are in any consistent unit [M L/T]; those of discs in
// a fluid are per length [M/T]. Nothing is checked or thrown. A case has its law of restitution in
// contact_laws.hpp; impacts/ and fluid/ apply it to each blow. A change must not let a blow create
// energy.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscontact::particles {

/// A blow is the collision of two solids. It has two phases. In the compression, which ends when
/// the surfaces no longer approach each other, the film takes the first part of the impulse p,
/// until gamma is gamma_min, and the solids take the rest s:
///
///     s = max(p - (gamma - gamma_min), 0),   gamma_c = max(gamma - p, gamma_min).
///
/// The second phase is the restitution. The solids push with the impulse e_d s, and the film pulls
/// with an impulse of up to -gamma_c, where gamma_c is gamma after the compression. The opening
/// velocity is that with which the surfaces leave each other. The impulse p' of this phase obeys
///
///     p' >= gamma_c + e_d s,   opening velocity >= 0,   equality in one of the two,
///     gamma after the blow = gamma_c + e_d s - p'.
struct RestitutionLaw {
  double coefficient = 0;  ///< e_d [1], 0 to 1; with 0 the solids give nothing back

  bool is_on() const { return coefficient > 0; }  ///< whether solids rebound

  /// s >= 0 [M L/T], for the impulse `p` [M L/T] of the compression and a film that can take up
  /// `capacity` = gamma - gamma_min >= 0 [M L/T], which may be infinite.
  static double solid_impulse(double p, double capacity) { return std::max(p - capacity, 0.0); }

  /// gamma_c + e_d s [M L/T], the lower bound of p', for gamma_c <= 0 and s >= 0.
  double lowest_in_restitution(double gamma_c, double solid_impulse) const {
    return gamma_c + coefficient * solid_impulse;
  }

  /// gamma after a blow [M L/T], within [`gamma_min`, 0]: `lowest` - `p`, where `lowest` = gamma_c
  /// + e_d s and `p` = p'. The caller may add the impulse of the compression to both `lowest` and
  /// `p`. If the difference is 0 within its rounding error, taken as 8 units in the last place, the
  /// result is exactly 0, because the film has then given back all that it had absorbed. `gamma` is
  /// the value before the blow, which serves only to estimate this rounding error.
  static double gamma_after(double lowest, double p, double gamma_min, double gamma) {
    const double left = lowest - p;
    const double rounding =
        8 * std::numeric_limits<double>::epsilon() * (std::abs(gamma) + std::abs(lowest));
    return left >= -rounding ? 0 : std::max(left, gamma_min);
  }
};

}  // namespace viscontact::particles
