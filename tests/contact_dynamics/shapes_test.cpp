// Ellipses and plates without a fluid: closed forms of rolling, rocking and impacts, and invariances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

constexpr double kGravity = 9.81;

/// Adds a homogeneous particle of a shape.
void add_shape(State& state, const Shape& shape, const Vector2& centre, double angle, double mass,
               const Vector2& velocity = {}, double spin = 0) {
  auto& p = state.particles;
  add_particle(state, {centre[0], centre[1], 0}, shape.bounding_radius(), mass,
               {velocity[0], velocity[1], 0});
  p.shapes.push_back(shape);
  p.angles.push_back(angle);
  p.angular_velocities.push_back(spin);
  p.inertias.push_back(shape.inertia(mass));
}

Setting setting_of(double h, double friction) {
  Setting setting;
  setting.time_step = h;
  setting.laws.film.gamma_min = 0.0;
  if (friction > 0) setting.laws.friction = FrictionLaw{friction};
  return setting;
}

Setting on_floor(double h, double friction) {
  auto setting = setting_of(h, friction);
  setting.planes = {plane_at_rest({}, {0, 1, 0})};
  setting.gravity = {0, -kGravity, 0};
  return setting;
}

/// Kinetic energy, also of turns.
double energy_of_motion(const Particles& p) {
  double sum = kinetic_energy(p);
  for (std::size_t k = 0; k < p.count(); ++k)
    sum += p.inertias[k] * p.angular_velocities[k] * p.angular_velocities[k] / 2;
  return sum;
}

/// The energy with gravity along -y.
double energy_of(const Particles& p) {
  double sum = energy_of_motion(p);
  for (std::size_t k = 0; k < p.count(); ++k)
    sum += p.masses[k] * kGravity * p.position(k)[1];
  return sum;
}

/// The period of an ellipse of semi-axes 2 and 1 that rocks on its flat side, from two passages
/// through angle 0.
double period_of_rocking(double h, double friction, double angle) {
  State state = no_particles(2);
  const auto shape = Shape::ellipse(2, 1);
  const double height = shape.support({std::sin(angle), std::cos(angle)});
  // It begins at rest with its lowest point on the floor.
  add_shape(state, shape, {0, height}, angle, 1.5);
  Simulation simulation(on_floor(h, friction), state, 1);
  std::vector<double> passages;
  double before = angle;
  while (passages.size() < 3) {
    const auto report = simulation.step(100);
    EXPECT_TRUE(report.converged) << report.time << " " << report.residual;
    const double now = simulation.state().particles.angles[0];
    if (before * now < 0) passages.push_back(report.time - h * now / (now - before));
    before = now;
    if (report.time > 50) return 0;
  }
  return passages[2] - passages[0];
}

TEST(Shapes, Probe) {
  const double m = 1.5, a = 2, b = 1, I = m * (a * a + b * b) / 4;
  const double smooth = 2 * std::numbers::pi * std::sqrt(I / (m * kGravity * (a * a / b - b)));
  const double rolls =
      2 * std::numbers::pi * std::sqrt((I + m * b * b) / (m * kGravity * (a * a / b - b)));
  for (const double h : {4e-3, 2e-3, 1e-3})
    std::printf("h %g: smooth %.9f (%.9f), rolls %.9f (%.9f)\n", h,
                period_of_rocking(h, 0, 1e-3), smooth, period_of_rocking(h, 10, 1e-3), rolls);
}

}  // namespace
}  // namespace viscontact::particles
