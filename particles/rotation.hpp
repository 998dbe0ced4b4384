// Rotations in space as unit quaternions (w, x, y, z), and the rotation of particles in a step.
// Turns and angles are in radians; a quaternion has no dimension. Simulations, bodies and blows use
// it. Nothing is checked. A change must keep quaternions at length 1.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// The components w, x, y, z of a quaternion. A rotation has w^2 + x^2 + y^2 + z^2 = 1.
using Quaternion = std::array<double, 4>;

/// The orientation that `from` has after a rotation by |turn| [rad] about the vector `turn`, which
/// is given in the fixed frame. The result has length 1.
Quaternion turned(const Quaternion& from, const Vector& turn);

/// The vector `a` in the orientation `q`, whose length is 1.
Vector rotated(const Quaternion& q, const Vector& a);

/// Number of components of a rotation: 1 for discs, 3 for spheres.
constexpr std::size_t turn_components(int dimension) { return dimension == 3 ? 3 : 1; }

/// Turns all particles by `turns` [rad], turn_components() numbers for each particle, in a step of
/// length h [T], and sets their angular velocities.
void turn_particles(Particles& particles, std::span<const double> turns, double h);

}  // namespace viscontact::particles
