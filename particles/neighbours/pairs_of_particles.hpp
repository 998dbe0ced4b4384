// The pairs of a neighbour list as a graph. A pair is numbered by its place in State::pairs, or,
// with an obstacle, by their number plus its place in State::walls.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// If a particle hits one end of a chain of particles, the gaps of the chain close one after the
/// other. This class finds all these gaps before the problem for the contact impulses is solved;
/// otherwise each solution would show only the next gap that closes.
class PairsOfParticles {
 public:
  /// `state` must outlive the object, and its lists of pairs must not change. `with_walls`: pairs
  /// with an obstacle are in the graph, too; connected() must then not be called.
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

  /// The pairs of a particle, in increasing order.
  std::span<const std::size_t> of(std::int32_t particle) const {
    const auto k = index_of(particle);
    assert(k + 1 < offsets_.size());
    return std::span(pairs_of_).subspan(offsets_[k], offsets_[k + 1] - offsets_[k]);
  }

  /// Returns `start`, and then the pairs that the search finds in `depth` rounds. Each round finds
  /// the pairs f that share a particle with a pair found before and for which may_close(f) is true.
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
          assert(f < pair_count_);
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
  std::vector<std::size_t> offsets_, pairs_of_;
};

}  // namespace viscontact::particles
