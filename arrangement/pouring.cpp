// Random places are the same on every machine for the same state: no product and sum are fused into
// one operation (-ffp-contract=off in CMakeLists.txt).
#include "viscontact/arrangement/pouring.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/splitmix.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

namespace {

/// The particles of `p` that a new particle of this radius in the box of the source may touch.
std::vector<std::size_t> near_region(const Source& source, double radius, const Particles& p) {
  const Vector middle = 0.5 * (source.from + source.to), half = source.to - middle;
  std::vector<std::size_t> near;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector apart = nearest_image(p.cell, p.position(k) - middle);
    const double reach = p.radii[k] + radius;
    bool is_near = true;
    // Beyond half of a period another image may be nearer than the one in `apart`. Then all
    // particles count as near along this axis.
    for (std::size_t d = 0; d < 3; ++d)
      is_near = is_near && (std::abs(apart[d]) <= half[d] + reach ||
                            (p.cell.lengths[d] > 0 && half[d] + reach > 0.5 * p.cell.lengths[d]));
    if (is_near) near.push_back(k);
  }
  return near;
}

/// A random place in the box of the source where its particle `number` (from 0), which has this
/// radius, touches nothing; std::nullopt if 1000 random places are not free. The number 1000 bounds
/// the time; another one changes runs.
std::optional<Vector> free_place(const Source& source, double radius, std::size_t number,
                                 const State& state, std::span<const PlanePosition> obstacles) {
  constexpr int kTries = 1000;
  const auto& p = state.particles;
  const auto near = near_region(source, radius, p);
  // The seed is made from the source, the number of the particle and the number of steps done. A
  // run that continues from a restart file therefore draws the same numbers.
  SplitMix64 random(splitmix_hash(source.seed ^ splitmix_hash(number)) +
                    static_cast<std::uint64_t>(state.steps));
  for (int i = 0; i < kTries; ++i) {
    Vector x{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(p.dimension); ++d)
      x[d] = random.between(source.from[d], source.to[d]);
    const auto is_free_of = [&](std::size_t k) {
      return norm(nearest_image(p.cell, p.position(k) - x)) >= p.radii[k] + radius;
    };
    const auto is_before = [&](const PlanePosition& place) { return gap(place, x, radius) >= 0; };
    if (std::ranges::all_of(near, is_free_of) && std::ranges::all_of(obstacles, is_before))
      return x;
  }
  return {};
}

/// Appends a particle to all arrays of `p`, with angles and angular velocities if `turns`.
void add(const DrawnParticle& particle, const Vector& place, const Vector& velocity, bool turns,
         Particles& p) {
  for (std::size_t d = 0; d < static_cast<std::size_t>(p.dimension); ++d) {
    p.positions.push_back(place[d]);
    p.velocities.push_back(velocity[d]);
  }
  p.radii.push_back(particle.radius);
  add_missing_shapes(p);
  p.masses.push_back(particle.mass);
  add_missing_ids(p);
  if (turns) add_rotation(p);
  if (!p.bodies.empty()) p.bodies.of_particle.push_back(-1);
  if (!p.neighbours.empty()) p.neighbours.push_back({-1, -1});
}

DrawnSpecies species_after(std::int64_t poured, const Source& source, const State& state) {
  DrawnSpecies species(source.species, state.particles.dimension, source.seed);
  for (std::int64_t k = 0; k < poured; ++k) species.next();
  return species;
}

}  // namespace

Pouring::Pouring(std::vector<Source>& sources, State& state) : waiting_(sources.size()) {
  for (std::size_t s = 0; s < sources.size(); ++s) {
    auto& source = sources[s];
    if (s >= state.sources.size())
      state.sources.push_back({.poured = 0,
                               .begin = std::max(source.begin, state.time),
                               .begin_of_case = source.begin,
                               .rate = source.rate,
                               .seed = source.seed,
                               .species = hash_of(source.species)});
    const auto& progress = state.sources[s];
    source.begin = progress.begin;
    drawn_.push_back(species_after(progress.poured, source, state));
  }
}

void Pouring::pour(const Setting& setting, State& state) {
  if (drawn_.empty()) return;
  assert(setting.sources.size() == drawn_.size() && state.sources.size() >= drawn_.size());
  auto& p = state.particles;
  const bool turns = p.turn() || setting.laws.friction.has_value();
  const auto obstacles = positions_of(obstacles_of(setting, state.planes), state.time);
  for (std::size_t s = 0; s < drawn_.size(); ++s) {
    const auto& source = setting.sources[s];
    auto& count = state.sources[s].poured;
    while (static_cast<std::size_t>(count) < source.due(state.time)) {
      auto& next = waiting_[s];
      if (!next) next = drawn_[s].next();
      const auto place =
          free_place(source, next->radius, static_cast<std::size_t>(count), state, obstacles);
      if (!place) break;
      // With the leapfrog scheme the velocities of the state belong to an earlier time, since which
      // gravity has not acted on them. With the other scheme velocity_lag is 0.
      add(*next, *place, source.velocity - state.velocity_lag * setting.gravity, turns, p);
      next.reset();
      ++count;
      state.positions_at_listing.clear();
    }
  }
}

std::vector<WaitingParticles> waiting_particles(const std::vector<Source>& sources,
                                                const State& state) {
  std::vector<WaitingParticles> waiting;
  for (std::size_t s = 0; s < std::min(sources.size(), state.sources.size()); ++s) {
    const auto& progress = state.sources[s];
    auto source = sources[s];
    source.begin = progress.begin;
    const auto due = source.due(state.time), poured = static_cast<std::size_t>(progress.poured);
    if (due > poured)
      waiting.push_back(
          {s, due - poured, species_after(progress.poured, source, state).next().radius});
  }
  return waiting;
}

}  // namespace viscontact::particles
