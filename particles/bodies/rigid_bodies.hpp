// Makes rigid bodies of several discs or spheres, and moves them in a time step (docs/physics.md
// (5.11)). The particles keep their places in the body. Lengths, masses and times are in any
// consistent units. `dimension` is 2 (discs) or 3 (spheres); for discs only component 2 of turns,
// torques and angular momenta is used. The number of a particle or body is its place in its array,
// from 0. Nothing is checked or thrown here; particles/case checks the bodies. simulation.hpp,
// particles.hpp, constraints/, dual_problem/, fluid/, impacts/ and links/ use it. io/restart.cpp
// stores BodyMotion in restart files; the rest of RigidBody comes from the case file. A change must
// keep that, and that momentum and angular momentum stay constant to rounding without force, torque
// and constraints.
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

/// A matrix of three rows and columns, row by row.
using Matrix3 = std::array<double, 9>;

/// Product of a matrix and a vector; its unit is the product of their units.
inline Vector operator*(const Matrix3& a, const Vector& x) {
  return {a[0] * x[0] + a[1] * x[1] + a[2] * x[2], a[3] * x[0] + a[4] * x[1] + a[5] * x[2],
          a[6] * x[0] + a[7] * x[1] + a[8] * x[2]};
}

/// The place, orientation and motion of a rigid body. Restart files store all its members.
struct BodyMotion {
  Vector centre{};    ///< centre of mass [L]
  Vector velocity{};  ///< of the centre [L/T]
  /// Discs: the angle by which the body has turned since the start, in component 2 [rad].
  Vector angle{};
  /// Spheres: the orientation as a unit quaternion (w, x, y, z), 1 at the start.
  std::array<double, 4> orientation{1, 0, 0, 0};
  /// Angular momentum about the centre [M L^2/T]; of discs only component 2. It is constant where
  /// no torque acts, unlike the angular velocity in three dimensions.
  Vector angular_momentum{};
  Vector angular_velocity{};  ///< [1/T]; of discs only component 2 is used
};

/// A body that consists of particles, its members. Forces and torques on members act on the body.
/// "At the start" means when add_rigid_body() made the body.
struct RigidBody : BodyMotion {
  std::vector<std::int32_t> members;  ///< numbers of particles, increasing, at least one
  /// For each member the vector from `centre` to the centre of the member at the start [L].
  std::vector<Vector> offsets;
  /// Angle of each member at the start [rad]. Not used for spheres, which have the body's
  /// orientation.
  std::vector<double> member_angles;
  double mass = 0;  ///< [M], > 0; in a fluid it may be 0
  /// Moment of inertia about the centre, with the orientation at the start [M L^2]. It is positive
  /// definite, or 0 for a body without a mass; discs use only the last entry.
  Matrix3 inertia{};
};

/// The rigid bodies of a case, and which particle belongs to which.
struct RigidBodies {
  std::vector<RigidBody> bodies;  ///< in the order of the case
  /// For each particle the number of its body, -1: none. Empty if there are no bodies.
  std::vector<std::int32_t> of_particle;

