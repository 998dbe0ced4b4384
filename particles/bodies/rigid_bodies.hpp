// Rigid bodies of several discs or spheres, which keep their places in the body, and their motion
// in a time step, docs/physics.md (5.11). Lengths, masses and times are in any consistent units.
// `dimension` is 2 or 3; in the plane only the third component of turns, torques and angular
// momenta is used. The restart file stores the motion of the bodies (io/restart.cpp); the case
// gives all else. Nothing is checked or thrown here; particles/case checks the bodies. Simulations,
// constraints, blows, links and particles.hpp use it. Without force, torque and constraints,
// momentum and angular momentum must stay constant to rounding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

struct Particles;

/// A matrix of three rows, row by row.
using Matrix3 = std::array<double, 9>;

/// Product of a matrix and a vector.
inline Vector operator*(const Matrix3& a, const Vector& x) {
  return {a[0] * x[0] + a[1] * x[1] + a[2] * x[2], a[3] * x[0] + a[4] * x[1] + a[5] * x[2],
          a[6] * x[0] + a[7] * x[1] + a[8] * x[2]};
}

/// A body whose members are particles. Their masses and moments of inertia are part of its own, and
/// forces and torques on them act on it.
struct RigidBody {
  std::vector<std::int32_t> members;  ///< numbers of particles, increasing, at least one
  std::vector<Vector> offsets;        ///< of the members' centres from `centre` at the start [L]
  /// Orientations of the members relative to the body: their angles at the start [rad] in value[2]
  /// for discs; not used for spheres, whose orientation at the start is that of the body.
  std::vector<double> member_angles;
  double mass = 0;  ///< [M], > 0; >= 0 in a fluid
  /// About the centre, in the axes of the start [M L^2]. Discs use only the last entry.
  Matrix3 inertia{};
  // The motion.
  Vector centre{};    ///< centre of mass [L]
  Vector velocity{};  ///< of the centre [L/T]
  /// Discs: the angle by which the body has turned since the start, in value[2] [rad].
  Vector angle{};
  /// Spheres: the orientation as a unit quaternion (w, x, y, z), 1 at the start.
  std::array<double, 4> orientation{1, 0, 0, 0};
  /// About the centre [M L^2/T]; of discs only value[2]. It is constant where no torque acts, which
  /// the angular velocity in space is not.
  Vector angular_momentum{};
  Vector angular_velocity{};  ///< [1/T]; of discs only value[2]
};

/// The rigid bodies of a case, and which particle belongs to which.
struct RigidBodies {
  std::vector<RigidBody> bodies;  ///< in the order of the case
  /// Number of the body of each particle, -1: none. Empty if there are no bodies.
  std::vector<std::int32_t> of_particle;

  bool empty() const { return bodies.empty(); }        ///< whether there are no bodies
  std::size_t count() const { return bodies.size(); }  ///< number of bodies
  /// The body of a particle; -1 if it belongs to none.
  std::int32_t body_of(std::int32_t particle) const {
    return of_particle.empty() ? -1 : of_particle[static_cast<std::size_t>(particle)];
  }
  /// True if both particles belong to one body, so that they do not touch each other. In a periodic
  /// cell neither do their images, because a body is smaller than the cell.
  bool are_one(std::int32_t first, std::int32_t second) const {
    const auto body = body_of(first);
    return body >= 0 && body == body_of(second);
  }
};

/// What a case says about a body.
struct RigidBodyRequest {
  std::vector<std::int32_t> members;  ///< numbers of particles, at least one, each only once
  double mass = -1;                   ///< [M]; < 0: the sum of the members' masses
  /// About the centre of mass [M L^2]; < 0: that of the members at their places, whose masses and
  /// moments are scaled if `mass` is given. In space only < 0.
  double moment_of_inertia = -1;
};

/// Adds a body with the members at their present places, velocities and angles. Its centre is the
/// centre of mass of the members (the mean of their centres if none has a mass), its velocity and
/// angular momentum are those of the members together, and their velocities become those of the
/// rigid motion. In a periodic cell (Particles::cell) those images of the members make the body
/// with which it is shortest along each axis: along the axis the members, with their images, leave
/// distances between neighbours, and the body does not reach across the largest one. It must be
/// smaller than the cell (diameter()). If two distances are the largest (ambiguous_images()), the
/// images depend on the order of the particles. The velocities are those of the images. The
/// particles must turn (add_rotation), unless their dimension is 1, and belong to no other body.
void add_rigid_body(Particles& particles, const RigidBodyRequest& request);

/// An axis of a periodic cell along which members do not determine which images make the body.
struct AmbiguousImages {
  std::size_t axis = 0;  ///< 0: x, 1: y
  double distance = 0;   ///< largest distance between neighbours, which occurs repeatedly [L]
};

/// The first axis along which particles that shall be a body do not determine their images
/// (add_rigid_body); nothing if they determine them, or if the cell is not periodic.
std::optional<AmbiguousImages> ambiguous_images(const Particles& particles,
                                                const std::vector<std::int32_t>& members);

/// Diameter of the circle or sphere about the centre of a body that contains its members [L].
double diameter(const RigidBody& body, const Particles& particles);

/// Numbers of periods from the present place of member number `m` to its image in the body.
Periods periods_of_member(const RigidBody& body, std::size_t m, const Particles& particles);

/// Vector from the centre of a body to the centre of its member number `m` [L].
Vector present_offset(const RigidBody& body, std::size_t m, int dimension);

/// The number of a particle, from 0, among the members of its body.
std::size_t member_number(const RigidBody& body, std::int32_t particle);

/// Vector from the centre of its body to the centre of a particle [L]; 0 without a body.
Vector offset_in_body(const Particles& particles, std::int32_t particle);

/// The vector `at_start`, which is fixed to the body, in the present orientation of the body.
Vector turned_with(const RigidBody& body, const Vector& at_start, int dimension);

/// The present moment of inertia about the centre in the axes of space [M L^2]; of discs the last
/// entry.
Matrix3 present_inertia(const RigidBody& body, int dimension);

/// Sets the angular velocity from the angular momentum. A body without inertia keeps it.
void update_angular_velocity(RigidBody& body, int dimension);

/// The masses of the members [M], scaled so that their sum is that of the body. Equal parts of it
/// if no member has a mass.
std::vector<double> member_masses(const RigidBody& body, const Particles& particles);

/// Sets positions, velocities, orientations and angular velocities of all members to those of their
/// bodies. In a periodic cell, the centres come to their images in the cell, unless it is sheared.
void place_members(Particles& particles);

/// Inverse of a symmetric positive definite matrix.
Matrix3 inverse_of(const Matrix3& a);

/// Mean force on a body in a step, and mean torque about its centre.
struct BodyLoad {
  Vector force{};   ///< [M L/T^2]
  Vector torque{};  ///< [M L^2/T^2]
};

/// The motion of a body in a step of length h, with its velocity u, angular velocity w, mass m and
/// moment of inertia I: first the motion without constraints, then that of the solution.
struct BodyStep {
  Vector displacement{};      ///< h u of the centre [L]
  Vector turn{};              ///< h w [rad]; of discs value[2]
  Vector angular_momentum{};  ///< at the end [M L^2/T]
  /// Velocity of the centre at the end of the step less displacement/h [L/T]. It is 0 unless blows
  /// (impacts/) changed the velocity within the step.
  Vector late_velocity{};
  /// In the plane: angular momentum at the end less I turn/h [M L^2/T]; 0 without blows.
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
