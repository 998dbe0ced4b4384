// When the list of close pairs is valid, and how it is made.
#include "viscontact/particles/neighbours/neighbour_list.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"

namespace viscontact::particles {
namespace {

struct NeighbourListTuning {
  // Rounding errors of positions add to the sum of radii and skins, which is therefore kept below
  // this part of the period.
  static constexpr double kLess = 1 - 1e-9;
  // The least skin in radii, and in displacements of a step. In bench/box2d.cpp smaller values cost
  // time because the list is made more often, and larger values because the list has more pairs.
  static constexpr double kOfRadius = 0.25, kSteps = 3;
};

/// The numbers by which the list of pairs is ordered; the contacts of a pair by Pair::place.
template <class AnyPair>
auto place_of(const AnyPair& pair) {
  return std::tuple(pair.first, pair.second, pair.image);
}

struct VectorSum {
  Vector value{};
  VectorSum& operator+=(const VectorSum& other) {
    value = value + other.value;
    return *this;
  }
};

template <class Of>
Vector mean_of(std::size_t count, ThreadPool& pool, const Of& vector) {
  const auto sum = pool.sum_of_blocks<VectorSum>(count, [&](std::size_t begin, std::size_t end) {
    VectorSum part;
    for (std::size_t k = begin; k < end; ++k) part.value = part.value + vector(k);
    return part;
  });
  return (1 / static_cast<double>(count)) * sum.value;
}

/// Infinite if there is no period [L].
double half_shortest_period(const PeriodicCell& cell) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const double length : cell.lengths)
    if (length > 0) shortest = std::min(shortest, length);
  return shortest / 2;
}

/// The smaller of `skin` and the largest skin that particle k may have in a periodic cell [L]. With
/// such skins, the radii and the skins of a pair obey r_i + 2 skin_i + r_j + 2 skin_j <= period.
/// The pair then stays closer than a period while its particles move by their skins, so that the
/// image of the second one has a number. Throws Error(kNotConverged) if the particle moves by
/// `moved`, further than this largest skin.
double skin_within_period(const Particles& p, std::size_t k, double half_period, double skin,
                          double moved) {
  const double longest = NeighbourListTuning::kLess * (half_period - p.radii[k]) / 2;
  if (!(moved <= longest))
    throw Error(ErrorKind::kNotConverged,
                "particle {} moves by {:.3g} relative to the others in a step, and at most {:.3g} "
                "is allowed, because the domain has a period of {:.3g}; make the time step shorter",
                p.id(k), moved, std::max(longest, 0.0), 2 * half_period);
  return std::min(skin, longest);
}

}  // namespace

bool neighbour_list_is_valid(const State& state, std::span<const double> displacements,
                             ThreadPool& pool) {
  const auto& p = state.particles;
  if (state.positions_at_listing.empty()) return p.count() == 0;
  assert(displacements.size() >= p.positions.size() && state.skins.size() == p.count());
  const auto moved = [&](std::size_t k) {
    return p.position(k) + point_of(displacements.data(), k, p.dimension) -
           point_of(state.positions_at_listing.data(), k, p.dimension);
  };
  const Vector common = mean_of(p.count(), pool, moved);
  const auto beyond_skin = [&](std::size_t begin, std::size_t end) {
    MaximumOfBlocks largest;
    for (std::size_t k = begin; k < end; ++k)
      largest.value = std::max(largest.value, norm(moved(k) - common) - state.skins[k]);
    return largest;
  };
  return pool.sum_of_blocks<MaximumOfBlocks>(p.count(), beyond_skin).value <= 0;
}

