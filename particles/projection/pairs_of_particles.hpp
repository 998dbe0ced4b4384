// The pairs of a state as a graph of particles. When some gaps close, it serves to find which
// further gaps may close in turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Graph of the pairs of particles. A blow on one end of a chain closes its gaps one after the
/// other. With this class all these gaps are found at once; otherwise each solution of the
/// projection would find only the next one.
class PairsOfParticles {
 public:
  /// `state` must outlive the object, and its list of pairs must not change.
  explicit PairsOfParticles(const State& state)
      : state_(&state),
        pair_count_(state.pairs.size()),
        offsets_(state.particles.count() + 1, 0),
        pairs_of_(2 * state.pairs.size()) {
    for (const auto& pair : state.pairs)
      for (const auto particle : {pair.first, pair.second}) ++offsets_[index_of(particle) + 1];
    for (std::size_t k = 0; k + 1 < offsets_.size(); ++k) offsets_[k + 1] += offsets_[k];
    auto next = offsets_;
    for (std::size_t f = 0; f < pair_count_; ++f)
      for (const auto particle : {state.pairs[f].first, state.pairs[f].second})
        pairs_of_[next[index_of(particle)]++] = f;
  }

  /// Returns `start` and all pairs that are connected with it through at most `depth` pairs for
  /// which `may_close(number of the pair)` is true. may_close is called at most once for each pair.
  /// `start` may contain particles at planes, but the search follows pairs of particles only,
  /// because a plane does not pass a blow on. Pairs have their numbers in state.pairs; walls follow
  /// after them.
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
      const auto& pair = f < pair_count_ ? state_->pairs[f] : state_->walls[f - pair_count_];
      visit(pair.first);
      visit(pair.second);
    }
    for (int level = 0; level < depth && !next.empty(); ++level) {
      frontier.swap(next);
      next.clear();
      for (const auto particle : frontier) {
        const auto k = index_of(particle);
        for (auto n = offsets_[k]; n < offsets_[k + 1]; ++n) {
          const auto f = pairs_of_[n];
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
  const State* state_;
  std::size_t pair_count_;
  std::vector<std::size_t> offsets_, pairs_of_;  // the pairs of each particle
};

}  // namespace viscontact::particles
