// Contacts and overlaps of a state, in the units of the case (current_contacts.hpp).
#include "viscontact/particles/current_contacts.hpp"

#include <algorithm>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/contact_geometry.hpp"
#include "viscontact/particles/neighbours/neighbours.hpp"

namespace viscontact::particles {
namespace {

double gap_of(const Particles& p, const Film& film, std::span<const PlanePosition> places) {
  return p.dimension == 2 ? contact_of<2>(p, film, places).gap : contact_of<3>(p, film, places).gap;
}

}  // namespace

std::pair<std::int32_t, std::int32_t> ids_of(const Particles& particles,
                                             const CurrentContact& contact) {
  const auto second = particles.id(static_cast<std::size_t>(contact.second));
  if (contact.first < 0) return {second, contact.first};
  return {particles.id(static_cast<std::size_t>(contact.first)), second};
}

double largest_overlap(const Setting& setting, const State& state) {
  double smallest = 0;
  const auto& p = state.particles;
  ThreadPool pool(1);
  for (const auto& pair : close_pairs(p.dimension, p.positions, p.radii, pool))
    smallest = std::min(smallest, gap_of(p, {pair.first, pair.second}, {}));
  for (const auto& place : positions_of(setting.planes, state.time))
    for (std::size_t k = 0; k < p.count(); ++k)
      smallest = std::min(smallest, gap(place, p.position(k), p.radii[k]));
  return (0 - smallest) / mean_radius(p);  // the subtraction returns 0 instead of -0
}

double largest_gamma_error(const State& state) {
  double largest = 0;
  for (const auto* films : {&state.pairs, &state.walls})
    for (const auto& film : *films) largest = std::max(largest, film.gamma_error);
  return largest;
}

std::vector<CurrentContact> contacts_of(const Setting& setting, const State& state) {
  std::vector<CurrentContact> contacts;
  const auto& p = state.particles;
  const auto places = positions_of(setting.planes, state.time);
  const double touching = setting.solver.tolerance * mean_radius(p);
  for (const auto* films : {&state.pairs, &state.walls})
    for (const auto& film : *films)
      if (const double gap = gap_of(p, film, places); film.gamma < 0 || gap <= touching)
        contacts.push_back({film.first, film.second, gap, film.gamma, film.gamma_error});
  return contacts;
}

}  // namespace viscontact::particles
