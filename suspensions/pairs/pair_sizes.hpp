// Lengths of a pair of spheres, or of a sphere and a plane, whose radius is infinite.
#pragma once

#include <cmath>

namespace viscontact::suspensions {

struct PairSizes {
  /// Distance of the centres at contact; beside a plane that of the centre from the plane [L].
  double contact_distance = 0;
  double mean = 0;     ///< mean radius, beside a plane the radius of the sphere [L]
  double reduced = 0;  ///< a_1 a_2/(a_1 + a_2) [L]
  bool has_plane = false;
};

/// `second` may be infinite.
inline PairSizes sizes_of(double first, double second) {
  if (std::isinf(second)) return {first, first, first, true};
  const double sum = first + second;
  return {sum, sum / 2, first * second / sum, false};
}

}  // namespace viscontact::suspensions
