// Treats the pairs of a neighbour list as a graph, whose nodes are the particles. The graph tells
// which pairs a particle has, and which further gaps may close when some gaps close. Particles are
// numbered from 0. The number of a pair is its place in State::pairs, or, for a pair with an
// obstacle, the number of those pairs plus its place in State::walls. Nothing is checked or thrown:
// numbers must be those of existing pairs and particles. projection/ and impacts/ use this file. A
// change must keep the order of pairs, because the bits of a simulation depend on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Graph of the pairs of particles. If a particle hits one end of a chain of particles, the gaps of
/// the chain close one after the other. This class finds all these gaps before the problem for the
/// contact impulses of the step is solved; otherwise each solution would show only the next gap
/// that closes.
class PairsOfParticles {
 public:
  /// `state` must outlive the object, and its lists of pairs must not change. If `with_walls` is
  /// true, pairs with an obstacle (State::walls) are in the graph, too; connected() must then not
  /// be called, because it reads beyond its arrays.
  explicit PairsOfParticles(const State& state, bool with_walls = false)
      : state_(&state), pair_count_(state.pairs.size()), offsets_(state.particles.count() + 1, 0) {
    const std::size_t count = pair_count_ + (with_walls ? state.walls.size() : 0);
    const auto for_particles = [&](const auto& visit) {
      for (std::size_t f = 0; f < count; ++f)
        for (const auto particle : {pair(f).first, pair(f).second})
          if (particle >= 0) visit(index_of(particle), f);
    };
    for_particles([&](std::size_t k, std::size_t) { ++offsets_[k + 1]; });
    for (std::size_t k = 0; k + 1 < offsets_.size(); ++k) offsets_[k + 1] += offsets_[k];
    pairs_of_.resize(offsets_.back());
    auto next = offsets_;
    for_particles([&](std::size_t k, std::size_t f) { pairs_of_[next[k]++] = f; });
  }

  /// The numbers of the pairs of particle `particle` >= 0, in increasing order; the numbers of
  /// pairs of State::walls are among them only if the graph was made `with_walls`.
  std::span<const std::size_t> of(std::int32_t particle) const {
    const auto k = index_of(particle);
    return std::span(pairs_of_).subspan(offsets_[k], offsets_[k + 1] - offsets_[k]);
  }

  /// Returns the numbers `start`, and then those of the pairs of particles that the search finds in
  /// `depth` >= 0 rounds; 0 rounds find none. Each round finds the pairs f that share a particle
  /// with a pair found before (in the first round, of `start`) and for which may_close(f) is true.
  /// may_close is called at most once for each pair, and not for those of `start`. `start` may
  /// contain pairs of State::walls, but the search finds no others, because an obstacle does not
  /// pass an impact on.
  template <class Predicate>
  std::vector<std::size_t> connected(std::span<const std::size_t> start, int depth,
                                     const Predicate& may_close) const {
    std::vector<char> seen(pair_count_, 0), visited(offsets_.size() - 1, 0);
    std::vector<std::size_t> pairs(start.begin(), start.end());
    std::vector<std::int32_t> frontier, next;
    const auto visit = [&](std::int32_t particle) {
      if (particle < 0 || visited[index_of(particle)] != 0) return;
      visited[index_of(particle)] = 1;
      next.push_back(particle);
    };
    for (const auto f : start) {
      if (f < pair_count_) seen[f] = 1;
      visit(pair(f).first);
      visit(pair(f).second);
    }
    for (int level = 0; level < depth && !next.empty(); ++level) {
      frontier.swap(next);
      next.clear();
      for (const auto particle : frontier) {
        for (const auto f : of(particle)) {
          if (seen[f] != 0) continue;
          seen[f] = 1;
          if (!may_close(f)) continue;
          pairs.push_back(f);
          visit(state_->pairs[f].first);
          visit(state_->pairs[f].second);
        }
      }
    }
    return pairs;
  }

 private:
  const Pair& pair(std::size_t f) const {
    return f < pair_count_ ? state_->pairs[f] : state_->walls[f - pair_count_];
  }

  const State* state_;
  std::size_t pair_count_;
  // The pairs of particle k are entries offsets_[k] to offsets_[k + 1] - 1 of pairs_of_.
  std::vector<std::size_t> offsets_, pairs_of_;
};

}  // namespace viscontact::particles
