// Lists pairs that are close to contact (fluid_contacts.hpp). Lengths are in the unit of the case.
#include "viscontact/particles/fluid/fluid_contacts.hpp"

#include <algorithm>
#include <tuple>

#include "viscontact/particles/contact.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"

namespace viscontact::particles {
namespace {

auto key_of(const Pair& pair) { return std::tuple(pair.first, pair.second, pair.image); }

/// Sorts the pairs, and adds those of `before` that remember something.
void keep_memory(std::vector<Pair>& pairs, std::vector<Pair> before) {
  const auto is_less = [](const Pair& a, const Pair& b) { return key_of(a) < key_of(b); };
  std::ranges::sort(pairs, is_less);
  std::ranges::sort(before, is_less);
  std::vector<Pair> merged;
  auto old = before.begin();
  for (const auto& pair : pairs) {
    for (; old != before.end() && is_less(*old, pair); ++old)
      if (old->gamma < 0) merged.push_back(*old);
    if (old != before.end() && key_of(*old) == key_of(pair))
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
  return of;
}

}  // namespace

void list_pairs_in_reach(State& state, std::span<const PlanePosition> obstacles, double reach,
                         ThreadPool& pool) {
  const auto& p = state.particles;
  std::vector<double> extents = p.radii;
  for (auto& extent : extents) extent += reach / 2;
  const auto close = p.cell.is_periodic()
                         ? close_pairs_in_period(p.cell, p.positions, extents, pool)
                         : close_pairs(p.dimension, p.positions, extents, pool);
  std::vector<Pair> pairs, walls;
  for (const auto& pair : close) {
    Pair made{pair.first, pair.second};
    made.image = pair.image;
    pairs.push_back(made);
  }
  for (std::size_t w = 0; w < obstacles.size(); ++w)
    for (std::size_t k = 0; k < p.count(); ++k)
      if (gap(obstacles[w], p.position(k), p.radii[k]) < reach)
        walls.push_back({-1 - static_cast<std::int32_t>(w), static_cast<std::int32_t>(k)});
  keep_memory(pairs, std::move(state.pairs));
  keep_memory(walls, std::move(state.walls));
  state.pairs = std::move(pairs);
  state.walls = std::move(walls);
}

FluidContact fluid_contact_of(const Particles& particles, const Pair& pair,
                              std::span<const PlanePosition> obstacles, double threshold) {
  return particles.dimension == 1 ? contact_in<1>(particles, pair, obstacles, threshold)
                                  : contact_in<2>(particles, pair, obstacles, threshold);
}

std::vector<Pair*> all_pairs(State& state) {
  std::vector<Pair*> pairs;
  for (auto* list : {&state.pairs, &state.walls})
    for (auto& pair : *list) pairs.push_back(&pair);
  return pairs;
}

}  // namespace viscontact::particles
