// The motion of rigid bodies in a time step, docs/physics.md (5.11). Lengths, masses and times are
// in the units of the case. `dimension` is 2 or 3; in the plane only the third component of turns,
// torques and angular momenta is used. Simulation, constraints, blows and links use it. Without
// force, torque and constraints, momentum and angular momentum must stay constant to rounding.
#pragma once

#include <vector>

#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// Mean force on a body in a step, and mean torque about its centre.
struct BodyLoad {
  Vector force{};   ///< [M L/T^2]
  Vector torque{};  ///< [M L^2/T^2]
};

/// The motion of a body in a step of length h, with its velocity u, angular velocity w, mass m and
/// moment of inertia I: before the constraints are solved the motion without them, afterwards that
/// of the solution.
struct BodyStep {
  Vector displacement{};      ///< h u of the centre [L]
  Vector turn{};              ///< h w [rad]; of discs only component 2
  Vector angular_momentum{};  ///< at the end [M L^2/T]
  /// Velocity of the centre at the end of the step minus displacement/h [L/T]. It is 0 unless blows
  /// (impacts/) changed the velocity within the step.
  Vector late_velocity{};
  /// In the plane: angular momentum at the end minus I turn/h [M L^2/T]; 0 without blows.
  Vector late_momentum{};
  double mobility = 0;              ///< h/m [T/M]
  Matrix3 turn_mobility{};          ///< h I^-1 [T/(M L^2)]; discs use only the last entry
  Matrix3 inverse_turn_mobility{};  ///< I/h [M L^2/T]
};

/// The motion without constraints of a body with mass and inertia in a step of length `h`, where
/// `load` acts on its velocities for the time `kick` [T].
///
/// In space the turn is that of the implicit midpoint rule: h w = h I^-1 L, with the moment of
/// inertia I after half of the turn and the angular momentum L, which is constant where no torque
/// acts.
BodyStep free_step(const RigidBody& body, const BodyLoad& load, double h, double kick,
                   int dimension);

/// Replaces the motion of a step by that of the solution of the constraints. Their impulses change
/// the angular momentum.
void constrain(BodyStep& step, const Vector& displacement, const Vector& turn, int dimension);

/// Displacement [L] of a point of a body that is at `arm` [L] from its centre: that of the centre
/// and the change of `arm` when it turns by `turn`.
Vector displacement_at(const Vector& displacement, const Vector& turn, const Vector& arm,
                       int dimension);

/// Moves a body by a step of length h > 0 [T]. Its members stay where they are until
/// place_members() is called.
void move_body(RigidBody& body, const BodyStep& step, double h, int dimension);

}  // namespace viscontact::particles
