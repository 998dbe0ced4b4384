// Rigid bodies of several discs or spheres and their motion, docs/physics.md (5.11). `dimension` is
// 2 (discs) or 3 (spheres); discs use only component 2 of turns, torques and angular momenta.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

struct Particles;

/// Three rows and columns, row by row.
using Matrix3 = std::array<double, 9>;

inline Vector operator*(const Matrix3& a, const Vector& x) {
  return {a[0] * x[0] + a[1] * x[1] + a[2] * x[2], a[3] * x[0] + a[4] * x[1] + a[5] * x[2],
          a[6] * x[0] + a[7] * x[1] + a[8] * x[2]};
}
inline Matrix3 operator+(Matrix3 a, const Matrix3& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

/// Restart files store all members of this struct; the rest of RigidBody comes from the case.
struct BodyMotion {
  Vector centre{};    ///< of mass [L]
  Vector velocity{};  ///< of the centre [L/T]
  /// Discs: the angle since the start, in component 2 [rad].
  Vector angle{};
  /// Spheres: the orientation as a unit quaternion (w, x, y, z), 1 at the start.
  std::array<double, 4> orientation{1, 0, 0, 0};
  /// About the centre [M L^2/T]. It is constant where no torque acts, unlike the angular velocity
  /// in three dimensions.
  Vector angular_momentum{};
  Vector angular_velocity{};  ///< [1/T]
};

/// A body of particles, its members. "At the start" means when add_rigid_body() made the body.
struct RigidBody : BodyMotion {
  std::vector<std::int32_t> members;  ///< numbers of particles, increasing
  /// From `centre` to the centre of each member at the start [L].
  std::vector<Vector> offsets;
  /// Of each disc at the start [rad].
  std::vector<double> member_angles;
  double mass = 0;  ///< [M], > 0; in a fluid it may be 0
  /// About the centre, with the orientation at the start [M L^2]. It is positive definite, or 0 for
  /// a body without a mass; discs use only the last entry.
  Matrix3 inertia{};
};

struct RigidBodies {
  std::vector<RigidBody> bodies;
  /// For each particle the number of its body, -1: none. Empty if there are no bodies.
  std::vector<std::int32_t> of_particle;

  bool empty() const { return bodies.empty(); }
  std::size_t count() const { return bodies.size(); }
  /// The result is -1 if the particle belongs to no body.
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

struct RigidBodyRequest {
  std::vector<std::int32_t> members;  ///< each only once
  double mass = -1;                   ///< [M]; < 0: the sum of the members' masses
  /// About the centre of mass [M L^2]; < 0: that of the members at their places, whose masses and
  /// moments are scaled if `mass` is given. For spheres it must be < 0.
  double moment_of_inertia = -1;
};

/// Adds a body with the members, which must turn (add_rotation()), at their present places. Its
/// centre is their centre of mass (the mean of their centres if none has a mass), and its velocity
/// and angular momentum are those of the members together, whose velocities then become those of
/// the rigid motion. In a periodic cell it consists of the images with which it is shortest along
/// each axis; if several choices are equally short (ambiguous_images()), the choice depends on the
/// order of the particles. The diameter() must be less than the periods.
void add_rigid_body(Particles& particles, const RigidBodyRequest& request);

struct AmbiguousImages {
  std::size_t axis = 0;  ///< 0: x, 1: y, 2: z
  double distance = 0;   ///< largest between neighbours, which occurs repeatedly [L]
};

/// The first axis along which the images of these members are ambiguous; the body need not exist
/// yet.
std::optional<AmbiguousImages> ambiguous_images(const Particles& particles,
                                                const std::vector<std::int32_t>& members);

/// The diameter of the smallest circle or sphere about the centre that contains all members [L].
double diameter(const RigidBody& body, const Particles& particles);

/// The number of periods along each axis from the position of member `m` to its image in the body.
Periods periods_of_member(const RigidBody& body, std::size_t m, const Particles& particles);

/// The present vector from the centre of a body to the centre of its member `m` [L].
Vector present_offset(const RigidBody& body, std::size_t m, int dimension);

/// Their number if `particle` is no member.
std::size_t member_number(const RigidBody& body, std::int32_t particle);

/// The vector from the centre of its body to a particle [L]; 0 for a particle without a body.
Vector offset_in_body(const Particles& particles, std::int32_t particle);

/// The present value of a vector that is fixed to the body and was `at_start` at the start.
Vector turned_with(const RigidBody& body, const Vector& at_start, int dimension);

/// About the centre [M L^2]; of discs only the last entry counts.
Matrix3 present_inertia(const RigidBody& body, int dimension);

/// The angular velocity stays as it is if the last entry of the inertia is 0.
void update_angular_velocity(RigidBody& body, int dimension);

/// The masses are scaled so that their sum is that of the body [M]. If none is > 0, all are equal.
std::vector<double> member_masses(const RigidBody& body, const Particles& particles);

/// Sets the motions of all members to those that follow from their bodies. In a periodic cell that
/// is not sheared, the centres of bodies are first moved into the cell.
void place_members(Particles& particles);

/// `a` is symmetric. If it is singular, entries are infinite or NaN.
Matrix3 inverse_of(const Matrix3& a);

Matrix3 scaled(double factor, Matrix3 a);

struct ForceAtArm {
  Vector force{};  ///< [M L/T^2]
  Vector arm{};    ///< from the centre of the body to the point [L]
};

struct BodyLoad {
  Vector force{};                    ///< [M L/T^2]
  Vector torque{};                   ///< [M L^2/T^2]
  std::vector<ForceAtArm> forces{};  ///< on members; `force` and `torque` contain them
  /// Positive semidefinite stiffness against turns that the forces have in the step, (5.21) [M
  /// L^2/T^2], times the parameter of Newmark's method; of discs the last entry.
  Matrix3 stiffness{};
};

/// The motion of a body in a step of length h, with its velocity u, angular velocity w, mass m and
/// moment of inertia I. free_step() makes that without contacts and links, constrain() that with
/// them.
struct BodyStep {
  Vector displacement{};      ///< h u of the centre [L]
  Vector turn{};              ///< h w [rad]
  Vector angular_momentum{};  ///< at the end of the step [M L^2/T]
  /// Velocity of the centre at the end of the step minus displacement/h [L/T]; 0 without rebounds.
  Vector velocity_excess{};
  /// For discs: angular momentum at the end of the step minus I turn/h [M L^2/T]; 0 without
  /// rebounds.
  Vector momentum_excess{};
  double mobility = 0;  ///< h/m [T/M]
  /// h J^-1 with J = I + h impulse_time BodyLoad::stiffness [T/(M L^2)]; discs use only the last
  /// entry.
  Matrix3 turn_mobility{};
  Matrix3 inverse_turn_mobility{};  ///< J/h [M L^2/T]
  Matrix3 momentum_of_turn{};       ///< I/h [M L^2/T]
};

/// The motion without contacts and links in a step of length `h`. `load` acts for the time
/// `impulse_time` [T], which is h, or another time with the leapfrog scheme
/// (Simulation::impulse_time_of()), and its stiffness on the turn minus h w, in the first step of a
/// simulation (`is_first`) on the turn. Without a moment of inertia the result is infinite or NaN.
/// The turn of spheres is that of the implicit midpoint rule, h w = h I^-1 L with the angular
/// momentum L and I after half of the turn; for turns of more than about half a radian its
/// iteration of 50 rounds may not converge.
BodyStep free_step(const RigidBody& body, const BodyLoad& load, double h, double impulse_time,
                   bool is_first, int dimension);

/// Replaces displacement [L] and turn [rad] by those with contacts and links, and adds the moments
/// of their impulses to the angular momentum.
void constrain(BodyStep& step, const Vector& displacement, const Vector& turn, int dimension);

/// Displacement [L] of the point at `arm` [L] from the centre of a body that moves by
/// `displacement` and turns by `turn` [rad].
Vector displacement_at(const Vector& displacement, const Vector& turn, const Vector& arm,
                       int dimension);

/// Moves a body by a step of length h > 0 [T]. place_members() then moves its members.
void move_body(RigidBody& body, const BodyStep& step, double h, int dimension);

}  // namespace viscontact::particles
