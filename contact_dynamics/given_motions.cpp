// Particles and planes whose motion is given: their loads, and how they meet and press.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/constraint_rows/link_rows.hpp"
#include "viscontact/contact_dynamics/impacts/impacts.hpp"
#include "viscontact/contact_dynamics/projection/step_projection.hpp"
#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/particles/contact/shaped_contacts.hpp"

namespace viscontact::particles {
namespace {

// Growth of an overlap, in tolerances, that is no rounding error. Motions at one velocity leave
// overlaps as they are, but for rounding errors.
constexpr double kDeeper = 1e-3;

}  // namespace

void Simulation::add_given_loads(const ProjectionResult& projected, double h) {
  if (given_impulses_.empty()) return;
  const auto add = [&](const GivenParticleLoad& impulse) {
    assert(setting_.given_motions.contains(impulse.particle));
    auto& sum = *std::ranges::lower_bound(given_impulses_, impulse.particle, {},
                                          &GivenParticleLoad::particle);
    sum.force = sum.force + impulse.force;
    sum.torque = sum.torque + impulse.torque;
  };
  for (const auto& impulse : projected.on_given) add(impulse);
  if (impacts_in_plane_) std::ranges::for_each(impacts_in_plane_->on_given(), add);
  if (impacts_in_space_) std::ranges::for_each(impacts_in_space_->on_given(), add);
  const double impulse_time = impulse_time_of(h);
  const LinkTimes times{h, impulse_time, state_.time + h, false};
  for (const auto& link : link_equations(setting_.links, state_.particles, times))
    for (std::size_t r = 0; r < link.rows.size(); ++r)
      for (const auto& part : link.rows[r].parts)
        if (is_given(part.particle) && !part.is_turn)
          add({part.particle, impulse_time * link_forces_[link.first_force + r] * part.direction});
}

bool Simulation::has_given_motions() const {
  return !setting_.given_motions.empty() ||
         std::ranges::any_of(setting_.planes, [](const Plane& plane) {
           return !plane.load &&
                  (!plane.velocity.pieces.empty() || norm(plane.angular_velocity) > 0);
         });
}

bool Simulation::is_given(std::int32_t body) const {
  if (body >= 0) return setting_.given_motions.contains(body);
  return loaded_.empty() || loaded_[static_cast<std::size_t>(-1 - body)] < 0;
}

void Simulation::refuse_meeting(double next) const {
  if (setting_.given_motions.empty()) return;
  const auto& p = state_.particles;
  const auto before = positions_of(obstacles_, state_.time), after = positions_of(obstacles_, next);
  const double tolerance = setting_.solver.tolerance * mean_radius_;
  const auto moved = [&](std::int32_t k) {
    return point_of(displacements_.data(), index_of(k), p.dimension);
  };
  const auto shape_at_end = [&](std::int32_t k, const Vector& shift) {
    auto shape = p.placed_shape(index_of(k), shift + moved(k));
    if (!p.is_round(index_of(k)))
      shape = PlacedShape::at_angle(shape.shape, shape.centre,
                                    p.angles[index_of(k)] + turns_[index_of(k)]);
    return shape;
  };
  for (const auto* pairs : {&state_.pairs, &state_.walls})
    for (const auto& pair : *pairs) {
      if (!is_given(pair.first) || !is_given(pair.second)) continue;
      const auto j = index_of(pair.second);
      double start = 0, end = 0;
      if (has_other_shapes_ && !is_round(p, pair)) {
        const Vector shift = pair.first < 0 ? Vector{} : shift_of(p.cell, pair.image);
        const auto second = p.placed_shape(j, shift),
                   after_second = shape_at_end(pair.second, shift);
        start = pair.first < 0 ? gap(before[pair.plane()], second)
                               : gap(p.placed_shape(index_of(pair.first)), second);
        end = pair.first < 0 ? gap(after[pair.plane()], after_second)
                             : gap(shape_at_end(pair.first, {}), after_second);
      } else if (pair.first < 0) {
        start = gap(before[pair.plane()], p.position(j), p.radii[j]);
        end = gap(after[pair.plane()], p.position(j) + moved(pair.second), p.radii[j]);
      } else {
        const auto i = index_of(pair.first);
        const Vector apart = p.position(j) + shift_of(p.cell, pair.image) - p.position(i);
        const double sum = p.radii[i] + p.radii[j];
        start = norm(apart) - sum;
        end = norm(apart + moved(pair.second) - moved(pair.first)) - sum;
      }
      if (end < -tolerance && end < start - kDeeper * tolerance)
        throw Error(ErrorKind::kNotConverged,
                    "the given motions contradict each other: {}, whose motions are both given, "
                    "would overlap by {:.3g} mean radii in the step to time {}; change fixed, "
                    "velocity_given or the velocity of the plane",
                    name_of_pair(pair, p, setting_), -end / mean_radius_, next);
    }
}

Simulation::Pressing Simulation::pressing(const ProjectionResult& projected, double next) const {
  if (!has_given_motions()) return {};
  const auto before = positions_of(obstacles_, state_.time), after = positions_of(obstacles_, next);
  std::vector<std::int32_t> planes, particles;
  double impulse = 0;
  const auto add = [](std::vector<std::int32_t>& list, std::int32_t number) {
    if (std::ranges::find(list, number) == list.end()) list.push_back(number);
  };
  for (std::size_t f = 0; f < projected.pairs.size(); ++f) {
    const auto& pair = *projected.pairs[f];
    if (!(projected.impulses[f] > 0)) continue;
    for (const auto body : {pair.first, pair.second}) {
      if (!is_given(body)) continue;
      const bool moves = body < 0
                             ? before[pair.plane()] != after[pair.plane()]
                             : !setting_.given_motions.at(body).velocity.pieces.empty() ||
                                   !setting_.given_motions.at(body).angular_velocity.pieces.empty();
      if (!moves) continue;
      impulse += projected.impulses[f];
      if (body >= 0)
        add(particles, state_.particles.id(index_of(body)));
      else
        add(planes, body);
    }
  }
  const auto listed = [](std::string_view kind, std::vector<std::int32_t>& numbers) {
    std::ranges::sort(numbers, {}, [](std::int32_t n) { return std::abs(n); });
    if (numbers.empty()) return std::string();
    return fmt::format("{}{} {}", kind, numbers.size() > 1 ? "s" : "", fmt::join(numbers, ", "));
  };
  const auto of_planes = listed("plane", planes), of_particles = listed("particle", particles);
  const bool are_both = !planes.empty() && !particles.empty();
  return {of_planes + (are_both ? " and " : "") + of_particles, impulse};
}

}  // namespace viscontact::particles
