// The domain that holds the particles and, if there is one, the fluid: a disc, a box that may be
// periodic, or a cylinder with the particles on its axis. Lengths [L] are in the unit of the case.
// particles/case checks the values. A change must keep the numbers of obstacles in files.
#pragma once

#include <array>
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

/// A rectangle, in two dimensions. Its walls are the obstacles -1, -2, ... in the order left,
/// right, bottom, top; a side that is periodic is no obstacle and has no number.
struct BoxDomain {
  std::array<double, 2> from{},    ///< lower left corner [L], < `to` in both components
      to{};                        ///< upper right corner [L]
  std::array<bool, 2> periodic{};  ///< whether the left and right, bottom and top sides are one
};

/// A closed cylinder about the axis z, with its floor at z = 0. All particles are spheres on the
/// axis. Its side is obstacle -1, which no particle reaches; its floor is -2 and its lid is -3.
struct CylinderDomain {
  double radius = 0,  ///< [L], > 0
      height = 0;     ///< [L], > 0
};

/// monostate: no domain, so that only planes bound the particles.
using Domain = std::variant<std::monostate, DiscDomain, BoxDomain, CylinderDomain>;

/// Lengths of the periods along x and y [L]; 0 where the domain is not periodic.
inline std::array<double, 2> periods_of(const Domain& domain) {
  const auto* box = std::get_if<BoxDomain>(&domain);
  if (box == nullptr) return {};
  return {box->periodic[0] ? box->to[0] - box->from[0] : 0,
          box->periodic[1] ? box->to[1] - box->from[1] : 0};
}

/// The walls of a domain, at rest, in the order of the obstacles above. The wall of a disc is a
/// circle that is seen from inside. The side of a cylinder is parallel to the axis of the
/// particles: its gap is the distance from it, and its normal has no component along the axis.
std::vector<Plane> obstacles_of(const Domain& domain);

}  // namespace viscontact::particles
