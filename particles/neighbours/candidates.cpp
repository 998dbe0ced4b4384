// When the neighbour list is valid, and how it is made again (candidates.hpp).
#include "viscontact/particles/neighbours/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "viscontact/common/system/block_results.hpp"
#include "viscontact/particles/neighbours/neighbours.hpp"

namespace viscontact::particles {
namespace {

auto place_of(const Film& film) { return std::tuple(film.first, film.second); }

/// Sum of vectors, from which a mean is computed.
struct VectorSum {
  Vector value{};
  VectorSum& operator+=(const VectorSum& other) {
    value = value + other.value;
    return *this;
  }
};

/// Mean over all particles k of `vector(k)`.
template <class Of>
Vector mean_of(std::size_t count, ThreadPool& pool, const Of& vector) {
  const auto sum = pool.sum_of_blocks<VectorSum>(count, [&](std::size_t begin, std::size_t end) {
    VectorSum part;
    for (std::size_t k = begin; k < end; ++k) part.value = part.value + vector(k);
    return part;
  });
  return (1 / static_cast<double>(count)) * sum.value;
}

}  // namespace

bool neighbour_list_is_valid(const State& state, std::span<const double> displacements,
                             ThreadPool& pool) {
  const auto& p = state.particles;
  if (state.positions_at_listing.empty()) return p.count() == 0;
  const auto moved = [&](std::size_t k) {
    return p.position(k) + point_of(displacements.data(), k, p.dimension) -
           point_of(state.positions_at_listing.data(), k, p.dimension);
  };
  const Vector common = mean_of(p.count(), pool, moved);
  const auto beyond_reach = [&](std::size_t begin, std::size_t end) {
    MaximumOfBlocks largest;
    for (std::size_t k = begin; k < end; ++k)
      largest.value = std::max(largest.value, norm(moved(k) - common) - state.reaches[k]);
    return largest;
  };
  return pool.sum_of_blocks<MaximumOfBlocks>(p.count(), beyond_reach).value <= 0;
}

void rebuild_neighbour_list(State& state, std::span<const double> displacements, ThreadPool& pool) {
  const auto& p = state.particles;
  // Skin in radii and in displacements of a step. Measured on box2d: with shorter skins the list is
  // made too often, with longer skins it is too long.
  constexpr double kOfRadius = 0.25, kSteps = 3;
  const auto displacement = [&](std::size_t k) {
    return point_of(displacements.data(), k, p.dimension);
  };
  const Vector common = mean_of(p.count(), pool, displacement);
  state.positions_at_listing = p.positions;
  state.reaches.resize(p.count(), 0.0);
  std::vector<double> extents(p.count());
  for (std::size_t k = 0; k < p.count(); ++k) {
    state.reaches[k] = std::max(
        {state.reaches[k], kOfRadius * p.radii[k], kSteps * norm(displacement(k) - common)});
    extents[k] = p.radii[k] + state.reaches[k];
  }
  const auto close = close_pairs(p.dimension, p.positions, extents, pool);
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
