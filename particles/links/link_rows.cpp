// Makes the equations of links (link_rows.hpp).
#include "viscontact/particles/links/link_rows.hpp"

#include <fmt/format.h>

#include <cmath>

#include "viscontact/particles/bodies/body_step.hpp"
#include "viscontact/particles/rotation.hpp"

namespace viscontact::particles {
namespace {

// Newmark's beta. 1/4 is the least one that is stable for every stiffness.
constexpr double kBeta = 0.25;

/// The shortest of the vectors that differ from `apart` by periods of the domain.
Vector nearest_image(const Particles& p, Vector apart) {
  for (std::size_t d = 0; d < 2; ++d)
    if (const double period = p.cell.lengths[d]; period > 0)
      apart[d] -= period * std::round(apart[d] / period);
  return apart;
}

/// Centre of the unit of a particle [L].
Vector unit_centre(const Particles& p, std::int32_t particle) {
  const auto body = p.bodies.body_of(particle);
  return body < 0 ? p.position(index_of(particle)) : p.bodies.bodies[index_of(body)].centre;
}

/// Vector from the centre of its unit to the centre of a particle [L].
Vector arm_of_centre(const Particles& p, std::int32_t particle) {
  const auto body = p.bodies.body_of(particle);
  if (body < 0) return {};
  const auto& of = p.bodies.bodies[index_of(body)];
  for (std::size_t m = 0; m < of.members.size(); ++m)
    if (of.members[m] == particle) return present_offset(of, m, p.dimension);
  return {};
}

/// Vector from the centre of its unit to a linked point [L].
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

double unit_angle(const Particles& p, std::int32_t particle) {
  const auto body = p.bodies.body_of(particle);
  return body < 0 ? p.angles[index_of(particle)] : p.bodies.bodies[index_of(body)].angle[2];
}

/// Angular velocity of the unit of a disc.
double unit_spin(const Particles& p, std::int32_t particle) {
  return p.angular_velocities[index_of(particle)];
}

/// Vector from the centre of `first` to that of the nearest image of `second` [L].
Vector between(const Particles& p, std::int32_t first, std::int32_t second) {
  return nearest_image(p, p.position(index_of(second)) - p.position(index_of(first)));
}

Vector direction_of(const Vector& apart) {
  const double length = norm(apart);
  return length > 0 ? (1 / length) * apart : Vector{1, 0, 0};
}

LinkRow row_between(const Particles& p, std::int32_t first, std::int32_t second,
                    const Vector& direction) {
  LinkRow row;
  row.first = {first, -1 * direction, arm_of_centre(p, first)};
  row.second = {second, direction, arm_of_centre(p, second)};
  return row;
}

/// What Newmark's method makes of a spring: with the extension e and its rate, the impulse is
/// -kick stiffness (e + beta (change of e in this step - change in the last one)). Before the first
/// step, the change in the last one is 2 h rate - change in this step.
void make_spring(LinkRow& row, double extension, double rate, double stiffness,
                 const LinkTimes& times) {
  const double beta = times.is_first ? 2 * kBeta : kBeta;
  row.extension = extension;
  row.stiffness = stiffness;
  row.value = extension / beta - times.h * rate;
  row.compliance = 1 / (times.kick * stiffness * beta);
}

LinkEquations hinge_equations(const Hinge& hinge, const Particles& p) {
  LinkEquations equations{LinkEquations::Kind::kHinge};
  const Vector arm = arm_of_point(p, hinge.point);
  const Vector off = nearest_image(p, unit_centre(p, hinge.point.particle) + arm - hinge.at);
  for (std::size_t d = 0; d < static_cast<std::size_t>(p.dimension); ++d) {
    LinkRow row;
    row.second = {hinge.point.particle, {}, arm};
    row.second.direction[d] = 1;
    row.value = off[d];
    equations.rows.push_back(row);
  }
  return equations;
}

LinkEquations torsion_equations(const Hinge& hinge, const Particles& p, const LinkTimes& times) {
  LinkEquations equations{LinkEquations::Kind::kTorsion};
  LinkRow row;
  row.second.particle = hinge.point.particle;
  row.second.is_turn = true;
  make_spring(row, unit_angle(p, hinge.point.particle) - hinge.rest_angle,
              unit_spin(p, hinge.point.particle), hinge.stiffness, times);
  equations.rows.push_back(row);
  return equations;
}

LinkEquations spring_equations(const Spring& spring, const Particles& p, const LinkTimes& times) {
  LinkEquations equations{LinkEquations::Kind::kSpring};
  const Vector apart = between(p, spring.first, spring.second);
  const Vector direction = direction_of(apart);
  auto row = row_between(p, spring.first, spring.second, direction);
  const double rate =
      dot(direction, p.velocity(index_of(spring.second)) - p.velocity(index_of(spring.first)));
  make_spring(row, norm(apart) - spring.length, rate, spring.stiffness, times);
  equations.rows.push_back(row);
  return equations;
}

LinkEquations arm_equations(const Arm& arm, const Particles& p, const LinkTimes& times) {
  LinkEquations equations{LinkEquations::Kind::kArm};
  const Vector apart = between(p, arm.first, arm.second);
  auto row = row_between(p, arm.first, arm.second, direction_of(apart));
  row.value = norm(apart) - length_at(arm.length, times.end);
  equations.rows.push_back(row);
  return equations;
}

/// Displacement of the point of a part.
Vector moved(const RowPart& part, const UnitMotion& motion, int dimension) {
  return displacement_at(motion.displacement, motion.turn, part.arm, dimension);
}

}  // namespace

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
  return all;
}

