// The pairs of a state as a graph of particles, to find which gaps the closing of other gaps may
// close in turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Graph of the pairs of particles. A blow on one end of a chain closes its gaps one after the
/// other. This class finds all of them at once, so that the solver need not find them one by one.
class PairsOfParticles {
 public:
  explicit PairsOfParticles(const State& state);

  /// Returns `start` and all pairs that are connected with it through at most `depth` pairs for
  /// which `may_close(number of the pair)` is true. may_close is called at most once for each pair.
  /// `start` may contain particles at planes, but the search follows pairs of particles only,
  /// because a plane passes on no blow. Pairs have their numbers in state.pairs; walls follow after
  /// them.
  template <class Predicate>
  std::vector<std::size_t> reached(std::span<const std::size_t> start, int depth,
                                   const Predicate& may_close) const {
    std::vector<char> seen(pairs_, 0), visited(offsets_.size() - 1, 0);
    std::vector<std::size_t> films(start.begin(), start.end());
    std::vector<std::int32_t> frontier, next;
    const auto visit = [&](std::int32_t particle) {
      if (particle < 0 || visited[static_cast<std::size_t>(particle)] != 0) return;
      visited[static_cast<std::size_t>(particle)] = 1;
      next.push_back(particle);
    };
    for (const auto f : start) {
      if (f < pairs_) seen[f] = 1;
      const auto& film = f < pairs_ ? state_->pairs[f] : state_->walls[f - pairs_];
      visit(film.first);
      visit(film.second);
    }
    for (int level = 0; level < depth && !next.empty(); ++level) {
      frontier.swap(next);
      next.clear();
      for (const auto particle : frontier) {
        const auto k = static_cast<std::size_t>(particle);
        for (auto n = offsets_[k]; n < offsets_[k + 1]; ++n) {
          const auto f = films_[n];
          if (seen[f] != 0) continue;
          seen[f] = 1;
          if (!may_close(f)) continue;
          films.push_back(f);
          visit(state_->pairs[f].first);
          visit(state_->pairs[f].second);
        }
      }
    }
    return films;
  }

 private:
  const State* state_;
  std::size_t pairs_;
  std::vector<std::size_t> offsets_, films_;  // the pairs of each particle
};

}  // namespace viscontact::particles
