#include "tests/oracles/bispherical/squeeze.hpp"

#include <algorithm>

#include "tests/oracles/bispherical/bispherical.hpp"

namespace viscontact {

double exact_squeeze(double ratio, double width) {
  if (ratio < 0) {
    const double narrow = 1 + ratio;  // The sphere's radius over r_eff.
    const double gap = std::min(width * narrow, -1 / ratio - 1);
    return cavity_drag_factor(gap, -1 / ratio) * narrow * narrow * narrow;
  }
  // The larger radius is 1, forces are in units of 6 pi mu. K_11 = A - K_12 and K_22 = B - K_12,
  // where A and B are the forces if both spheres move together; so R is K_11 K_22 - K_12^2 over K_11
  // + K_22 + 2 K_12, without a difference of nearly equal numbers.
  const double r_eff = ratio / (1 + ratio), gap = width * r_eff;
  const double alone = ratio * two_sphere_drag_factor(gap / ratio, 1 / ratio, 0);
  const double together = ratio * two_sphere_drag_factor(gap / ratio, 1 / ratio, 1);
  const double other_together = two_sphere_drag_factor(gap, ratio, 1);
  return (alone - together + together * other_together / (together + other_together)) / r_eff;
}

}  // namespace viscontact
