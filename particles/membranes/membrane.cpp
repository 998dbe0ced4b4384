// Functions for membranes in a fluid and without one (membrane.hpp). Lengths are in the unit of the
// case. Membranes that do not fit the case cause Error(kBadInput).
#include "viscontact/particles/membranes/membrane.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/particles/membranes/membrane_motion.hpp"
#include "viscontact/particles/membranes/necklace.hpp"
#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

const std::vector<Membrane>& membranes_of(const Setting& setting) {
  return setting.fluid ? setting.fluid->membranes : setting.links.membranes;
}

MembraneMeasures measure(const Membrane& membrane, const Particles& particles) {
  if (!membrane.lengths.empty()) return measure_necklace(membrane, particles);
  const std::array one = {membrane};
  const Membranes membranes(one);
  return measure(MembraneCurve(membrane.count()),
                 membranes.places(particles.positions, particles.cell),
                 membranes.from_particles(particles.velocities, 2));
}

namespace {

/// True if the distances of neighbours differ from those of the membrane by at most `kept` times
/// the mean distance. Always true in a fluid, where distances are equal parts of the perimeter.
bool keeps_distances(const Membrane& membrane, const Particles& particles, double kept) {
  if (membrane.lengths.empty()) return true;
  const Eigen::VectorXd distances = distances_of(necklace_of(membrane, particles));
  const double allowed = kept * membrane.perimeter / static_cast<double>(membrane.lengths.size());
  for (std::size_t k = 0; k < membrane.lengths.size(); ++k)
    if (!(std::abs(distances[static_cast<Eigen::Index>(k)] - membrane.lengths[k]) <= allowed))
      return false;
  return true;
}

}  // namespace

void check_shapes(std::span<const Membrane> membranes, const Particles& particles) {
  constexpr double kKept = 1e-6;
  for (std::size_t m = 0; m < membranes.size(); ++m) {
    const auto& asked = membranes[m];
    const auto found = measure(asked, particles);
    const bool has_area =
        !asked.keeps_area || std::abs(found.area - asked.area) <= kKept * asked.area;
    if (has_area && std::abs(found.perimeter - asked.perimeter) <= kKept * asked.perimeter &&
        keeps_distances(asked, particles, kKept))
      continue;
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("membrane {} of the restart file has the perimeter {:.7g} and the area "
                    "{:.7g}, that of the case {:.7g} and {:.7g}; both must be the same, but for an "
                    "area that is not kept, and without a fluid the distances of "
                    "neighbours must be the same, too",
                    m, found.perimeter, found.area, asked.perimeter, asked.area));
  }
}

void join_neighbours(std::span<const Membrane> membranes, Particles& particles) {
  particles.neighbours.clear();
  if (membranes.empty()) return;
  particles.neighbours.assign(particles.count(), {-1, -1});
  for (const auto& membrane : membranes)
    for (std::int32_t k = 0; k < membrane.count(); ++k)
      particles.neighbours[index_of(membrane.bead(k))] = {membrane.bead(k - 1),
                                                          membrane.bead(k + 1)};
}

std::string membrane_rows(const Setting& setting, const State& state,
                          std::span<const double> /*force_errors*/) {
  std::string text;
  const auto& membranes = membranes_of(setting);
  for (std::size_t m = 0; m < membranes.size(); ++m) {
    const auto measures = measure(membranes[m], state.particles);
    text += fmt::format("{},{}", format_number(state.time), m);
    for (const double value :
         {measures.x, measures.y, measures.inclination, measures.area, measures.perimeter,
          measures.membrane_speed, measures.tank_treading_frequency})
      text += "," + format_number(value);
    text += '\n';
  }
  return text;
}

}  // namespace viscontact::particles
