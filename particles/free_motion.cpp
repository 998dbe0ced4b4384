// The motion of a step without contacts, h u* and h w* of docs/physics.md (5.3) and (5.10), and the
// velocities at the present time. Units are those of the case.
#include "viscontact/particles/rotation.hpp"
#include "viscontact/particles/simulation.hpp"

namespace viscontact::particles {

template <int D>
void Simulation::move_freely(double h, double next) {
  const auto& p = state_.particles;
  const double kick = kick_length(h);
  displacements_.resize(p.count() * D);
  mobilities_.resize(p.count());
  pool_->for_blocks(p.count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      mobilities_[k] = h / p.masses[k];
      for (std::size_t d = 0; d < D; ++d)
        displacements_[k * D + d] = h * (p.velocities[k * D + d] + kick * setting_.gravity[d]);
    }
  });
  for (const auto& [particle, force] : setting_.forces) {
    const auto k = index_of(particle);
    const Vector mean = mean_of(force, h, next);
    for (std::size_t d = 0; d < D; ++d)
      displacements_[k * D + d] += kick * mobilities_[k] * mean[d];
  }
  if (p.turn()) turn_freely(h, next);
}

/// Mean of a force or torque over the time in which it acts on the velocities in a step.
Vector Simulation::mean_of(const PiecewiseConstant& function, double h, double next) const {
  if (setting_.scheme == Scheme::kEuler) return function.mean(state_.time, next);
  return function.mean(state_.time - state_.velocity_lag, state_.time + h / 2);
}

Particles Simulation::reported_particles() const {
  auto reported = state_.particles;
  const double lag = state_.velocity_lag;
  if (!(lag > 0)) return reported;
  std::vector<char> is_free(reported.count(), 1);
  for (const auto* pairs : {&state_.pairs, &state_.walls})
    for (const auto& pair : *pairs)
      for (const auto particle : {pair.first, pair.second})
        if (particle >= 0 && pair.impulse != 0) is_free[index_of(particle)] = 0;
  const auto numbers = static_cast<std::size_t>(reported.dimension);
  const auto add = [&](std::vector<double>& values, std::size_t k, std::size_t count, double factor,
                       const Vector& by, std::size_t first) {
    for (std::size_t d = 0; d < count; ++d)
      if (is_free[k] != 0) values[k * count + d] += factor * by[first + d];
  };
  for (std::size_t k = 0; k < reported.count(); ++k)
    add(reported.velocities, k, numbers, lag, setting_.gravity, 0);
  const double from = state_.time - lag;
  for (const auto& [particle, force] : setting_.forces)
    add(reported.velocities, index_of(particle), numbers, lag / reported.masses[index_of(particle)],
        force.mean(from, state_.time), 0);
  const auto turns = turn_components(reported.dimension);
  for (const auto& [particle, torque] : setting_.torques)
    add(reported.angular_velocities, index_of(particle), turns,
        lag / reported.inertias[index_of(particle)], torque.mean(from, state_.time), 3 - turns);
  return reported;
}

/// Sets the rotations h w* of the free motion.
void Simulation::turn_freely(double h, double next) {
  const auto& p = state_.particles;
  const auto components = turn_components(p.dimension);
  turns_.resize(p.angular_velocities.size());
  turn_mobilities_.resize(p.count());
  for (std::size_t k = 0; k < turns_.size(); ++k) turns_[k] = h * p.angular_velocities[k];
  for (std::size_t k = 0; k < p.count(); ++k) turn_mobilities_[k] = h / p.inertias[k];
  for (const auto& [particle, torque] : setting_.torques) {
    const auto k = index_of(particle);
    const Vector mean = mean_of(torque, h, next);
    for (std::size_t i = 0; i < components; ++i)
      turns_[k * components + i] +=
          kick_length(h) * turn_mobilities_[k] * mean[p.dimension == 3 ? i : 2];
  }
}

template void Simulation::move_freely<2>(double, double);
template void Simulation::move_freely<3>(double, double);

}  // namespace viscontact::particles
