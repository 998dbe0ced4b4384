// The domain that holds the particles and, if there is one, the fluid: a disc, a box that may be
// periodic, or a cylinder with the particles on its axis. Lengths [L] are in the unit of the case.
// particles/case checks the values. A change must keep the numbers of obstacles in files.
#pragma once

#include <array>
#include <cstddef>
#include <variant>
#include <vector>

#include "viscontact/particles/domain/plane.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// The inside of a circle, in two dimensions. Its wall is obstacle -1.
struct DiscDomain {
  Vector centre{};    ///< [L]
  double radius = 0;  ///< [L], > 0
};

/// A rectangle in two dimensions, a cuboid in three. Its walls are the obstacles -1, -2, ... in the
/// order left, right (across x), bottom, top (across y), in three dimensions left, right, front,
/// back (across y), bottom, top (across z); a side that is periodic is no obstacle and has no
/// number.
struct BoxDomain {
  /// Corner with the smallest coordinates [L], < `to` in each component; the third components of
  /// both are 0 in two dimensions.
  std::array<double, 3> from{}, to{};  ///< the opposite corner [L]
  std::array<bool, 3> periodic{};      ///< whether the two sides across x, y and z are one

  /// 2 or 3.
  std::size_t dimension() const { return to[2] > from[2] ? 3 : 2; }
};

/// A closed cylinder about the axis z, with its floor at z = 0. All particles are spheres on the
/// axis. Its side is obstacle -1, which no particle reaches; its floor is -2 and its lid is -3.
struct CylinderDomain {
  double radius = 0,  ///< [L], > 0
      height = 0;     ///< [L], > 0
};

/// monostate: no domain, so that only planes bound the particles.
using Domain = std::variant<std::monostate, DiscDomain, BoxDomain, CylinderDomain>;

/// Area of a disc or a rectangle [L^2], volume of a cuboid or a cylinder [L^3]; 0 without a domain.
double measure(const Domain& domain);

/// Lengths of the periods along x, y and z [L]; 0 where the domain is not periodic.
inline std::array<double, 3> periods_of(const Domain& domain) {
  std::array<double, 3> periods{};
  if (const auto* box = std::get_if<BoxDomain>(&domain))
    for (std::size_t d = 0; d < 3; ++d)
      if (box->periodic[d]) periods[d] = box->to[d] - box->from[d];
  return periods;
}

/// The walls of a domain, at rest, in the order of the obstacles above. The wall of a disc is a
/// circle that is seen from inside. The side of a cylinder is parallel to the axis of the
/// particles: its gap is the distance from it, and its normal has no component along the axis.
std::vector<Plane> obstacles_of(const Domain& domain);

}  // namespace viscontact::particles
