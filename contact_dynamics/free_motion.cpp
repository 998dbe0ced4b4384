// Members of Simulation that compute displacements h u* and turns h w* without contacts and links,
// docs/physics.md (5.3) and (5.10), and reported velocities.
#include <cassert>

#include "viscontact/constraint_rows/tension.hpp"
#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {

template <int D>
void Simulation::move_freely(double h, double next) {
  assert(h > 0);
  const auto& p = state_.particles;
  const double impulse_time = impulse_time_of(h);
  auto entries = p.count();
  for (auto& entry : loaded_)
    if (entry >= 0) entry = static_cast<std::int32_t>(entries++);
  displacements_.resize(entries * D);
  mobilities_.resize(entries);
  pool_->for_blocks(p.count(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      mobilities_[k] = h / p.masses[k];
      for (std::size_t d = 0; d < D; ++d)
        displacements_[k * D + d] =
            h * (p.velocities[k * D + d] + impulse_time * setting_.gravity[d]);
    }
  });
  for (const auto& [particle, force] : setting_.forces) {
    const auto k = index_of(particle);
    const Vector mean = mean_of(force, h, next);
    for (std::size_t d = 0; d < D; ++d)
      displacements_[k * D + d] += impulse_time * mobilities_[k] * mean[d];
  }
  if (const auto& added = setting_.added_forces; !added.empty())
    pool_->for_blocks(added.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        displacements_[i] += impulse_time * mobilities_[i / D] * added[i];
    });
  if (p.turn()) turn_freely(h, next);
  if (!p.bodies.empty()) move_bodies_freely(h, next);
  move_as_given(h, next);
  link_forces_ = state_.link_forces;
  link_forces_.resize(setting_.links.force_count(D), 0.0);
  works_across_.assign(setting_.links.arms.size(), 0.0);
}

void Simulation::move_as_given(double h, double next) {
  const auto& p = state_.particles;
  const auto numbers = static_cast<std::size_t>(p.dimension), turns = turn_components(p.dimension);
  for (const auto& [particle, motion] : setting_.given_motions) {
    const auto k = index_of(particle);
    const Vector moved = h * motion.velocity.mean(state_.time, next);
    for (std::size_t d = 0; d < numbers; ++d) displacements_[k * numbers + d] = moved[d];
    mobilities_[k] = 0;
    if (!p.turn()) continue;
    const Vector turned = h * motion.angular_velocity.mean(state_.time, next);
    for (std::size_t i = 0; i < turns; ++i) turns_[k * turns + i] = turned[3 - turns + i];
    turn_mobilities_[k] = 0;
  }
  for (std::size_t w = 0; w < loaded_.size(); ++w) {
    if (loaded_[w] < 0) continue;
    const auto entry = index_of(loaded_[w]);
    const auto& load = *obstacles_[w].load;
    const double change = impulse_time_of(h) * mean_of(load.force, h, next)[0] / load.mass;
    const Vector moved =
        h * (state_.planes[w - walls_of_domain()].velocity + change) * obstacles_[w].start.normal;
    for (std::size_t d = 0; d < numbers; ++d) displacements_[entry * numbers + d] = moved[d];
    mobilities_[entry] = h / load.mass;
    if (!p.turn()) continue;
    // A plane does not turn, but its unit in the problem of a step needs a mobility. This one has
    // the right dimension in every system of units.
    turn_mobilities_[entry] = mobilities_[entry] / (mean_radius_ * mean_radius_);
    for (std::size_t i = 0; i < turns; ++i) turns_[entry * turns + i] = 0;
  }
}

Vector Simulation::mean_of(const PiecewiseConstant& function, double h, double next) const {
  if (setting_.scheme == Scheme::kEuler) return function.mean(state_.time, next);
  return function.mean(state_.time - state_.velocity_lag, state_.time + h / 2);
}

std::vector<BodyLoad> Simulation::loads_of_bodies(
    const std::function<Vector(const PiecewiseConstant&)>& mean) const {
  const auto& p = state_.particles;
  std::vector<BodyLoad> loads(p.bodies.count());
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const auto& body = p.bodies.bodies[b];
    loads[b].force = body.mass * setting_.gravity;
    for (std::size_t m = 0; m < body.members.size(); ++m) {
      const auto member = body.members[m];
      const Vector offset = present_offset(body, m, p.dimension);
      const auto add = [&](const Vector& force) {
        if (force == Vector{}) return;
        loads[b].force = loads[b].force + force;
        loads[b].torque = loads[b].torque + cross(offset, force);
        loads[b].forces.push_back({force, offset});
      };
      if (const auto force = setting_.forces.find(member); force != setting_.forces.end())
        add(mean(force->second));
      if (const auto torque = setting_.torques.find(member); torque != setting_.torques.end())
        loads[b].torque = loads[b].torque + mean(torque->second);
      add(added_force(setting_, index_of(member), p.dimension));
      loads[b].torque = loads[b].torque + added_torque(setting_, index_of(member), p.dimension);
    }
  }
  return loads;
}

