#include "tests/particles/systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "viscontact/particle_runs/io/link_file.hpp"

namespace viscontact::particles {

State no_particles(int dimension) {
  State state;
  state.particles.dimension = dimension;
  return state;
}

void add_particle(State& state, const Vector& position, double radius, double mass,
                  const Vector& velocity) {
  auto& p = state.particles;
  const auto numbers = static_cast<std::size_t>(p.dimension);
  for (std::size_t d = 0; d < numbers; ++d) {
    p.positions.push_back(position[d]);
    p.velocities.push_back(velocity[d]);
  }
  p.radii.push_back(radius);
  p.masses.push_back(mass);
}

void add_shape(State& state, const Shape& shape, const Vector& position, double angle, double mass,
               const Vector& velocity, double angular_velocity) {
  auto& p = state.particles;
  add_particle(state, position, shape.bounding_radius(), mass, velocity);
  p.shapes.push_back(shape);
  p.angles.push_back(angle);
  p.angular_velocities.push_back(angular_velocity);
  p.inertias.push_back(shape.inertia(mass));
}

Hinge hinge_of_body(const Particles& particles, const Vector& at) {
  Hinge hinge;
  hinge.body = 0;
  hinge.at = at;
  hinge.point = {0, at - particles.bodies.bodies[0].centre};
  return hinge;
}

Plane plane_at_rest(const Vector& point, const Vector& normal) {
  Plane plane;
  plane.start = {point, normal};
  return plane;
}

State random_cloud(int dimension, std::size_t count, double width,
                   const std::function<double()>& radius, Random& random) {
  State state = no_particles(dimension);
  const auto& p = state.particles;
  // The largest first: the small ones find room between them.
  std::vector<double> radii;
  for (std::size_t k = 0; k < count; ++k) radii.push_back(radius());
  std::ranges::sort(radii, std::greater<>());
  for (const double r : radii) {
    for (bool free = false; !free; width *= 1.0005) {
      Vector x{};
      for (std::size_t d = 0; d < static_cast<std::size_t>(dimension); ++d)
        x[d] = random.uniform(-width / 2, width / 2);
      free = true;
      for (std::size_t k = 0; free && k < p.count(); ++k)
        free = norm(x - p.position(k)) > 1.001 * (r + p.radii[k]);
      if (free) add_particle(state, x, r, std::pow(r, dimension));
    }
  }
  return state;
}

void run(Simulation& simulation, double end, const std::function<void(const StepReport&)>& see) {
  const double h = simulation.setting().time_step;
  while (simulation.state().time < end - 1e-6 * h) see(simulation.step(end));
}

void expect_converged(const StepReport& report) {
  EXPECT_TRUE(report.converged) << "t = " << report.time << ", residual " << report.residual;
}

Pair pair_of(const State& state, std::int32_t first, std::int32_t second) {
  for (const auto& pair : first < 0 ? state.walls : state.pairs)
    if (pair.first == first && pair.second == second) return pair;
  return {first, second, 0, 0};
}

double pair_gap(const State& state, std::int32_t first, std::int32_t second) {
  const auto& p = state.particles;
  const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
  return norm(p.position(j) - p.position(i)) - p.radii[i] - p.radii[j];
}

Vector momentum(const Particles& particles) {
  Vector sum{};
  for (std::size_t k = 0; k < particles.count(); ++k)
    sum = sum + particles.masses[k] * particles.velocity(k);
  return sum;
}

Vector angular_momentum(const Particles& particles) {
  Vector sum{};
  for (std::size_t k = 0; k < particles.count(); ++k)
    sum = sum + particles.masses[k] * cross(particles.position(k), particles.velocity(k));
  return sum;
}

double angular_momentum_with_spin(const Particles& particles) {
  double sum = angular_momentum(particles)[2];
  for (std::size_t k = 0; k < particles.count(); ++k)
    sum += particles.inertias[k] * particles.angular_velocities[k];
  return sum;
}

double power_of_arm(const Setting& setting, const State& state) {
  for (const auto& table : time_tables(setting, state.particles))
    if (table.name == "arms.csv") {
      // time, arm, length, force, power, ...
      const auto rows = table.rows(setting, state, {});
      std::size_t power = 0;
      for (int comma = 0; comma < 4; ++comma) power = rows.find(',', power) + 1;
      return std::stod(rows.substr(power));
    }
  return std::numeric_limits<double>::quiet_NaN();
}

double kinetic_energy(const Particles& particles) {
  double sum = 0;
  for (std::size_t k = 0; k < particles.count(); ++k)
    sum += particles.masses[k] * dot(particles.velocity(k), particles.velocity(k)) / 2;
  return sum;
}

int take_steps(Simulation& simulation, int steps) {
  int most = 0;
  for (int n = 0; n < steps; ++n) {
    const auto report = simulation.step(1e300);
    EXPECT_TRUE(report.converged) << "step " << n << ", residuals " << report.residual << ", "
                                  << report.impulse_residual << ", iterations "
                                  << report.iterations;
    most = std::max(most, report.iterations);
  }
  return most;
}

}  // namespace viscontact::particles
