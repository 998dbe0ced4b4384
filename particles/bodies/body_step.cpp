// Free motion and constrained motion of rigid bodies (body_step.hpp). Numbers are in the units of
// the case. Nothing is thrown: a turn that does not converge is taken as it is. A change must keep
// the angular momentum to rounding errors.
#include "viscontact/particles/bodies/body_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viscontact/particles/rotation.hpp"

namespace viscontact::particles {
namespace {

Matrix3 scaled(double factor, Matrix3 a) {
  for (auto& x : a) x *= factor;
  return a;
}

/// Turn [rad] of the implicit midpoint rule in space: the fixed point of turn = h I^-1 L, with the
/// angular momentum L and the moment of inertia I after half of the turn.
Vector midpoint_turn(const RigidBody& body, const Vector& angular_momentum, double h) {
  Vector turn = h * (inverse_of(present_inertia(body, 3)) * angular_momentum);
  // Each iteration multiplies the error by about the turn in radians. A step in which a body turns
  // by a radian does not resolve the motion, so that its iteration need not converge.
  constexpr int kMost = 50;
  constexpr double kExact = 4 * std::numeric_limits<double>::epsilon();
  for (int n = 0; n < kMost; ++n) {
    RigidBody middle = body;
    middle.orientation = turned(body.orientation, 0.5 * turn);
    const Vector next = h * (inverse_of(present_inertia(middle, 3)) * angular_momentum);
    const double change = norm(next - turn);
    turn = next;
    if (change <= kExact * norm(turn)) break;
  }
  return turn;
}

}  // namespace

BodyStep free_step(const RigidBody& body, const BodyLoad& load, double h, double kick,
                   int dimension) {
  BodyStep step;
  step.mobility = h / body.mass;
  step.displacement = h * (body.velocity + (kick / body.mass) * load.force);
  step.angular_momentum = body.angular_momentum + kick * load.torque;
  if (dimension == 3) {
    const auto inertia = present_inertia(body, dimension);
    step.inverse_turn_mobility = scaled(1 / h, inertia);
    step.turn_mobility = scaled(h, inverse_of(inertia));
    step.turn = midpoint_turn(body, step.angular_momentum, h);
  } else {
    step.inverse_turn_mobility[8] = body.inertia[8] / h;
    step.turn_mobility[8] = h / body.inertia[8];
    step.turn[2] = step.turn_mobility[8] * step.angular_momentum[2];
  }
  return step;
}

void constrain(BodyStep& step, const Vector& displacement, const Vector& turn, int dimension) {
  const Vector change = turn - step.turn;
  if (dimension == 3)
    step.angular_momentum = step.angular_momentum + step.inverse_turn_mobility * change;
  else
    step.angular_momentum[2] = step.inverse_turn_mobility[8] * turn[2] + step.late_momentum[2];
  step.displacement = displacement;
  step.turn = turn;
}

Vector displacement_at(const Vector& displacement, const Vector& turn, const Vector& arm,
                       int dimension) {
  if (dimension == 3) return displacement + rotated(turned({1, 0, 0, 0}, turn), arm) - arm;
  // 1 - cos is computed by the sine of half the angle, without cancellation.
  const double s = std::sin(turn[2]), half = std::sin(turn[2] / 2), c1 = -2 * half * half;
  return {displacement[0] + c1 * arm[0] - s * arm[1], displacement[1] + s * arm[0] + c1 * arm[1],
          0};
}

void move_body(RigidBody& body, const BodyStep& step, double h, int dimension) {
  body.centre = body.centre + step.displacement;
  body.velocity = (1 / h) * step.displacement + step.late_velocity;
  body.angular_momentum = step.angular_momentum;
  if (dimension == 3)
    body.orientation = turned(body.orientation, step.turn);
  else
    body.angle[2] += step.turn[2];
  update_angular_velocity(body, dimension);
}

}  // namespace viscontact::particles