void Simulation::move_bodies_freely(double h, double next) {
  const auto& p = state_.particles;
  const auto loads = loads_of_bodies(
      [&](const PiecewiseConstant& function) { return mean_of(function, h, next); });
  const auto numbers = static_cast<std::size_t>(p.dimension);
  const auto components = turn_components(p.dimension);
  const LinkTimes times{h, impulse_time_of(h), next, is_first_part()};
  body_steps_.clear();
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const auto& body = p.bodies.bodies[b];
    auto load = loads[b];
    load.stiffness = stiffness_in_step(body, load.forces, times, p.dimension);
    body_steps_.push_back(
        free_step(body, load, times.h, times.impulse_time, times.is_first, p.dimension));
    const auto& step = body_steps_.back();
    for (std::size_t m = 0; m < body.members.size(); ++m) {
      const auto k = index_of(body.members[m]);
      const Vector moved = displacement_at(step.displacement, step.turn,
                                           present_offset(body, m, p.dimension), p.dimension);
      for (std::size_t d = 0; d < numbers; ++d) displacements_[k * numbers + d] = moved[d];
      for (std::size_t i = 0; i < components; ++i)
        turns_[k * components + i] = step.turn[3 - components + i];
      mobilities_[k] = step.mobility;
    }
  }
}

std::vector<char> Simulation::free_particles() const {
  const auto& p = state_.particles;
  std::vector<char> is_free(p.count(), 1);
  for (const auto& [particle, motion] : setting_.given_motions) is_free[index_of(particle)] = 0;
  const auto bind = [&](std::int32_t particle) {
    if (particle < 0) return;
    is_free[index_of(particle)] = 0;
    if (const auto body = p.bodies.body_of(particle); body >= 0)
      for (const auto member : p.bodies.bodies[index_of(body)].members)
        is_free[index_of(member)] = 0;
  };
  for (const auto* pairs : {&state_.pairs, &state_.walls})
    for (const auto& pair : *pairs)
      if (pair.impulse != 0 || norm(state_.memories.of(pair.memory).friction()) > 0) {
        bind(pair.first);
        bind(pair.second);
      }
  for (const auto& hinge : setting_.links.hinges) bind(hinge.point.particle);
  for (const auto& spring : setting_.links.springs) {
    bind(spring.first);
    bind(spring.second);
  }
  for (const auto& arm : setting_.links.arms) {
    bind(arm.first);
    bind(arm.second);
  }
  for (const auto& membrane : setting_.links.membranes)
    for (const auto bead : membrane.beads) bind(bead);
  return is_free;
}

Particles Simulation::reported_particles() const {
  auto reported = state_.particles;
  const double lag = state_.velocity_lag;
  if (!(lag > 0)) return reported;
  const auto is_free = free_particles();
  const auto numbers = static_cast<std::size_t>(reported.dimension);
  const auto add = [&](std::vector<double>& values, std::size_t k, std::size_t count, double factor,
                       const Vector& by, std::size_t first) {
    if (is_free[k] == 0 || reported.bodies.body_of(static_cast<std::int32_t>(k)) >= 0) return;
    for (std::size_t d = 0; d < count; ++d) values[k * count + d] += factor * by[first + d];
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
  for (std::size_t k = 0; k < reported.count(); ++k) {
    add(reported.velocities, k, numbers, lag / reported.masses[k],
        added_force(setting_, k, reported.dimension), 0);
    if (reported.turn())
      add(reported.angular_velocities, k, turns, lag / reported.inertias[k],
          added_torque(setting_, k, reported.dimension), 3 - turns);
  }
  const auto loads = loads_of_bodies(
      [&](const PiecewiseConstant& function) { return function.mean(from, state_.time); });
  for (std::size_t b = 0; b < loads.size(); ++b) {
    auto& body = reported.bodies.bodies[b];
    if (is_free[index_of(body.members.front())] == 0) continue;
    body.velocity = body.velocity + (lag / body.mass) * loads[b].force;
    body.angular_momentum = body.angular_momentum + lag * loads[b].torque;
    update_angular_velocity(body, reported.dimension);
  }
  place_members(reported);
  return reported;
}

void Simulation::turn_freely(double h, double next) {
  const auto& p = state_.particles;
  const auto components = turn_components(p.dimension);
  turns_.resize(mobilities_.size() * components);
  turn_mobilities_.resize(mobilities_.size());
  for (std::size_t k = 0; k < p.angular_velocities.size(); ++k)
    turns_[k] = h * p.angular_velocities[k];
  for (std::size_t k = 0; k < p.count(); ++k) turn_mobilities_[k] = h / p.inertias[k];
  for (const auto& [particle, torque] : setting_.torques) {
    const auto k = index_of(particle);
    const Vector mean = mean_of(torque, h, next);
    for (std::size_t i = 0; i < components; ++i)
      turns_[k * components + i] +=
          impulse_time_of(h) * turn_mobilities_[k] * mean[p.dimension == 3 ? i : 2];
  }
  for (std::size_t i = 0; i < setting_.added_torques.size(); ++i)
    turns_[i] += impulse_time_of(h) * turn_mobilities_[i / components] * setting_.added_torques[i];
}

template void Simulation::move_freely<2>(double, double);
template void Simulation::move_freely<3>(double, double);

}  // namespace viscontact::particles
