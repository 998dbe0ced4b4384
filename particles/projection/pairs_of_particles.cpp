// Lists the pairs of each particle (pairs_of_particles.hpp).
#include "viscontact/particles/projection/pairs_of_particles.hpp"

namespace viscontact::particles {

PairsOfParticles::PairsOfParticles(const State& state)
    : state_(&state),
      pairs_(state.pairs.size()),
      offsets_(state.particles.count() + 1, 0),
      films_(2 * state.pairs.size()) {
  const auto for_particles = [&](const auto& visit) {
    for (std::size_t f = 0; f < pairs_; ++f) {
      visit(static_cast<std::size_t>(state.pairs[f].first), f);
      visit(static_cast<std::size_t>(state.pairs[f].second), f);
    }
  };
  for_particles([&](std::size_t particle, std::size_t) { ++offsets_[particle + 1]; });
  for (std::size_t k = 0; k + 1 < offsets_.size(); ++k) offsets_[k + 1] += offsets_[k];
  auto next = offsets_;
  for_particles([&](std::size_t particle, std::size_t f) { films_[next[particle]++] = f; });
}

}  // namespace viscontact::particles
