// Units and rows of contacts in a ConstraintProblem, docs/physics.md (5.6) to (5.9).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "viscontact/constraint_rows/solver_names.hpp"
#include "viscontact/contact_solver/problem/constraint_problem.hpp"
#include "viscontact/contact_solver/problem/dual_problem.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// A particle in no rigid body, with h/m [T/M] and h/I [T/(M L^2)], both 0 if its motion is given.
/// Without contacts and links it moves by D numbers `displacement` [L] and kTurns numbers `turn`
/// [rad].
template <int D>
RigidUnit<D> unit_of_particle(double mobility, double turn_mobility, const double* displacement,
                              const double* turn);

template <int D>
RigidUnit<D> unit_of_body(const BodyStep& free);

template <int D>
ContactBounds bounds_of(const Contact<D>& contact) {
  return {contact.w, contact.impulse, contact.lowest, contact.allowed};
}

template <int D>
struct ContactTangents {
  /// Unit vectors at right angles to the normal and to each other.
  std::array<Vector, static_cast<std::size_t>(D - 1)> directions;
  /// The centres of the circles that touch both surfaces, from those of the particles [L]; 0 for
  /// discs, spheres and obstacles.
  std::array<Vector, 2> centres{};
  double first_arm =
             0,        ///< from the centre of the first circle to the contact [L]; 0 at an obstacle
      second_arm = 0;  ///< from the centre of the second circle to the contact [L], > 0
  Vector surface{};    ///< displacement of an obstacle at the contact point in the step [L]
  double capacity = 0;
};

/// The tangents and arms of a contact in a step from `begin` to `end` > `begin` [T]. Both arms end
/// at one point, so that impulses do not change the angular momentum of the pair. The caller must
/// set `capacity`.
template <int D>
ContactTangents<D> tangents_of(const Contact<D>& contact, const Particles& particles,
                               std::span<const Plane> obstacles, double begin, double end);

/// The coefficients with which a row is the displacement [L], along the unit vector `direction`, of
/// the point of a unit at the vector `arm` [L] from its centre.
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

struct ContactSide {
  std::int32_t unit = -1;  ///< place in ConstraintProblem::units; -1: its motion is given
  Vector offset{};         ///< from the centre of the unit to that of the particle [L]
  Vector displacement{},   ///< of a particle whose motion is given, in the step [L]
      turn{};              ///< of such a particle [rad], of a disc in component 2
};

/// Adds row `k` of a contact with the guess `impulse` [M L/T]: 0 is the gap, k from 1 to D - 1 the
/// displacement of the second surface relative to the first one along tangents.directions[k - 1]. A
/// plane under a load moves along its normal only. Sides without a unit add their given motions to
/// the offset.
template <int D>
void add_contact_row(const Contact<D>& contact, const ContactTangents<D>& tangents,
                     const ContactSide& first, const ContactSide& second, std::size_t k,
                     double impulse, ConstraintProblem<D>& problem);

}  // namespace viscontact::particles