  bool empty() const { return bodies.empty(); }        ///< whether there are no bodies
  std::size_t count() const { return bodies.size(); }  ///< number of bodies
  /// The number of the body of a particle; -1 if it belongs to none.
  std::int32_t body_of(std::int32_t particle) const {
    const auto k = static_cast<std::size_t>(particle);
    return k < of_particle.size() ? of_particle[k] : -1;
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
  double mass = -1;                   ///< [M], >= 0; < 0 stands for the sum of the members' masses
  /// Moment of inertia about the centre of mass [M L^2], >= 0. A number < 0 means that it is
  /// computed from the members at their places, whose masses and moments are scaled if `mass` is
  /// given. For spheres it must be < 0.
  double moment_of_inertia = -1;
};

/// Adds a body with the members at their present places, velocities and angles. Its centre is the
/// centre of mass of the members (the mean of their centres if none has a mass), and its velocity
/// and angular momentum are those of the members together. The velocities of the members are then
/// replaced by those of the rigid motion.
///
/// In a periodic cell (Particles::cell) the body consists of those images of the members with which
/// the body is shortest along each axis; the velocities are those of these images. The diameter()
/// of the body must be less than the periods, which is not checked. If several choices of images
/// are equally short (ambiguous_images()), the choice depends on the order of the particles.
///
/// The particles must turn (add_rotation() in particles.hpp) and belong to no other body.
void add_rigid_body(Particles& particles, const RigidBodyRequest& request);

/// An axis of a periodic cell along which several choices of images make a body equally short.
struct AmbiguousImages {
  std::size_t axis = 0;  ///< 0: x, 1: y, 2: z
  double distance = 0;   ///< the largest distance between neighbours, which occurs repeatedly [L]
};

/// The first axis along which the images of these members, at least one, are ambiguous; the body
/// need not exist yet. std::nullopt if the choice is unique along each axis, or if the cell is not
/// periodic.
std::optional<AmbiguousImages> ambiguous_images(const Particles& particles,
                                                const std::vector<std::int32_t>& members);

/// Diameter [L], > 0, of the smallest circle or sphere about the centre of a body that contains its
/// members.
double diameter(const RigidBody& body, const Particles& particles);

/// For each axis the number of periods from the position of member number `m` (from 0) to its image
/// in the body; 0 along axes without a period.
Periods periods_of_member(const RigidBody& body, std::size_t m, const Particles& particles);

/// The present vector from the centre of a body to the centre of its member number `m`, from 0 [L].
Vector present_offset(const RigidBody& body, std::size_t m, int dimension);

/// The place of particle number `particle`, from 0, among the members of `body`. If the particle is
/// not a member, the result is the number of members.
std::size_t member_number(const RigidBody& body, std::int32_t particle);

/// Vector from the centre of the body of a particle to the centre of the particle [L]; 0 for a
/// particle without a body.
Vector offset_in_body(const Particles& particles, std::int32_t particle);

/// The present value of a vector, of any unit, that is fixed to the body and was `at_start` at the
/// start.
Vector turned_with(const RigidBody& body, const Vector& at_start, int dimension);

/// The present moment of inertia about the centre [M L^2]; of discs only the last entry counts.
Matrix3 present_inertia(const RigidBody& body, int dimension);

/// Sets the angular velocity from the angular momentum. If the last entry of the inertia is 0, the
/// angular velocity stays as it is.
void update_angular_velocity(RigidBody& body, int dimension);

/// The masses of the members [M], scaled so that their sum is the mass of the body. If no member
/// has a mass, each gets an equal part of the mass of the body.
std::vector<double> member_masses(const RigidBody& body, const Particles& particles);

/// Sets positions, velocities, orientations and angular velocities of all members to those that
/// follow from their bodies. In a periodic cell that is not sheared, the centres of bodies are
/// first moved into the cell.
void place_members(Particles& particles);

/// Inverse of a symmetric positive definite matrix, in the inverse of its unit. If the matrix is
/// singular, entries of the result are infinite or NaN.
Matrix3 inverse_of(const Matrix3& a);

/// The product of a number and a matrix, in the product of their units.
Matrix3 scaled(double factor, Matrix3 a);

/// A force on a point of a body.
struct ForceAtArm {
  Vector force{};  ///< [M L/T^2]
  Vector arm{};    ///< vector from the centre of the body to the point [L]
};

/// Mean force on a body in a step, and mean torque about its centre.
struct BodyLoad {
  Vector force{};   ///< [M L/T^2]
  Vector torque{};  ///< [M L^2/T^2]
  std::vector<ForceAtArm> forces{};  ///< those on members, which `force` and `torque` contain
  /// Positive semidefinite stiffness against turns that the forces have in the step, (5.21)
  /// [M L^2/T^2], times the parameter of Newmark's method; of discs the last entry.
  Matrix3 stiffness{};
};

/// The motion of a body in a step of length h [T], with the velocity u [L/T], angular velocity w
/// [1/T], mass m [M] and moment of inertia I [M L^2] of the body. free_step() makes the motion
/// without contacts and links, and constrain() changes it to that with them.
struct BodyStep {
  Vector displacement{};      ///< h u of the centre [L]
  Vector turn{};              ///< h w [rad]; of discs only component 2
  Vector angular_momentum{};  ///< at the end of the step [M L^2/T]
  /// Velocity of the centre at the end of the step minus displacement/h [L/T]. It is 0 unless
  /// rebounds (impacts/) changed the velocity within the step.
  Vector late_velocity{};
  /// For discs: angular momentum at the end of the step minus moment of inertia times turn/h
  /// [M L^2/T]; 0 without rebounds.
  Vector late_momentum{};
  double mobility = 0;  ///< h/m [T/M]
  /// h J^-1 with J = I + h kick BodyLoad::stiffness [T/(M L^2)]; discs use only the last entry.
  Matrix3 turn_mobility{};
  Matrix3 inverse_turn_mobility{};  ///< J/h [M L^2/T]
  Matrix3 momentum_of_turn{};       ///< I/h [M L^2/T]
};

/// The motion of a body without contacts and links in a step of length `h` > 0 [T]. Mass and
/// inertia of the body must be > 0; with 0 the result is infinite or NaN. `load` changes momentum
/// and angular momentum by the load times `kick` [T], which is h, or another time with the leapfrog
/// scheme (Simulation::kick_length()), and by -kick BodyLoad::stiffness times the turn minus h w, in
/// the first step of a simulation (`is_first`) times the turn.
///
/// For spheres the turn is that of the implicit midpoint rule: h w = h I^-1 L, with the angular
/// momentum L and the moment of inertia I after half of the turn. If the iteration for the turn
/// does not converge in 50 rounds (for turns of more than about half a radian), its last value is
/// taken.
BodyStep free_step(const RigidBody& body, const BodyLoad& load, double h, double kick,
                   bool is_first, int dimension);

/// Replaces displacement [L] and turn [rad] of `step` by the arguments, which are those with
/// contacts and links, and adds the moments of the impulses of contacts and links to the angular
/// momentum.
void constrain(BodyStep& step, const Vector& displacement, const Vector& turn, int dimension);

/// Displacement [L] of a point of a body: the sum of the displacement of the centre and of the
/// change of the vector `arm` [L] from centre to point when it turns by `turn` [rad].
Vector displacement_at(const Vector& displacement, const Vector& turn, const Vector& arm,
                       int dimension);

/// Moves a body by a step of length h > 0 [T]. place_members() then moves its members.
void move_body(RigidBody& body, const BodyStep& step, double h, int dimension);

}  // namespace viscontact::particles
