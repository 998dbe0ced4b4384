// Which films the closing of others may close in turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// The films between particles as a graph: a blow on one end of a chain closes its films one after
/// the other, and whoever solves for the contacts wants to know them at once.
class PairsOfParticles {
 public:
  explicit PairsOfParticles(const State& state);

  /// The films of `start` and those that are reached from their particles over at most `depth`
  /// films for which `may_close(film number)`, of which `may_close` is asked once each. Pairs only:
  /// a plane passes on no blow. Numbers are those of state.pairs.
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
  std::vector<std::size_t> offsets_, films_;  // the films of each particle
};

}  // namespace viscontact::particles
