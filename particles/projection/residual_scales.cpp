// Computes the impulses at work and the rounding errors of contacts (docs/particles.md). Lengths
// [L] and impulses [M L/T] are in the units of the case; nothing is thrown. A change alters which
// steps converge.
#include "viscontact/particles/projection/residual_scales.hpp"

#include <cmath>
#include <limits>

namespace viscontact::particles {

/// The impulse at work on a body is the largest of three: that of its own motion (of_particle), the
/// impulses of its contacts, and the impulses that would stop those of its contacts that still
/// close.
template <int D>
ResidualScales<D>::ResidualScales(const State& state, double h,
                                  std::span<const double> displacements,
                                  std::span<const double> mobilities, ContactSystem<D>& system)
    : state_(state),
      h_(h),
      displacements_(displacements),
      mobilities_(mobilities),
      system_(system),
      island_impulses_(system.bodies().size(), 0.0) {
  const auto& bodies = system.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    body_scales_.push_back(of_particle(bodies[b], system.free_displacement(b)));
  for (const auto& contact : system.contacts) {
    const double gap = gap_after(contact, displacements_);
    // In a glued pair the film also pulls, so that an open gap calls for an impulse, too.
    const double impulse = std::max(std::abs(contact.impulse),
                                    (contact.lowest < 0 ? std::abs(gap) : -gap) / contact.w);
    for (const auto particle : {contact.first, contact.second})
      if (particle >= 0) {
        auto& largest = body_scales_[index_of(system.body_of(particle))].impulse;
        largest = std::max(largest, impulse);
      }
    auto& of_island = island_impulses_[index_of(system.island(system.body_of(contact.second)))];
    of_island = std::max(of_island, std::sqrt(contact.w) * impulse);
  }
}

/// Impulse at work on a particle that takes part in no contact: the larger of what forces and
/// gravity give it in the step and of its change of momentum. `moves` is its displacement h u* [L].
template <int D>
typename ResidualScales<D>::ParticleScale ResidualScales<D>::of_particle(
    std::int32_t particle, const double* moves) const {
  const auto k = index_of(particle);
  double given = 0, change = 0;
  ParticleScale scale;
  for (std::size_t d = 0; d < D; ++d) {
    const double before = h_ * state_.particles.velocities[k * D + d];
    const double now = displacements_[k * D + d];
    given += (moves[d] - before) * (moves[d] - before);
    change += (now - before) * (now - before);
    scale.moved += std::abs(before);
  }
  scale.impulse = std::sqrt(std::max(given, change)) / mobilities_[k];
  return scale;
}

template <int D>
ResidualScale ResidualScales<D>::of(std::span<const std::int32_t> particles, double w,
                                    double length) {
  // Rounding errors are taken as 128 units in the last place of the lengths that are added below.
  constexpr double kRounding = 128 * std::numeric_limits<double>::epsilon();
  ResidualScale scale{w, std::numeric_limits<double>::infinity(), length};
  double around = 0;
  for (const auto particle : particles) {
    if (particle < 0) continue;
    const auto k = index_of(particle);
    const auto body = system_.body_of(particle);
    const auto own =
        body < 0 ? of_particle(particle, &displacements_[k * D]) : body_scales_[index_of(body)];
    scale.impulse = std::min(scale.impulse, own.impulse);
    scale.rounding += mobilities_[k] * own.impulse + own.moved;
    if (body >= 0) around = std::max(around, island_impulses_[index_of(system_.island(body))]);
  }
  scale.rounding += std::sqrt(scale.w) * around;
  // Solvers take squares of displacements, and products of these. Below this length they underflow.
  // In any unit of length that a case may have, a particle that moves by less is at rest.
  constexpr double kAtRest = 1e-100;
  scale.rounding = std::max(kRounding * scale.rounding, kAtRest);
  return scale;
}

template class ResidualScales<2>;
template class ResidualScales<3>;

}  // namespace viscontact::particles
