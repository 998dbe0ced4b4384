// The domain that holds the particles and the fluid, and the obstacles that bound it: planes
// (lines, if the particles are discs), which may move, and circles.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "viscontact/particles/values/piecewise_constant.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// Position of a plane or a circle. The free side, on which the particles are, is for a plane the
/// set of the points x with normal.(x - point) >= 0. For a circle it is the inside |x - point| <=
/// radius, and `normal` is not used.
struct PlanePosition {
  Vector point;       ///< any point of the plane, or the centre of the circle [L]
  Vector normal;      ///< unit normal [1] into the free side
  double radius = 0;  ///< radius of the circle [L], > 0; 0: it is a plane

  bool is_curved() const { return radius > 0; }
  bool operator==(const PlanePosition&) const = default;
};

/// What presses a plane against the particles. The plane moves along its normal with the velocity V
/// of m dV/dt = F - N, where N is the sum of the normal forces of its contacts.
struct PlaneLoad {
  /// F in component 0 [M L/T^2], > 0 where it pushes the plane along its normal.
  PiecewiseConstant force;
  double mass = 0;  ///< m [M], > 0
};

/// A plane and its motion: it moves with `velocity` and turns about its pivot, a point that moves
/// with the same velocity. Without friction only the motion along its normal acts on particles.
struct Plane {
  PlanePosition start;         ///< position at time 0
  PiecewiseConstant velocity;  ///< velocity [L/T], constant between given times; 0 after the last
  /// [rad/T]; if the particles are discs, only its third component may differ from 0.
  Vector angular_velocity{};
  Vector pivot{};  ///< position at time 0 of the point about which the plane turns [L]
  /// If it is given, the plane moves along its normal as PlaneLoad says, from rest at time 0.
  /// `velocity` must then be along the plane, and the plane must not turn. displacement(), at() and
  /// surface_velocity() do not contain the motion along the normal, which the state has.
  std::optional<PlaneLoad> load{};

  /// Position at time t >= 0 [T].
  PlanePosition at(double t) const;
  /// Displacement [L], between the times `from` and `to` [T], of the material point of the plane
  /// that is at `point` [L] at time `to`.
  Vector displacement(const Vector& point, double from, double to) const;
  /// Velocity [L/T] of the material point of the plane that is at `point` [L] at time `t` [T].
  Vector surface_velocity(const Vector& point, double t) const;
};

/// Positions at time t >= 0 [T], in the order of `planes`.
std::vector<PlanePosition> positions_of(const std::vector<Plane>& planes, double t);

/// Gap [L] between a disc or sphere and a plane or a circle around it; < 0 if they overlap.
inline double gap(const PlanePosition& plane, const Vector& centre, double radius) {
  if (plane.is_curved()) return plane.radius - norm(centre - plane.point) - radius;
  return dot(plane.normal, centre - plane.point) - radius;
}

/// Unit normal into the free side, at the point of the plane or circle that is nearest to `centre`.
/// If `centre` is the centre of the circle, the result is the first axis.
inline Vector normal_at(const PlanePosition& plane, const Vector& centre) {
  if (!plane.is_curved()) return plane.normal;
  const Vector inward = plane.point - centre;
  const double distance = norm(inward);
  return distance > 0 ? (1 / distance) * inward : Vector{1, 0, 0};
}

/// The tangent to a circle at its point nearest to `centre`. If `plane` is a plane, the result is
/// this plane.
inline PlanePosition tangent_at(const PlanePosition& plane, const Vector& centre) {
  if (!plane.is_curved()) return plane;
  const Vector normal = normal_at(plane, centre);
  return {plane.point - plane.radius * normal, normal};
}

/// The inside of a circle, in two dimensions. Its wall has the number -1 in files.
struct DiscDomain {
  Vector centre{};    ///< [L]
  double radius = 0;  ///< [L], > 0
};

/// A rectangle in two dimensions, a cuboid in three. Its walls have the numbers -1, -2, ... in
/// files, in the order smallest x, largest x, smallest y, largest y, smallest z, largest z. A
/// periodic side is no wall and gets no number; the numbers of the walls after it are the next
/// ones.
struct BoxDomain {
  /// Corner with the smallest coordinates [L]; in two dimensions both third components are 0.
  std::array<double, 3> from{},
      to{};                        ///< the opposite corner [L], > `from` along each axis of space
  std::array<bool, 3> periodic{};  ///< whether the domain is periodic along x, y and z

  std::size_t dimension() const { return to[2] > from[2] ? 3 : 2; }
};

/// A closed cylinder about the axis z, with its floor at z = 0. All particles are spheres on the
/// axis. Its side, which no particle reaches, has the number -1 in files, its floor -2, its lid -3.
struct CylinderDomain {
  double radius = 0,  ///< [L], > 0
      height = 0;     ///< [L], > 0
};

/// The domain of a case. std::monostate: there is none, so that only planes bound the particles.
using Domain = std::variant<std::monostate, DiscDomain, BoxDomain, CylinderDomain>;

/// Area [L^2] of a disc or a rectangle, or volume [L^3] of a cuboid or a cylinder; 0 without a
/// domain.
double measure(const Domain& domain);

/// Lengths of the periods [L]; 0 along an axis on which there is no period.
inline std::array<double, 3> periods_of(const Domain& domain) {
  std::array<double, 3> periods{};
  if (const auto* box = std::get_if<BoxDomain>(&domain))
    for (std::size_t d = 0; d < 3; ++d)
      if (box->periodic[d]) periods[d] = box->to[d] - box->from[d];
  return periods;
}

/// The corner with the smallest coordinates of the box around a disc or a box [L], along the axes
/// on which it is so far from the origin that coordinates have much larger rounding errors than
/// distances from it, and 0 along the others. Computations with places relative to this point lose
/// no digits in a scene far from the origin, and have the same bits as ever in one near it.
Vector distant_corner(const Domain& domain);

/// The walls, at rest, in the order of their numbers in files. A plane that is parallel to the
/// axis, at the distance of the radius, replaces the side of a cylinder.
std::vector<Plane> obstacles_of(const Domain& domain);

}  // namespace viscontact::particles
