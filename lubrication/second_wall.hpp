// The wall opposite the neighbour, which a closed container or a cavity has.
#pragma once

#include <optional>
#include <string>

namespace viscontact::lubrication {

struct SecondWall {
  /// The gap L [L] to the neighbour at which the sphere touches this wall, > 0.
  double largest_gap = 0;
  /// The coefficient in R = leading_factor 6 pi mu r^2/(L - q) + ... near this wall [1], >= 0. It
  /// is 0 if the sphere does not touch this wall at the gap L, because its neighbour, a larger
  /// sphere, touches the end of the container first.
  double leading_factor = 0;
};

/// The wall opposite a neighbour, from the words for geometry and container in the head of a table
/// or in a fit: "closed cylinder, radius 40, height 80", or "cavity, radius 5". The radius r [L] is
/// that of the sphere. Nothing if the fluid is unbounded, or if the words say something else.
///
///     plane, free_surface, rough_plane in a cylinder of height H:   L = H - 2 r
///     sphere of radius r2, with the middle of the gap at H/2:       L = H - 4 max(r, r2)
///     cavity of radius R:                                           L = 2 (R - r)
std::optional<SecondWall> second_wall(const std::string& geometry, const std::string& container,
                                      double radius);

}  // namespace viscontact::lubrication
