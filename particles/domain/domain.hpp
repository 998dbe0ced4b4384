// The domain that holds the particles and, if there is one, the fluid: a disc, a box that may be
// periodic, or a cylinder with the particles on its axis; and the obstacles that bound the space of
// the particles: planes (lines, for discs) and circles. A plane is at rest, moves or turns. Lengths
// and times are in the units of the case. All contacts use them; particles/case checks the values.
// A change must keep the numbers of obstacles in files, and normals at length 1.
#pragma once

#include <array>
#include <cstddef>
#include <variant>
#include <vector>

#include "viscontact/particles/piecewise_constant.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Position of a plane. The points x with normal.(x - point) >= 0 are its free side. With a radius
/// it is a circle, whose inside |x - point| <= radius is the free side; then `normal` is not used.
struct PlanePosition {
  Vector point;       ///< any point of the plane, or the centre of the circle [L]
  Vector normal;      ///< unit normal into the free side
  double radius = 0;  ///< of the circle [L], > 0; 0: a plane

  bool is_curved() const { return radius > 0; }  ///< whether it is a circle
  /// True if all members are equal.
  bool operator==(const PlanePosition&) const = default;
};

/// A plane and its motion: it moves with `velocity` and turns about `pivot`, which moves with it.
/// Without friction only the motion along its normal acts on particles.
struct Plane {
  PlanePosition start;         ///< position at time 0
  PiecewiseConstant velocity;  ///< [L/T]
  /// Constant [1/T]; for discs it is (0, 0, omega).
  Vector angular_velocity{};
  Vector pivot{};  ///< position of the pivot at time 0 [L]

  /// Position at time t >= 0 [T].
  PlanePosition at(double t) const;
  /// Displacement, between the times `from` and `to` [T], of the material point of the plane that
  /// is at `point` at time `to` [L].
  Vector displacement(const Vector& point, double from, double to) const;
  /// Velocity at time `t` [T] of the material point of the plane that is then at `point` [L/T].
  Vector surface_velocity(const Vector& point, double t) const;
};

/// Positions of all planes at time t [T], in the order of `planes`.
std::vector<PlanePosition> positions_of(const std::vector<Plane>& planes, double t);

/// Gap D between a sphere and a plane, or a circle around it [L], docs/physics.md (5.1); < 0 if
/// they overlap.
inline double gap(const PlanePosition& plane, const Vector& centre, double radius) {
  if (plane.is_curved()) return plane.radius - norm(centre - plane.point) - radius;
  return dot(plane.normal, centre - plane.point) - radius;
}

/// Unit normal, into the free side, at the point of the plane or circle that is nearest to
/// `centre`. In the centre of a circle the normal is the first axis.
inline Vector normal_at(const PlanePosition& plane, const Vector& centre) {
  if (!plane.is_curved()) return plane.normal;
  const Vector inward = plane.point - centre;
  const double distance = norm(inward);
  return distance > 0 ? (1 / distance) * inward : Vector{1, 0, 0};
}

/// The plane that touches the circle at its point nearest to `centre`; a plane is returned as it
/// is. The inside of the circle lies in its free side.
inline PlanePosition tangent_at(const PlanePosition& plane, const Vector& centre) {
  if (!plane.is_curved()) return plane;
  const Vector normal = normal_at(plane, centre);
  return {plane.point - plane.radius * normal, normal};
}

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
