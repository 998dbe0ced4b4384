// The rows of hinges, springs, arms and stops, docs/physics.md (5.12) to (5.14).
#include "viscontact/constraint_rows/link_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

/// Centre of the unit of a particle [L].
Vector unit_centre(const Particles& p, std::int32_t particle) {
  const auto body = p.bodies.body_of(particle);
  return body < 0 ? p.position(index_of(particle)) : p.bodies.bodies[index_of(body)].centre;
}

/// From the centre of the unit of a linked point to the point [L].
Vector arm_of_point(const Particles& p, const LinkedPoint& point) {
  const auto body = p.bodies.body_of(point.particle);
  if (body >= 0) return turned_with(p.bodies.bodies[index_of(body)], point.offset, p.dimension);
  const auto k = index_of(point.particle);
  if (p.dimension == 3)
    return rotated({p.orientations[4 * k], p.orientations[4 * k + 1], p.orientations[4 * k + 2],
                    p.orientations[4 * k + 3]},
                   point.offset);
  return displacement_at({}, {0, 0, p.angles[k]}, point.offset, 2) + point.offset;
}

/// Angle of the unit of a disc [rad].
double unit_angle(const Particles& p, std::int32_t particle) {
  const auto body = p.bodies.body_of(particle);
  return body < 0 ? p.angles[index_of(particle)] : p.bodies.bodies[index_of(body)].angle[2];
}

/// Angular velocity of the unit of a disc [1/T].
double unit_spin(const Particles& p, std::int32_t particle) {
  return p.angular_velocities[index_of(particle)];
}

/// The periodic image of a particle that is nearest to another one: the vector to it [L], and the
/// numbers of periods by which it is shifted.
struct NearestImage {
  Vector apart{};
  Periods periods{};
};

NearestImage between(const Particles& p, std::int32_t first, std::int32_t second) {
  const Vector apart = p.position(index_of(second)) - p.position(index_of(first));
  const auto beyond = periods_towards(p.cell, apart);
  return {apart - shift_of(p.cell, beyond), -1.0 * beyond};
}

/// Unit vector along `apart`; the first axis if `apart` is 0.
Vector direction_of(const Vector& apart) {
  const double length = norm(apart);
  return length > 0 ? (1 / length) * apart : Vector{1, 0, 0};
}

LinkRow row_between(const Particles& p, std::int32_t first, std::int32_t second,
                    const NearestImage& nearest) {
  const Vector direction = direction_of(nearest.apart);
  LinkRow row;
  row.parts = {{first, -1 * direction, offset_in_body(p, first)},
               {second, direction, offset_in_body(p, second), false, nearest.periods}};
  return row;
}

/// Newmark's method with the parameter beta: with the `extension` e before the step [L, rad] and
/// its `rate` [L/T, 1/T], the impulse is -impulse_time stiffness (e + beta (change of e in this
/// step - h rate)).
void make_spring(LinkRow& row, double extension, double rate, double stiffness,
                 const LinkTimes& times) {
  assert(stiffness > 0 && times.impulse_time > 0);
  const double beta = times.beta();
  row.extension = extension;
  row.stiffness = stiffness;
  row.value = extension / beta - (times.is_first ? 0 : times.h * rate);
  row.compliance = 1 / (times.impulse_time * stiffness * beta);
}

/// One row for each component of the vector from the fixed place to the point of the hinge [L].
LinkEquations hinge_equations(const Hinge& hinge, const Particles& p) {
  LinkEquations equations{LinkEquations::Kind::kHinge};
  const auto particle = hinge.point.particle;
  const Vector arm = arm_of_point(p, hinge.point);
  const Vector apart = unit_centre(p, particle) + arm - hinge.at;
  const auto beyond = periods_towards(p.cell, apart);
  const Vector off = apart - shift_of(p.cell, beyond);
  const auto of_unit = periods_in_unit(p, particle);
  for (std::size_t d = 0; d < static_cast<std::size_t>(p.dimension); ++d) {
    LinkPart part{particle, {}, arm, false, of_unit - beyond};
    part.direction[d] = 1;
    equations.rows.push_back({{part}, off[d]});
  }
  return equations;
}

/// The extension is the angle of the unit minus the angle at rest [rad].
LinkEquations torsion_equations(const Hinge& hinge, const Particles& p, const LinkTimes& times) {
  LinkEquations equations{LinkEquations::Kind::kTorsion};
  LinkRow row;
  row.parts = {{.particle = hinge.point.particle, .direction = {0, 0, 1}, .is_turn = true}};
  make_spring(row, unit_angle(p, hinge.point.particle) - hinge.rest_angle,
              unit_spin(p, hinge.point.particle), hinge.stiffness, times);
  equations.rows.push_back(row);
  return equations;
}

