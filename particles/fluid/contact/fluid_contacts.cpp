// Lists pairs that are close to contact (fluid_contacts.hpp). Lengths are in the unit of the case.
#include "viscontact/particles/fluid/contact/fluid_contacts.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"

namespace viscontact::particles {
namespace {

/// Particles in order of their number, obstacles in order of -1, -2, ...
auto place_of_pair(const Pair& pair) {
  return std::tuple(std::max(pair.first, -1 - pair.first), pair.second, pair.image);
}

/// Sorts the pairs, and adds those of `before` that remember something.
void keep_memory(std::vector<Pair>& pairs, std::vector<Pair> before) {
  const auto is_less = [](const Pair& a, const Pair& b) {
    return place_of_pair(a) < place_of_pair(b);
  };
  std::ranges::sort(pairs, is_less);
  std::ranges::sort(before, is_less);
  std::vector<Pair> merged;
  auto old = before.begin();
  for (const auto& pair : pairs) {
    for (; old != before.end() && is_less(*old, pair); ++old)
      if (old->gamma < 0) merged.push_back(*old);
    if (old != before.end() && place_of_pair(*old) == place_of_pair(pair))
      merged.push_back(*old++);
    else
      merged.push_back(pair);
  }
  for (; old != before.end(); ++old)
    if (old->gamma < 0) merged.push_back(*old);
  pairs = std::move(merged);
}

template <int D>
FluidContact contact_in(const Particles& p, const Pair& pair,
                        std::span<const PlanePosition> obstacles, double threshold) {
  const auto contact = contact_of<D>(p, pair, obstacles);
  FluidContact of{pair.first < 0 ? -1 : pair.first, pair.second};
  for (std::size_t d = 0; d < D; ++d) of.normal[d] = contact.normal[d];
  of.gap = contact.gap - threshold;
  of.gamma = pair.gamma;
  of.impulse = pair.impulse;
  if (pair.image != 0) of.image_opening = dot(of.normal, velocity_of_image(p.cell, pair.image));
  return of;
}

}  // namespace

PairLists pairs_in_reach(const State& state, std::span<const PlanePosition> obstacles, double reach,
                         ThreadPool& pool) {
  // Only the nearest images have a number, so that the search must stay below half a period.
  constexpr double kShareOfPeriod = 0.499;
  const auto& p = state.particles;
  std::vector<double> extents = p.radii;
  double furthest = std::numeric_limits<double>::infinity();
  for (const double length : p.cell.lengths)
    if (length > 0) furthest = std::min(furthest, kShareOfPeriod * length);
  for (auto& extent : extents) extent = std::max(extent, std::min(extent + reach / 2, furthest));
  const auto close = p.cell.is_periodic()
                         ? close_pairs_in_period(p.cell, p.positions, extents, pool)
                         : close_pairs(p.dimension, p.positions, extents, pool);
  PairLists lists;
  for (const auto& pair : close) {
    if (p.bodies.are_one(pair.first, pair.second)) continue;
    Pair made{pair.first, pair.second};
    made.image = pair.image;
    lists.pairs.push_back(made);
  }
  for (std::size_t w = 0; w < obstacles.size(); ++w) {
    if (p.dimension == 1 && obstacles[w].normal[0] == 0) continue;
    for (std::size_t k = 0; k < p.count(); ++k)
      if (gap(obstacles[w], p.position(k), p.radii[k]) < reach)
        lists.walls.push_back({-1 - static_cast<std::int32_t>(w), static_cast<std::int32_t>(k)});
  }
  keep_memory(lists.pairs, state.pairs);
  keep_memory(lists.walls, state.walls);
  return lists;
}

FluidContact fluid_contact_of(const Particles& particles, const Pair& pair,
                              std::span<const PlanePosition> obstacles, double threshold,
                              std::span<const double> free_velocities, double h) {
  if (particles.dimension == 1) return contact_in<1>(particles, pair, obstacles, threshold);
  if (pair.first >= 0 || !obstacles[pair.plane()].is_curved())
    return contact_in<2>(particles, pair, obstacles, threshold);
  const auto k = index_of(pair.second);
  const Vector moved{h * free_velocities[3 * k], h * free_velocities[3 * k + 1], 0};
  const auto tangent = tangent_at(obstacles[pair.plane()], particles.position(k) + moved);
  auto at_tangent = pair;
  at_tangent.first = -1;
  return contact_in<2>(particles, at_tangent, std::span(&tangent, 1), threshold);
}

}  // namespace viscontact::particles
