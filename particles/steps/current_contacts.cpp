// Contacts and overlaps of a state.
#include "viscontact/particles/steps/current_contacts.hpp"

#include <algorithm>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/contact/contact.hpp"
#include "viscontact/particles/contact/shaped_contacts.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"

namespace viscontact::particles {
namespace {

struct Place {
  double gap = 0;   ///< [L]
  Vector normal{},  ///< unit normal from the first to the second body
      branch{};     ///< vector to the centre of the second body (CurrentContact::branch) [L]
};

/// The place of a pair of discs or spheres, or of one of them and an obstacle.
template <int D>
Place place_of(const Particles& p, const Pair& pair, std::span<const PlanePosition> places) {
  const auto contact = contact_of<D>(p, pair, places);
  Place place{contact.gap};
  std::ranges::copy(contact.normal, place.normal.begin());
  double length = contact.gap + p.radii[index_of(pair.second)];
  if (pair.first >= 0) length += p.radii[index_of(pair.first)];
  place.branch = length * place.normal;
  return place;
}

/// The same for particles of any shape in the plane.
Place place_of_shapes(const Particles& p, const Pair& pair, std::span<const PlanePosition> places) {
  const auto vector = [](const Vector2& x) { return Vector{x[0], x[1], 0}; };
  const auto contact = ShapedContacts(p, pair, places).at(p, pair, places);
  Vector branch = p.position(index_of(pair.second));
  if (pair.first < 0)
    branch = branch - vector(contact.on_obstacle);
  else
    branch = branch + shift_of(p.cell, pair.image) - p.position(index_of(pair.first));
  return {contact.gap, vector(contact.normal), branch};
}

Place place_of(const Particles& p, const Pair& pair, std::span<const PlanePosition> places) {
  if (!p.shapes.empty()) return place_of_shapes(p, pair, places);
  if (p.dimension == 1) return place_of<1>(p, pair, places);
  return p.dimension == 2 ? place_of<2>(p, pair, places) : place_of<3>(p, pair, places);
}

/// The gap of a particle and an obstacle.
double gap_of(const Particles& p, std::size_t k, const PlanePosition& place) {
  return p.is_round(k) ? gap(place, p.position(k), p.radii[k]) : gap(place, p.placed_shape(k));
}

/// The gap of two particles, of which the second may be a periodic image.
double gap_of(const Particles& p, const ClosePair& pair) {
  const auto i = index_of(pair.first), j = index_of(pair.second);
  if (!p.is_round(i) || !p.is_round(j))
    return gap(p.placed_shape(i), p.placed_shape(j, shift_of(p.cell, pair.image)));
  return place_of(p, {pair.first, pair.second, 0, 0, 0, pair.image}, {}).gap;
}

/// The pairs of a particle and a particle or periodic image whose circles overlap. The time grows
/// with the square of the number of particles.
std::vector<ClosePair> overlapping_circles(const Particles& p) {
  std::vector<ClosePair> pairs;
  if (p.cell.vectors) {
    // Spheres that overlap are nearer than half of each height of the cell.
    for (std::int32_t j = 0; index_of(j) < p.count(); ++j)
      for (std::int32_t i = 0; i < j; ++i) {
        const Vector apart = p.position(index_of(j)) - p.position(index_of(i));
        const auto periods = periods_towards(p.cell, apart);
        if (norm(apart - shift_of(p.cell, periods)) < p.radii[index_of(i)] + p.radii[index_of(j)])
          pairs.push_back(
              {i, j,
               image_number(-static_cast<int>(periods[0]), -static_cast<int>(periods[1]),
                            -static_cast<int>(periods[2]))});
      }
    return pairs;
  }
  for (std::int32_t j = 0; index_of(j) < p.count(); ++j)
    for (std::int32_t i = 0; i < j; ++i)
      for (std::int32_t image = -kLargestImage; image <= kLargestImage; ++image) {
        if (!has_image(p.cell, image)) continue;
        const Vector apart =
            p.position(index_of(j)) + shift_of(p.cell, image) - p.position(index_of(i));
        if (norm(apart) < p.radii[index_of(i)] + p.radii[index_of(j)])
          pairs.push_back({i, j, image});
      }
  return pairs;
}

ContactFriction friction_of(const Setting& setting, const PairMemory& memory) {
  // Solvers set the friction of a sliding contact to its largest value, the coefficient times the
  // load, within rounding errors, which are far below kRounding. If a step is computed in parts,
  // friction and load are sums over the parts, and the friction has this value only if its
  // direction was the same in all parts.
  constexpr double kRounding = 1e-9;
  const double solid_load = memory[Remembered::kSolidLoad];
  if (!setting.laws.friction || !(solid_load > 0)) return ContactFriction::kNone;
  const double bound = setting.laws.friction->coefficient * solid_load;
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
  // close_pairs_in_period() takes each image at the shift that it had at the start. In a sheared
  // cell the images have moved since then, and all pairs are compared one by one.
  const auto close = p.cell.is_sheared() ? overlapping_circles(p)
                     : p.cell.is_periodic()
                         ? close_pairs_in_period(p.cell, p.positions, p.radii, pool)
                         : close_pairs(p.dimension, p.positions, p.radii, pool);
  for (const auto& pair : close)
    if (!p.are_joined(pair.first, pair.second)) smallest = std::min(smallest, gap_of(p, pair));
  const auto places = positions_of(obstacles_of(setting, state.planes), state.time);
  for (std::size_t w = 0; w < places.size(); ++w)
    for (std::size_t k = 0; k < p.count(); ++k)
      // The circle with the radius of a particle contains the particle, so that the gap of the
      // circle is at most that of the particle.
      if (gap(places[w], p.position(k), p.radii[k]) < smallest)
        smallest = std::min(smallest, gap_of(p, k, places[w]));
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
  const auto places = positions_of(obstacles_of(setting, state.planes), state.time);
  // In a fluid contact is made at the threshold gap.
  const double touching = setting.solver.tolerance * mean_radius(p) +
                          (setting.fluid ? setting.fluid->threshold_gap : 0);
  for (const auto* pairs : {&state.pairs, &state.walls})
    for (const auto& pair : *pairs) {
      const auto [gap, normal, branch] = place_of(p, pair, places);
      const auto& memory = state.memories.of(pair.memory);
      const bool has_force = pair.impulse != 0 || norm(memory.friction()) > 0;
      if (!(pair.gamma < 0 || gap <= touching || has_force)) continue;
      // Before the first step there is no length of a step, and all impulses are 0.
      const double per_time = state.earlier_step > 0 ? 1 / state.earlier_step : 0;
      contacts.push_back({.first = pair.first,
                          .second = pair.second,
                          .gap = gap,
                          .gamma = pair.gamma,
                          .gamma_error = pair.gamma_error,
                          .image = pair.image,
                          .friction = friction_of(setting, memory),
                          .normal_force = per_time * pair.impulse,
                          .tangential_force = per_time * (memory.friction() + memory.across()),
                          .solid_force = per_time * memory[Remembered::kSolidLoad],
                          .normal = normal,
                          .branch = branch,
                          .shown = memory.shown()});
    }
  return contacts;
}

}  // namespace viscontact::particles
