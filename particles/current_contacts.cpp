// Contacts and overlaps of a state, in the units of the case. Nothing is thrown. A change must keep
// the order of contacts, which vtk_reader.cpp restores.
#include "viscontact/particles/current_contacts.hpp"

#include <algorithm>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"
#include "viscontact/particles/outline.hpp"

namespace viscontact::particles {
namespace {

double gap_of(const Setting& setting, const Particles& p, const Pair& pair,
              std::span<const PlanePosition> places) {
  if (setting.fluid && !setting.fluid->semi_axes.empty()) {
    const auto outline = [&](std::int32_t k, const Vector& shift = {}) {
      return outline_of(*setting.fluid, p, p.angles, index_of(k), shift);
    };
    if (pair.first >= 0)
      return gap(outline(pair.first), outline(pair.second, shift_of(p.cell, pair.image)));
    const auto of_second = outline(pair.second);
    if (!of_second.is_plate) return gap(places[pair.plane()], of_second);
    const auto end = of_second.spine()[index_of(pair.image)];
    return gap(places[pair.plane()], Vector{end[0], end[1], 0}, of_second.end_radius());
  }
  if (p.dimension == 1) return contact_of<1>(p, pair, places).gap;
  return p.dimension == 2 ? contact_of<2>(p, pair, places).gap : contact_of<3>(p, pair, places).gap;
}

/// The smallest gap of two discs, between their nearest images [L]; 0 if none overlap.
double smallest_gap_of_images(const Particles& p) {
  double smallest = 0;
  for (std::size_t j = 0; j < p.count(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      if (p.bodies.are_one(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j))) continue;
      const Vector apart = nearest_image(p.cell, p.position(j) - p.position(i));
      smallest = std::min(smallest, norm(apart) - p.radii[i] - p.radii[j]);
    }
  return smallest;
}

ContactFriction friction_of(const Setting& setting, const PairMemory& memory) {
  // Solvers set the friction of a sliding contact to its bound, so that it has this value within
  // rounding errors. In a divided step friction and bound are sums over the parts, which are equal
  // if the direction of the friction did not change.
  constexpr double kRounding = 1e-9;
  const double carried = memory[Remembered::kCarried];
  if (!setting.laws.friction || !(carried > 0)) return ContactFriction::kNone;
  const double bound = setting.laws.friction->coefficient * carried;
  return norm(memory.friction()) >= (1 - kRounding) * bound ? ContactFriction::kSlides
                                                            : ContactFriction::kSticks;
}

}  // namespace

std::pair<std::int32_t, std::int32_t> ids_of(const Particles& particles,
                                             const CurrentContact& contact) {
  const auto second = particles.id(index_of(contact.second));
  if (contact.first < 0) return {second, contact.first};
  return {particles.id(index_of(contact.first)), second};
}

double largest_overlap(const Setting& setting, const State& state) {
  double smallest = 0;
  const auto& p = state.particles;
  ThreadPool pool(1);
  // close_pairs_in_period() takes the images where they were at the start. In a sheared cell images
  // have moved, and all pairs are compared one by one.
  std::vector<ClosePair> close;
  if (p.cell.is_sheared()) {
    smallest = smallest_gap_of_images(p);
  } else {
    close = p.cell.is_periodic() ? close_pairs_in_period(p.cell, p.positions, p.radii, pool)
                                 : close_pairs(p.dimension, p.positions, p.radii, pool);
  }
  for (const auto& pair : close)
    if (!p.bodies.are_one(pair.first, pair.second))
      smallest = std::min(smallest,
                          gap_of(setting, p, {pair.first, pair.second, 0, 0, 0, pair.image}, {}));
  const auto places = positions_of(obstacles_of(setting), state.time);
  for (std::size_t w = 0; w < places.size(); ++w)
    for (std::size_t k = 0; k < p.count(); ++k)
      // The gap of the circle around an outline is at most that of the outline.
      if (gap(places[w], p.position(k), p.radii[k]) < smallest)
        for (const std::int32_t end : {0, 1}) {
          const Pair pair{
              -1 - static_cast<std::int32_t>(w), static_cast<std::int32_t>(k), 0, 0, 0, end};
          smallest = std::min(smallest, gap_of(setting, p, pair, places));
        }
  return (0 - smallest) / mean_radius(p);  // the subtraction returns 0 instead of -0
}

double largest_gamma_error(const State& state) {
  double largest = 0;
  for (const auto* pairs : {&state.pairs, &state.walls})
    for (const auto& pair : *pairs) largest = std::max(largest, pair.gamma_error);
  return largest;
}

std::vector<CurrentContact> contacts_of(const Setting& setting, const State& state) {
  std::vector<CurrentContact> contacts;
  const auto& p = state.particles;
  const auto places = positions_of(obstacles_of(setting), state.time);
  const double touching = setting.solver.tolerance * mean_radius(p);
  for (const auto* pairs : {&state.pairs, &state.walls})
    for (const auto& pair : *pairs)
      if (const double gap = gap_of(setting, p, pair, places); pair.gamma < 0 || gap <= touching) {
        const auto& memory = state.memories.of(pair.memory);
        const auto image = pair.first < 0 ? 0 : pair.image;  // of an obstacle it is an end
        contacts.push_back({pair.first, pair.second, gap, pair.gamma, pair.gamma_error, image,
                            friction_of(setting, memory), memory.shown()});
      }
  return contacts;
}

}  // namespace viscontact::particles
