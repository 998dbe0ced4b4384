// Settings and energies of particles of any shape in the plane, without a fluid.
#pragma once

#include <cstddef>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {

constexpr double kGravity = 9.81;

/// Without films.
inline Setting setting_of(double h, double friction) {
  Setting setting;
  setting.time_step = h;
  setting.laws.film.gamma_min = 0.0;
  if (friction > 0) setting.laws.friction = FrictionLaw{friction};
  return setting;
}

inline Setting on_floor(double h, double friction) {
  auto setting = setting_of(h, friction);
  setting.planes = {plane_at_rest({}, {0, 1, 0})};
  setting.gravity = {0, -kGravity, 0};
  return setting;
}

/// Kinetic energy, also of turns.
inline double energy_of_motion(const Particles& p) {
  double sum = kinetic_energy(p);
  for (std::size_t k = 0; k < p.count(); ++k)
    sum += p.inertias[k] * p.angular_velocities[k] * p.angular_velocities[k] / 2;
  return sum;
}

/// The energy with gravity along -y.
inline double energy_in_gravity(const Particles& p) {
  double sum = energy_of_motion(p);
  for (std::size_t k = 0; k < p.count(); ++k) sum += p.masses[k] * kGravity * p.position(k)[1];
  return sum;
}

}  // namespace viscontact::particles