std::vector<double> values_after(const LinkEquations& equations, const Links& links,
                                 const Particles& particles, const LinkTimes& times,
                                 const UnitMotion& first, const UnitMotion& second) {
  const int dimension = particles.dimension;
  std::vector<double> values;
  if (equations.kind == LinkEquations::Kind::kHinge) {
    const Vector by = moved(equations.rows.front().second, second, dimension);
    for (std::size_t d = 0; d < equations.rows.size(); ++d)
      values.push_back(equations.rows[d].value + by[d]);
    return values;
  }
  const auto& row = equations.rows.front();
  if (equations.kind == LinkEquations::Kind::kArm) {
    const auto& arm = links.arms[equations.number];
    const Vector apart = between(particles, arm.first, arm.second) +
                         moved(row.second, second, dimension) - moved(row.first, first, dimension);
    return {norm(apart) - length_at(arm.length, times.end)};
  }
  // Springs are linear in the motion of the step.
  const auto part = [](const RowPart& of, const UnitMotion& by) {
    if (of.particle < 0) return 0.0;
    return of.is_turn ? by.turn[2] : dot(of.direction, by.displacement + cross(by.turn, of.arm));
  };
  return {row.value + part(row.first, first) + part(row.second, second)};
}

double rate_of_arm(const Arm& arm, const Particles& particles, const UnitMotion& first,
                   const UnitMotion& second) {
  const auto row = arm_equations(arm, particles, {}).rows.front();
  const auto rate = [](const RowPart& of, const UnitMotion& by) {
    return dot(of.direction, by.displacement + cross(by.turn, of.arm));
  };
  return rate(row.first, first) + rate(row.second, second);
}

std::string name_of(const LinkEquations& equations, const Links& links,
                    const Particles& particles) {
  const auto k = equations.number;
  const auto pair = [&](const char* what, std::int32_t first, std::int32_t second) {
    return fmt::format("{} {} (particles {} and {})", what, k + 1, particles.id(index_of(first)),
                       particles.id(index_of(second)));
  };
  if (equations.kind == LinkEquations::Kind::kArm)
    return pair("arm", links.arms[k].first, links.arms[k].second);
  if (equations.kind == LinkEquations::Kind::kSpring)
    return pair("spring", links.springs[k].first, links.springs[k].second);
  const auto& hinge = links.hinges[k];
  if (hinge.body >= 0) return fmt::format("hinge {} (body {})", k + 1, hinge.body);
  return fmt::format("hinge {} (particle {})", k + 1, particles.id(index_of(hinge.point.particle)));
}

}  // namespace viscontact::particles
