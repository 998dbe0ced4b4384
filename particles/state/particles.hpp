// Particles of a simulation, their shapes and their rotation.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/shapes/distance.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// A disc (dimension 2) or a sphere (1, 3) of this radius [L].
inline Shape round_shape(int dimension, double radius) {
  assert(dimension >= 1 && dimension <= 3);
  return dimension == 2 ? Shape::disc(radius) : Shape::sphere(radius);
}

/// The particles as flat arrays, in any consistent units. Entry k of `radii`, `masses` and `ids`
/// belongs to particle k, and so do the `dimension` entries from dimension * k on of `positions`
/// and `velocities`. The restart file stores the arrays as they are (particle_runs/io/restart.cpp).
struct Particles {
  /// 2: discs, 3: spheres, 1: spheres on the axis z of a cylinder. z is component 0 of a Vector.
  int dimension = 2;
  std::vector<double> positions;   ///< centres [L]
  std::vector<double> velocities;  ///< of the centres [L/T]
  /// Radii of discs and spheres, bounding radii of other shapes [L], > 0.
  std::vector<double> radii;
  std::vector<double>
      masses;  ///< [M], of discs in a fluid [M/L]; > 0; in a fluid or if the motion is given >= 0
  /// Id of each particle, its name in the user's files, >= 0; no two are equal. Empty: particle k
  /// has the id k.
  std::vector<std::int32_t> ids{};
  // The next four arrays are empty if nothing in the case depends on rotation (docs/particles.md),
  // and for particles on an axis.
  std::vector<double> angles{};  ///< angles of discs, counter-clockwise [rad]; empty for spheres
  /// Orientations of spheres: unit quaternions (w, x, y, z), the rotations from the start until
  /// now; empty for discs.
  std::vector<double> orientations{};
  /// Angular velocities [1/T]: one for each disc, counter-clockwise; three for each sphere.
  std::vector<double> angular_velocities{};
  /// Moments of inertia, one for each particle: [M L^2], of discs in a fluid [M L].
  std::vector<double> inertias{};
  /// Shape of each particle in the plane, from the case; the restart file does not store them.
  /// Empty: all particles are discs or spheres.
  std::vector<Shape> shapes{};
  /// The cell says how images of particles are shifted. A simulation takes it from its setting; the
  /// restart file does not store it.
  PeriodicCell cell{};
  /// Rigid bodies of several particles, from the case. The restart file stores their motion only.
  RigidBodies bodies{};
  /// For each particle of a membrane (a closed chain of particles) its two neighbours in the chain,
  /// and {-1, -1} for other particles; empty without membranes, and in a fluid. The restart file
  /// does not store them.
  std::vector<std::array<std::int32_t, 2>> neighbours{};

  std::size_t count() const { return radii.size(); }
  bool turn() const { return !angular_velocities.empty(); }  ///< whether rotation is computed
  /// True if the two particles belong to one body, or are neighbours on a membrane. Such particles
  /// make no contact.
  bool are_joined(std::int32_t first, std::int32_t second) const {
    if (bodies.are_one(first, second)) return true;
    if (neighbours.empty()) return false;
    assert(static_cast<std::size_t>(first) < neighbours.size());
    const auto& next = neighbours[static_cast<std::size_t>(first)];
    return next[0] == second || next[1] == second;
  }
  /// Id of particle k in files.
  std::int32_t id(std::size_t k) const {
    assert(ids.empty() || k < ids.size());
    return ids.empty() ? static_cast<std::int32_t>(k) : ids[k];
  }
  /// Centre of particle k [L].
  Vector position(std::size_t k) const { return point_of(positions.data(), k, dimension); }
  Shape shape(std::size_t k) const {
    assert(shapes.empty() || k < shapes.size());
    return shapes.empty() ? round_shape(dimension, radii[k]) : shapes[k];
  }
  /// True if the outline of particle k is a circle, so that a turn does not change it.
  bool is_round(std::size_t k) const {
    assert(shapes.empty() || k < shapes.size());
    return shapes.empty() || shapes[k].is_round();
  }
  /// True if the outline of a particle is no circle.
  bool has_other_shapes() const {
    return std::ranges::any_of(shapes, [](const Shape& shape) { return !shape.is_round(); });
  }
  /// The shape of particle k at its place, which `shift` [L] is added to, or of a sphere on the
  /// axis with its centre at (0, z). Particles that are not round must have angles.
  PlacedShape placed_shape(std::size_t k, const Vector& shift = {}) const {
    return placed_shape(k, angles, shift);
  }
  /// The same with other angles of all particles [rad].
  PlacedShape placed_shape(std::size_t k, std::span<const double> at_angles,
                           const Vector& shift = {}) const;
  /// Velocity of particle k [L/T].
  Vector velocity(std::size_t k) const { return point_of(velocities.data(), k, dimension); }
};

/// The result is -1 without particles.
inline std::int32_t largest_id(const Particles& particles) {
  return particles.ids.empty() ? static_cast<std::int32_t>(particles.count()) - 1
                               : std::ranges::max(particles.ids);
}

/// How many ids (numbers up to 2^31 - 1) are larger than largest_id().
inline std::size_t ids_left(const Particles& particles) {
  return static_cast<std::size_t>(std::int64_t{std::numeric_limits<std::int32_t>::max()} -
                                  largest_id(particles));
}

/// If `ids` is not empty but shorter than count(), the particles without an id get the largest id
/// so far plus 1, 2, ...
inline void add_missing_ids(Particles& particles) {
  assert(particles.ids.size() + ids_left(particles) >= particles.count());
  if (particles.ids.empty()) return;
  auto largest = largest_id(particles);
  while (particles.ids.size() < particles.count()) particles.ids.push_back(++largest);
}

std::vector<Shape> shapes_of(const Particles& particles);

/// Extends Particles::shapes, if it is not empty, to all particles: the others are discs.
void add_missing_shapes(Particles& particles);

/// Extends the arrays of rotation to all discs or spheres, so that all can turn. Existing entries
/// stay. The new entries say that a particle does not turn, has not turned since the start, and has
/// the moment of inertia of its homogeneous shape.
void add_rotation(Particles& particles);

/// The mean radius [L], to which residuals of solvers and overlaps are compared; 1 without
/// particles.
inline double mean_radius(const Particles& particles) {
  if (particles.count() == 0) return 1;
  double sum = 0;
  for (const double radius : particles.radii) sum += radius;
  return sum / static_cast<double>(particles.count());
}

/// w, x, y, z.
using Quaternion = std::array<double, 4>;

/// The orientation after `from` and a rotation by |turn| [rad] about the direction of `turn`, whose
/// components are along the fixed axes. The result has length 1; it is NaN if `from` is 0.
Quaternion turned(const Quaternion& from, const Vector& turn);

/// The vector `a` after the rotation `q`, a quaternion of length 1.
Vector rotated(const Quaternion& q, const Vector& a);

/// Number of components of a rotation: 1 for discs, 3 for spheres.
constexpr std::size_t turn_components(int dimension) { return dimension == 3 ? 3 : 1; }

/// Turns all particles by `turns` [rad], turn_components() numbers for each particle, in a step of
/// length h [T], and sets their angular velocities to turns/h [1/T].
void turn_particles(Particles& particles, std::span<const double> turns, double h);

}  // namespace viscontact::particles
