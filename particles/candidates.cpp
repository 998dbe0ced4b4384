#include "particles/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "particles/neighbours.hpp"

namespace viscontact::particles {
namespace {

double squared_norm(const double* a, int dimension) {
  double square = 0;
  for (int d = 0; d < dimension; ++d) square += a[d] * a[d];
  return square;
}

auto place_of(const Film& film) { return std::tuple(film.first, film.second); }

struct All {
  bool value = true;
  All& operator+=(const All& other) {
    value = value && other.value;
    return *this;
  }
};

}  // namespace

bool list_holds(const State& state, std::span<const double> displacements, Team& team) {
  const auto& p = state.particles;
  if (state.listed_positions.empty()) return p.count() == 0;
  const auto d = static_cast<std::size_t>(p.dimension);
  return team
      .sum_of_blocks<All>(
          p.count(),
          [&](std::size_t begin, std::size_t end) {
            All all;
            for (std::size_t k = begin; k < end; ++k) {
              double square = 0;
              for (std::size_t i = k * d; i < k * d + d; ++i) {
                const double moved = p.positions[i] + displacements[i] - state.listed_positions[i];
                square += moved * moved;
              }
              all.value = all.value && square <= state.reaches[k] * state.reaches[k];
            }
            return all;
          })
      .value;
}

void make_list(State& state, std::span<const double> displacements, Team& team) {
  const auto& p = state.particles;
  const auto d = static_cast<std::size_t>(p.dimension);
  // Measured on box2d: shorter reaches make the list too often, longer ones make it long.
  constexpr double kOfRadius = 0.25, kSteps = 3;
  state.listed_positions = p.positions;
  state.reaches.resize(p.count());
  std::vector<double> extents(p.count());
  for (std::size_t k = 0; k < p.count(); ++k) {
    state.reaches[k] =
        std::max(kOfRadius * p.radii[k],
                 kSteps * std::sqrt(squared_norm(&displacements[k * d], p.dimension)));
    extents[k] = p.radii[k] + state.reaches[k];
  }
  const auto close = close_pairs(p.dimension, p.positions, extents, team);
  std::vector<Film> pairs;
  pairs.reserve(close.size());
  auto old = state.pairs.begin();
  const auto keep_until = [&](const std::tuple<std::int32_t, std::int32_t>& place) {
    for (; old != state.pairs.end() && place_of(*old) < place; ++old)
      if (old->gamma < 0) pairs.push_back(*old);
  };
  for (const auto& pair : close) {
    keep_until({pair.first, pair.second});
    if (old != state.pairs.end() && place_of(*old) == std::tuple(pair.first, pair.second))
      pairs.push_back(*old++);
    else
      pairs.push_back({pair.first, pair.second, 0, 0});
  }
  for (; old != state.pairs.end(); ++old)
    if (old->gamma < 0) pairs.push_back(*old);
  state.pairs = std::move(pairs);
}

}  // namespace viscontact::particles
