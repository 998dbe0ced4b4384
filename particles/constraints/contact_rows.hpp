// The rows of a contact with friction in the constraint problem of a step, docs/physics.md (5.6).
// Lengths [L] and impulses [M L/T] are in the units of the case. constraint_system.hpp and the
// blows use them; nothing is thrown. A change must keep the angular momentum of a pair.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/domain/plane.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// What the tangential rows of a contact need besides the contact.
template <int D>
struct ContactTangents {
  std::array<Vector, static_cast<std::size_t>(D - 1)> directions;  ///< unit vectors
  /// Distances of the contact point from the centres of both particles [L].
  double first_arm = 0,  ///< from the centre of the first particle
      second_arm = 0;    ///< from the centre of the second particle
  Vector surface{};      ///< displacement of the surface of the obstacle in the step [L]
  double capacity = 0;   ///< ConstraintBlock::capacity
};

/// The tangents of a contact in a step from time `begin` to `end` [T]; `capacity` is left 0.
template <int D>
ContactTangents<D> tangents_of(const Contact<D>& contact, const Particles& particles,
                               std::span<const Plane> obstacles, double begin, double end);

/// Part of a row for one unit: the displacement along `direction` of the point that is at `arm` [L]
/// from the centre of the unit.
template <int D>
Motion<D> displacement_row(const Vector& direction, const Vector& arm) {
  Motion<D> row{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(D); ++d) row[d] = direction[d];
  const Vector moment = cross(arm, direction);
  if constexpr (D == 2)
    row[2] = moment[2];
  else
    for (std::size_t d = 0; d < 3; ++d) row[3 + d] = moment[d];
  return row;
}

/// A particle of a contact as a part of its unit.
struct ContactSide {
  std::int32_t unit = -1;  ///< -1: an obstacle
  Vector offset{};         ///< from the centre of the unit to that of the particle [L]
};

/// Adds row number `k` of a contact, with a guess of its impulse [M L/T]: its gap (0), or the
/// tangential displacement of the surface of the second particle relative to that of the first
/// along direction `k` - 1.
template <int D>
void add_contact_row(const Contact<D>& contact, const ContactTangents<D>& tangents,
                     const ContactSide& first, const ContactSide& second, std::size_t k,
                     double impulse, ConstraintProblem<D>& problem);

}  // namespace viscontact::particles