LinkEquations spring_equations(const Spring& spring, const Particles& p, const LinkTimes& times) {
  LinkEquations equations{LinkEquations::Kind::kSpring};
  const auto nearest = between(p, spring.first, spring.second);
  auto row = row_between(p, spring.first, spring.second, nearest);
  const double rate = dot(row.parts[1].direction, p.velocity(index_of(spring.second)) -
                                                      p.velocity(index_of(spring.first))) +
                      image_rate(row, p.cell);
  make_spring(row, norm(nearest.apart) - spring.length, rate, spring.stiffness, times);
  equations.rows.push_back(row);
  return equations;
}

LinkEquations arm_equations(const Arm& arm, const Particles& p, const LinkTimes& times) {
  LinkEquations equations{LinkEquations::Kind::kArm};
  const auto nearest = between(p, arm.first, arm.second);
  auto row = row_between(p, arm.first, arm.second, nearest);
  row.value = norm(nearest.apart) - length_at(arm.length, times.end);
  equations.rows.push_back(row);
  return equations;
}

/// Displacement of the point of a part [L].
Vector moved(const LinkPart& part, const UnitMotion& motion, int dimension) {
  return displacement_at(motion.displacement, motion.turn, part.arm, dimension);
}

/// Vector from the first to the second end of an arm or spring after these motions [L].
Vector apart_after(const LinkEquations& equations, const Links& links, const Particles& p,
                   std::span<const UnitMotion> motions) {
  const auto k = equations.number;
  const Vector apart = equations.kind == LinkEquations::Kind::kArm
                           ? between(p, links.arms[k].first, links.arms[k].second).apart
                           : between(p, links.springs[k].first, links.springs[k].second).apart;
  const auto& ends = equations.parts();
  return apart + moved(ends[1], motions[1], p.dimension) - moved(ends[0], motions[0], p.dimension);
}

}  // namespace

Periods periods_in_unit(const Particles& particles, std::int32_t particle) {
  const auto body = particles.bodies.body_of(particle);
  if (body < 0) return {};
  const auto& of = particles.bodies.bodies[index_of(body)];
  return periods_of_member(of, member_number(of, particle), particles);
}

double image_rate(const LinkRow& row, const PeriodicCell& cell) {
  double rate = 0;
  for (const auto& part : row.parts)
    if (!part.is_turn) rate += dot(part.direction, velocity_of_image(cell, part.image));
  return rate;
}

double value_of(const LinkPart& part, const UnitMotion& motion) {
  return part.is_turn ? dot(part.direction, motion.turn)
                      : dot(part.direction, motion.displacement + cross(motion.turn, part.arm));
}

std::vector<LinkEquations> link_equations(const Links& links, const Particles& particles,
                                          const LinkTimes& times) {
  std::vector<LinkEquations> all;
  const int dimension = particles.dimension;
  const auto add = [&](LinkEquations equations, std::size_t number, std::size_t place) {
    equations.number = number;
    equations.first_force = place;
    all.push_back(std::move(equations));
  };
  for (std::size_t k = 0; k < links.hinges.size(); ++k) {
    const std::size_t place = k * Links::forces_of_hinge(dimension);
    add(hinge_equations(links.hinges[k], particles), k, place);
    if (links.hinges[k].stiffness > 0)
      add(torsion_equations(links.hinges[k], particles, times), k,
          place + static_cast<std::size_t>(dimension));
  }
  for (std::size_t k = 0; k < links.springs.size(); ++k)
    add(spring_equations(links.springs[k], particles, times), k,
        links.place_of_spring(k, dimension));
  for (std::size_t k = 0; k < links.arms.size(); ++k)
    add(arm_equations(links.arms[k], particles, times), k, links.place_of_arm(k, dimension));
  for (std::size_t m = 0; m < links.membranes.size(); ++m) {
    auto place = links.place_of_membrane(m, dimension);
    for (auto& equations : membrane_equations(links.membranes[m], particles, times))
      add(std::move(equations), m, place++);
  }
  return all;
}