void rebuild_neighbour_list(State& state, std::span<const double> displacements, ThreadPool& pool) {
  const auto& p = state.particles;
  assert(displacements.size() >= p.positions.size());
  using Tuning = NeighbourListTuning;
  const auto displacement = [&](std::size_t k) {
    return point_of(displacements.data(), k, p.dimension);
  };
  const Vector common = mean_of(p.count(), pool, displacement);
  const double half_period = half_shortest_period(p.cell);
  // An error leaves the state as it was.
  auto skins = state.skins;
  skins.resize(p.count(), 0.0);
  std::vector<double> extents(p.count());
  for (std::size_t k = 0; k < p.count(); ++k) {
    const double moved = norm(displacement(k) - common);
    skins[k] = std::max({skins[k], Tuning::kOfRadius * p.radii[k], Tuning::kSteps * moved});
    if (p.cell.is_periodic()) skins[k] = skin_within_period(p, k, half_period, skins[k], moved);
    extents[k] = p.radii[k] + skins[k];
  }
  state.skins = std::move(skins);
  state.positions_at_listing = p.positions;
  // Few pairs have something to keep. The storage of the old list is then free while the search
  // needs it.
  std::vector<Pair> before;
  std::ranges::copy_if(state.pairs, std::back_inserter(before), [](const Pair& pair) {
    return pair.gamma < 0 || pair.impulse != 0 || pair.memory != PairMemories::kNone;
  });
  state.pairs = {};
  const auto close = p.cell.is_periodic()
                         ? close_pairs_in_period(p.cell, p.positions, extents, pool)
                         : close_pairs(p.dimension, p.positions, extents, pool);
  auto& pairs = state.pairs;
  pairs.reserve(close.size());
  auto old = before.begin();
  // Keeps the old pairs before this place whose film still holds them together.
  const auto keep_until = [&](const std::tuple<std::int32_t, std::int32_t, std::int32_t>& place) {
    for (; old != before.end() && place_of(*old) < place; ++old)
      if (old->gamma < 0) pairs.push_back(*old);
  };
  for (const auto& pair : close) {
    keep_until(place_of(pair));
    if (p.are_joined(pair.first, pair.second)) continue;
    if (old == before.end() || place_of(*old) != place_of(pair))
      pairs.push_back({pair.first, pair.second, 0, 0, 0, pair.image});
    while (old != before.end() && place_of(*old) == place_of(pair)) pairs.push_back(*old++);
  }
  keep_until({std::numeric_limits<std::int32_t>::max(), 0, 0});
}

void rebuild_wall_list(State& state, std::span<const PlanePosition> planes, double margin,
                       ThreadPool& pool) {
  const auto& p = state.particles;
  assert(margin >= 0);
  ConcatenatedBlocks<Pair> walls;
  for (std::size_t w = 0; w < planes.size(); ++w) {
    const auto plane = -1 - static_cast<std::int32_t>(w);
    const auto in_block = [&](std::size_t begin, std::size_t end) {
      ConcatenatedBlocks<Pair> pairs;
      // In the order of the planes, in which `first` = -1 - k falls.
      auto old = std::ranges::partition_point(state.walls, [&](const Pair& pair) {
        return pair.first > plane || (pair.first == plane && index_of(pair.second) < begin);
      });
      for (std::size_t k = begin; k < end; ++k) {
        const auto known = old;  // the contacts of the particle with this plane
        bool is_glued = false;
        for (; old != state.walls.end() && old->first == plane && index_of(old->second) == k; ++old)
          is_glued |= old->gamma < 0;
        if (!is_glued && !(gap(planes[w], p.position(k), p.radii[k]) < margin)) continue;
        if (known == old) pairs.values.push_back({plane, static_cast<std::int32_t>(k)});
        pairs.values.insert(pairs.values.end(), known, old);
      }
      return pairs;
    };
    walls += pool.sum_of_blocks<ConcatenatedBlocks<Pair>>(p.count(), in_block);
  }
  state.walls = std::move(walls.values);
}

void wrap_into_cell(State& state) {
  auto& p = state.particles;
  if (!p.cell.is_periodic() || p.cell.is_sheared()) return;
  const auto dimension = static_cast<std::size_t>(p.dimension);
  std::vector<std::array<int, 3>> wrapped(p.count());
  bool any = false;
  for (std::size_t k = 0; k < p.count(); ++k)
    for (std::size_t d = 0; d < dimension; ++d) {
      auto& x = p.positions[dimension * k + d];
      const double periods = periods_beyond(p.cell, d, x);
      if (p.cell.lengths[d] > 0) x = std::max(x - periods * p.cell.lengths[d], p.cell.from[d]);
      if (periods == 0) continue;
      any = true;
      wrapped[k][d] = static_cast<int>(periods);
      if (!state.positions_at_listing.empty())
        state.positions_at_listing[dimension * k + d] -= periods * p.cell.lengths[d];
    }
  if (!any) return;
  // The vector between the centres of a pair must stay the same.
  for (auto& pair : state.pairs) {
    auto shift = periods_of_image(pair.image);
    for (std::size_t d = 0; d < dimension; ++d)
      shift[d] += wrapped[index_of(pair.second)][d] - wrapped[index_of(pair.first)][d];
    pair.image = image_number(shift[0], shift[1], shift[2]);
  }
  std::ranges::sort(state.pairs, {}, [](const Pair& pair) {
    return std::tuple_cat(place_of(pair), std::tuple(pair.place));
  });
}

}  // namespace viscontact::particles
