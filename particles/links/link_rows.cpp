// Makes the equations of hinges, springs, arms and stops for one time step. A row is one equation,
// value + sum of its parts + compliance * impulse = 0. A part belongs to a unit, which is a rigid
// body or a particle without a body. Rows of displacements have values in [L], impulses in [M L/T]
// and stiffnesses in [M/T^2]; rows of turns have values in [rad], moments of impulses in [M L^2/T]
// and stiffnesses in [M L^2/T^2]. The times LinkTimes::h and kick are > 0 [T]; motions of units are
// in [L, rad]; units are any consistent ones. Links, particles and places of forces count from 0.
// Nothing is checked or thrown. constraints/, fluid/, run/ and simulation.cpp use it. A change must
// keep the order of forces in State::link_forces, which restart files store, and that the parts of
// a row are the derivatives of values_after() with respect to the motion.
#include "viscontact/particles/links/link_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "viscontact/particles/bodies/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

/// Centre of the unit of a particle [L].
Vector unit_centre(const Particles& p, std::int32_t particle) {
  const auto body = p.bodies.body_of(particle);
  return body < 0 ? p.position(index_of(particle)) : p.bodies.bodies[index_of(body)].centre;
}

/// Vector [L] from the centre of the unit of a linked point to the point.
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

/// The periodic image of a particle that is nearest to another one: the vector to it from the
/// centre of the other [L], and the numbers of periods by which it is shifted.
struct NearestImage {
  Vector apart{};
  Periods periods{};
};

/// The image of `second` that is nearest to `first`.
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

/// The row of the distance of two centres, with the value 0.
LinkRow row_between(const Particles& p, std::int32_t first, std::int32_t second,
                    const NearestImage& nearest) {
  const Vector direction = direction_of(nearest.apart);
  LinkRow row;
  row.parts = {{first, -1 * direction, offset_in_body(p, first)},
               {second, direction, offset_in_body(p, second), false, nearest.periods}};
  return row;
}

/// Sets the row of a spring of the `stiffness` > 0 by Newmark's method with the parameter beta [1].
/// With the `extension` e before the step [L, rad] and its `rate` [L/T, 1/T], the impulse is -kick
/// stiffness (e + beta (change of e in this step - h rate)).
void make_spring(LinkRow& row, double extension, double rate, double stiffness,
                 const LinkTimes& times) {
  const double beta = times.beta();
  row.extension = extension;
  row.stiffness = stiffness;
  row.value = extension / beta - times.h * rate;
  row.compliance = 1 / (times.kick * stiffness * beta);
}

/// The rows of a hinge, one for each component of the vector from the fixed place to the point that
/// the hinge holds [L].
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

/// The row of the torsion spring of a hinge, whose extension is the angle of the unit minus the
/// angle at rest [rad].
LinkEquations torsion_equations(const Hinge& hinge, const Particles& p, const LinkTimes& times) {
  LinkEquations equations{LinkEquations::Kind::kTorsion};
  LinkRow row;
  row.parts = {{.particle = hinge.point.particle, .direction = {0, 0, 1}, .is_turn = true}};
  make_spring(row, unit_angle(p, hinge.point.particle) - hinge.rest_angle,
              unit_spin(p, hinge.point.particle), hinge.stiffness, times);
  equations.rows.push_back(row);
  return equations;
}

/// The row of a spring, whose extension is the distance of its ends minus its length [L].
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

/// The row of an arm: its value is the distance of the ends before the step minus the length at the
/// end of the step [L].
LinkEquations arm_equations(const Arm& arm, const Particles& p, const LinkTimes& times) {
  LinkEquations equations{LinkEquations::Kind::kArm};
  const auto nearest = between(p, arm.first, arm.second);
  auto row = row_between(p, arm.first, arm.second, nearest);
  row.value = norm(nearest.apart) - length_at(arm.length, times.end);
  equations.rows.push_back(row);
  return equations;
}

/// Displacement of the point of a part for the motion of its unit [L].
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

/// Numbers of periods from a particle to the periodic image of it that belongs to its rigid body; 0
/// without a body.
Periods periods_in_unit(const Particles& particles, std::int32_t particle) {
  const auto body = particles.bodies.body_of(particle);
  if (body < 0) return {};
  const auto& of = particles.bodies.bodies[index_of(body)];
  return periods_of_member(of, member_number(of, particle), particles);
}

/// Rate [L/T] at which the sum of the parts changes because periodic images move relative to their
/// particles; 0 unless the cell is sheared.
double image_rate(const LinkRow& row, const PeriodicCell& cell) {
  double rate = 0;
  for (const auto& part : row.parts)
    if (!part.is_turn) rate += dot(part.direction, velocity_of_image(cell, part.image));
  return rate;
}

/// Value of a part for the motion of its unit, to first order in the turn [L, rad].
double value_of(const LinkPart& part, const UnitMotion& motion) {
  return part.is_turn ? dot(part.direction, motion.turn)
                      : dot(part.direction, motion.displacement + cross(motion.turn, part.arm));
}

/// The equations of all hinges, each with its torsion spring, and then of springs, arms and
/// membranes. `first_force` is the place of the force of the first row in State::link_forces.
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

/// The stops of all hinges; none unless the particles are discs. The value of a row is the angle
/// that is left to the stop [rad], which must be >= 0 after a step.
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

/// A copy of `equations` for the places after `motions`, one for each unit. Directions of arms and
/// springs, and the vectors from units to their points, are those after the motions; values stay as
/// they are.
LinkEquations turned_equations(const LinkEquations& equations, const Links& links,
                               const Particles& particles, std::span<const UnitMotion> motions) {
  auto turned = equations;
  const bool has_ends =
      equations.kind == LinkEquations::Kind::kArm || equations.kind == LinkEquations::Kind::kSpring;
  const Vector direction =
      has_ends ? direction_of(apart_after(equations, links, particles, motions)) : Vector{};
  for (auto& row : turned.rows)
    for (std::size_t i = 0; i < row.parts.size(); ++i) {
      auto& part = row.parts[i];
      if (has_ends) part.direction = i == 0 ? -1 * direction : direction;
      // The vector from the centre of the unit to the point of the part turns with the unit.
      if (!part.is_turn)
        part.arm = part.arm + displacement_at({}, motions[i].turn, part.arm, particles.dimension);
    }
  return turned;
}

/// For each row its value plus the sum of its parts after `motions` [L, rad]. The result is exact,
/// except for springs, where it is of first order.
std::vector<double> values_after(const LinkEquations& equations, const Links& links,
                                 const Particles& particles, const LinkTimes& times,
                                 std::span<const UnitMotion> motions) {
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
  // The value of the row of a spring is computed to first order in the motions.
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

/// Rate [L/T] at which an arm grows at the present places; `first` and `second` are the velocities
/// of the units of its ends [L/T, 1/T].
double rate_of_arm(const Arm& arm, const Particles& particles, const UnitMotion& first,
                   const UnitMotion& second) {
  const auto equations = arm_equations(arm, particles, {});
  return value_of(equations.parts()[0], first) + value_of(equations.parts()[1], second);
}

/// Name of a link in messages, with its number from 0 and the ids of its particles, such as "arm 2
/// (particles 3 and 4)".
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