std::vector<LinkEquations> stop_equations(const Links& links, const Particles& particles) {
  std::vector<LinkEquations> all;
  for (std::size_t k = 0; k < links.hinges.size(); ++k) {
    const auto& hinge = links.hinges[k];
    const auto particle = hinge.point.particle;
    const auto add = [&](double left, double sign) {
      if (!std::isfinite(left)) return;
      LinkEquations stop{.kind = LinkEquations::Kind::kStop,
                         .number = k,
                         .first_force = k * Links::forces_of_hinge(2) + 2};
      stop.rows.push_back(
          {{{.particle = particle, .direction = {0, 0, sign}, .is_turn = true}}, left});
      all.push_back(std::move(stop));
    };
    if (particles.dimension != 2) continue;
    const double angle = unit_angle(particles, particle);
    add(angle - hinge.lowest_angle, 1);
    add(hinge.highest_angle - angle, -1);
  }
  return all;
}

LinkEquations turned_equations(const LinkEquations& equations, const Links& links,
                               const Particles& particles, std::span<const UnitMotion> motions) {
  assert(motions.size() == equations.parts().size());
  auto turned = equations;
  const bool has_ends =
      equations.kind == LinkEquations::Kind::kArm || equations.kind == LinkEquations::Kind::kSpring;
  const Vector direction =
      has_ends ? direction_of(apart_after(equations, links, particles, motions)) : Vector{};
  for (auto& row : turned.rows)
    for (std::size_t i = 0; i < row.parts.size(); ++i) {
      auto& part = row.parts[i];
      if (has_ends) part.direction = i == 0 ? -1 * direction : direction;
      if (!part.is_turn)
        part.arm = part.arm + displacement_at({}, motions[i].turn, part.arm, particles.dimension);
    }
  return turned;
}

std::vector<double> values_after(const LinkEquations& equations, const Links& links,
                                 const Particles& particles, const LinkTimes& times,
                                 std::span<const UnitMotion> motions) {
  assert(motions.size() == equations.parts().size());
  if (equations.kind == LinkEquations::Kind::kArm)
    return {norm(apart_after(equations, links, particles, motions)) -
            length_at(links.arms[equations.number].length, times.end)};
  if (equations.is_of_membrane() && !equations.is_spring())
    return {membrane_value_after(equations, links.membranes[equations.number], particles, motions)};
  std::vector<double> values;
  if (equations.kind == LinkEquations::Kind::kHinge) {
    const Vector by = moved(equations.parts().front(), motions.front(), particles.dimension);
    for (std::size_t d = 0; d < equations.rows.size(); ++d)
      values.push_back(equations.rows[d].value + by[d]);
    return values;
  }
  for (const auto& row : equations.rows) {
    values.push_back(row.value);
    for (std::size_t i = 0; i < row.parts.size(); ++i)
      values.back() += value_of(row.parts[i], motions[i]);
  }
  return values;
}

double extension_after(const LinkEquations& spring, const Links& links, const Particles& particles,
                       std::span<const UnitMotion> motions) {
  return norm(apart_after(spring, links, particles, motions)) - links.springs[spring.number].length;
}

double rate_of_arm(const Arm& arm, const Particles& particles, const UnitMotion& first,
                   const UnitMotion& second) {
  const auto equations = arm_equations(arm, particles, {});
  return value_of(equations.parts()[0], first) + value_of(equations.parts()[1], second);
}

std::string name_of(const LinkEquations& equations, const Links& links,
                    const Particles& particles) {
  const auto k = equations.number;
  const auto pair = [&](const char* what, std::int32_t first, std::int32_t second) {
    return fmt::format("{} {} (particles {} and {})", what, k, particles.id(index_of(first)),
                       particles.id(index_of(second)));
  };
  if (equations.kind == LinkEquations::Kind::kArm)
    return pair("arm", links.arms[k].first, links.arms[k].second);
  if (equations.kind == LinkEquations::Kind::kSpring)
    return pair("spring", links.springs[k].first, links.springs[k].second);
  if (equations.is_of_membrane()) {
    const auto& membrane = links.membranes[k];
    if (equations.kind == LinkEquations::Kind::kArea) return fmt::format("membrane {} (area)", k);
    if (equations.kind == LinkEquations::Kind::kDistance)
      return pair("membrane", membrane.bead(equations.bead), membrane.bead(equations.bead + 1));
    return fmt::format("membrane {} ({} at particle {})", k,
                       equations.kind == LinkEquations::Kind::kBend ? "bend" : "turn",
                       particles.id(index_of(membrane.bead(equations.bead))));
  }
  const auto& hinge = links.hinges[k];
  if (equations.kind == LinkEquations::Kind::kStop) return fmt::format("a stop of hinge {}", k);
  if (hinge.body >= 0) return fmt::format("hinge {} (body {})", k, hinge.body);
  return fmt::format("hinge {} (particle {})", k, particles.id(index_of(hinge.point.particle)));
}

}  // namespace viscontact::particles
