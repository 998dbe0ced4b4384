// The errors of a step that has no solution, in words (simulation.hpp).
#include <fmt/format.h>

#include <string>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/projection/step_projection.hpp"
#include "viscontact/particles/simulation.hpp"

namespace viscontact::particles {

void Simulation::throw_step_without_solution(const ProjectionResult& projected, double next) const {
  const auto& overlapping = projected.deepest_overlap;
  std::string moving;
  // Whether each obstacle pushes on a particle in this step.
  std::vector<char> presses(obstacles_.size(), 0);
  for (const auto* wall : projected.pairs)
    if (wall->first < 0 && wall->impulse > 0) presses[wall->plane()] = 1;
  const auto before = positions_of(obstacles_, state_.time);
  const auto after = positions_of(obstacles_, next);
  for (std::size_t w = 0; w < before.size(); ++w)
    if (presses[w] != 0 && before[w] != after[w])
      moving += fmt::format("{}{}", moving.empty() ? "" : ", ", w + 1);
  const auto id = [&](std::int32_t k) { return state_.particles.id(index_of(k)); };
  const auto pair =
      overlapping.first < 0
          ? fmt::format("particle {} and {} {}", id(overlapping.second),
                        obstacles_.size() > setting_.planes.size() ? "obstacle" : "plane",
                        -overlapping.first)
          : fmt::format("particles {} and {}", id(overlapping.first), id(overlapping.second));
  throw Error(
      ErrorKind::kNotConverged,
      fmt::format("no solution of the step to time {} was found: {} would overlap by {:.3g} "
                  "mean radii{}",
                  next, pair, -projected.smallest_gap / mean_radius_,
                  moving.empty() ? std::string("; is the time step too long for the forces?")
                                 : fmt::format("; the planes that move are {}: do they leave the "
                                               "particles too little room?",
                                               moving)));
}

void Simulation::throw_contradiction(const ProjectionResult& projected, double next) const {
  std::string names;
  for (const auto& name : projected.unsolved_links)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  const auto id = [&](std::int32_t k) { return state_.particles.id(index_of(k)); };
  const auto& pair = projected.deepest_overlap;
  std::string overlap;
  if (projected.smallest_gap < 0)
    overlap = pair.first < 0 ? fmt::format(" without an overlap of particle {} with obstacle {}",
                                           id(pair.second), -pair.first)
                             : fmt::format(" without an overlap of particles {} and {}",
                                           id(pair.first), id(pair.second));
  throw Error(ErrorKind::kNotConverged,
              fmt::format("the constraints of the step to time {} contradict each other: no motion "
                          "satisfies {}{}; change their lengths or places, or leave one out",
                          next, names, overlap));
}

}  // namespace viscontact::particles
