// Shapes at their places, and rotations by unit quaternions.
#include "viscontact/particles/state/particles.hpp"

#include <cassert>
#include <cmath>

namespace viscontact::particles {

PlacedShape Particles::placed_shape(std::size_t k, std::span<const double> at_angles,
                                    const Vector& shift) const {
  assert(k < count() && dimension < 3);
  const Vector x = position(k) + shift;
  const Vector2 centre = dimension == 1 ? Vector2{0, x[0]} : Vector2{x[0], x[1]};
  if (is_round(k)) return {shape(k), centre};
  assert(k < at_angles.size());
  return PlacedShape::at_angle(shapes[k], centre, at_angles[k]);
}

std::vector<Shape> shapes_of(const Particles& particles) {
  std::vector<Shape> shapes;
  for (std::size_t k = 0; k < particles.count(); ++k) shapes.push_back(particles.shape(k));
  return shapes;
}

void add_missing_shapes(Particles& particles) {
  if (particles.shapes.empty()) return;
  for (auto k = particles.shapes.size(); k < particles.count(); ++k)
    particles.shapes.push_back(Shape::disc(particles.radii[k]));
}

Quaternion turned(const Quaternion& from, const Vector& turn) {
  const double angle = norm(turn);
  // sin(angle/2)/angle is 1/2 within rounding errors below this angle [rad].
  constexpr double kSmall = 1e-8;
  const double factor = angle > kSmall ? std::sin(angle / 2) / angle : 0.5;
  const double c = std::cos(angle / 2);
  const Vector s = factor * turn, v = {from[1], from[2], from[3]};
  const Vector sum = c * v + from[0] * s + cross(s, v);
  Quaternion to = {c * from[0] - dot(s, v), sum[0], sum[1], sum[2]};
  double square = 0;
  for (const double x : to) square += x * x;
  for (auto& x : to) x /= std::sqrt(square);
  return to;
}

Vector rotated(const Quaternion& q, const Vector& a) {
  const Vector v = {q[1], q[2], q[3]};
  const Vector t = 2 * cross(v, a);
  return a + q[0] * t + cross(v, t);
}

void turn_particles(Particles& particles, std::span<const double> turns, double h) {
  assert(h > 0);
  assert(turns.size() == particles.count() * turn_components(particles.dimension));
  assert(particles.angular_velocities.size() == turns.size());
  for (std::size_t k = 0; k < turns.size(); ++k) particles.angular_velocities[k] = turns[k] / h;
  if (particles.dimension != 3) {
    for (std::size_t k = 0; k < turns.size(); ++k) particles.angles[k] += turns[k];
    return;
  }
  for (std::size_t k = 0; k < particles.count(); ++k) {
    const Vector turn = {turns[3 * k], turns[3 * k + 1], turns[3 * k + 2]};
    double* at = &particles.orientations[4 * k];
    const auto to = turned({at[0], at[1], at[2], at[3]}, turn);
    for (std::size_t i = 0; i < to.size(); ++i) at[i] = to[i];
  }
}

void add_rotation(Particles& particles) {
  assert(particles.dimension == 2 || particles.dimension == 3);
  const auto count = particles.count();
  particles.angular_velocities.resize(count * turn_components(particles.dimension), 0.0);
  if (particles.dimension == 3)
    for (std::size_t k = particles.orientations.size() / 4; k < count; ++k)
      particles.orientations.insert(particles.orientations.end(), {1, 0, 0, 0});
  else
    particles.angles.resize(count, 0.0);
  for (std::size_t k = particles.inertias.size(); k < count; ++k)
    particles.inertias.push_back(particles.shape(k).inertia(particles.masses[k]));
}

}  // namespace viscontact::particles
