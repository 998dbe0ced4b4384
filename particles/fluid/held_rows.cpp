// Makes the rows of rigid bodies and links in a fluid (held_rows.hpp).
#include "viscontact/particles/fluid/held_rows.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "viscontact/particles/bodies/body_step.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::particles {
namespace {

/// Whether a link holds exactly after a step, whatever force it needs.
bool is_exact(const LinkEquations& link) {
  return link.kind == LinkEquations::Kind::kHinge || link.kind == LinkEquations::Kind::kArm;
}

}  // namespace

HeldMotion::HeldMotion(const Links& links, const Particles& particles, const LinkTimes& times,
                       std::span<const char> accelerates)
    : links_(links),
      particles_(particles),
      times_(times),
      layout_{motion_components(particles.dimension)},
      equations_(link_equations(links, particles, times)) {
  for (const auto& body : particles.bodies.bodies) {
    body_rows_ += layout_.components * (body.members.size() - 1);
    auto weights = member_masses(body, particles);
    for (auto& weight : weights)
      weight = body.mass > 0 ? weight / body.mass : 1 / static_cast<double>(weights.size());
    weights_.push_back(std::move(weights));
    auto& velocities = image_velocities_.emplace_back();
    for (std::size_t m = 0; m < body.members.size(); ++m)
      velocities.push_back(
          velocity_of_image(particles.cell, periods_of_member(body, m, particles)));
  }
  in_rows_ = equations_;
  is_turned_.assign(equations_.size(), 0);
  turn_to_middle(accelerates);
}

void HeldMotion::turn_to_middle(std::span<const char> accelerates) {
  if (accelerates.empty()) return;
  const auto does = [&](const RowPart& part) {
    return part.particle >= 0 && accelerates[index_of(part.particle)] != 0;
  };
  std::vector<double> velocities(particles_.count() * layout_.components);
  const auto n = layout_.directions();
  for (std::size_t k = 0; k < particles_.count(); ++k) {
    for (std::size_t d = 0; d < n; ++d)
      velocities[k * layout_.components + d] = particles_.velocities[k * n + d];
    if (layout_.components == 3) velocities[k * 3 + 2] = particles_.angular_velocities[k];
  }
  const auto half = [&](const RowPart& part) {
    const auto motion = motion_of(part, velocities);
    return UnitMotion{0.5 * motion.displacement, 0.5 * motion.turn};
  };
  for (std::size_t l = 0; l < equations_.size(); ++l) {
    const auto& row = equations_[l].rows.front();
    if (!does(row.first) && !does(row.second)) continue;
    is_turned_[l] = 1;
    in_rows_[l] =
        turned_equations(equations_[l], links_, particles_, half(row.first), half(row.second));
  }
}

/// Vector from the centre of its body to the centre of a particle [L]; 0 without a body.
Vector HeldMotion::offset_in_body(std::int32_t particle) const {
  const auto number = particles_.bodies.body_of(particle);
  if (number < 0) return {};
  const auto& body = particles_.bodies.bodies[index_of(number)];
  for (std::size_t m = 0; m < body.members.size(); ++m)
    if (body.members[m] == particle) return present_offset(body, m, particles_.dimension);
  return {};
}

/// The rows that give each member the rigid motion of the first one.
void HeldMotion::add_body_rows(const RigidBody& body, std::size_t number,
                               std::vector<HeldRow>& rows) const {
  const auto first = body.members.front();
  const Vector start = present_offset(body, 0, particles_.dimension);
  const auto& of_images = image_velocities_[number];
  for (std::size_t m = 1; m < body.members.size(); ++m) {
    const auto member = body.members[m];
    const Vector apart = present_offset(body, m, particles_.dimension) - start;
    for (std::size_t d = 0; d < 3; ++d) {
      HeldRow row;
      row.name = fmt::format("body {}", number);
      row.entries = {{layout_.at(member, d), 1}, {layout_.at(first, d), -1}};
      // v_m - v_1 - w_1 x apart
      if (d < 2) {
        row.entries.emplace_back(layout_.at(first, 2), d == 0 ? apart[1] : -apart[0]);
        row.image_rate = of_images[m][d] - of_images[0][d];
      }
      rows.push_back(std::move(row));
    }
  }
}

void HeldMotion::add_entries(const RowPart& part, HeldRow& row) const {
  if (part.particle < 0) return;
  if (part.is_turn) {
    row.entries.emplace_back(layout_.at(part.particle, 2), 1);
    return;
  }
  for (std::size_t d = 0; d < layout_.directions(); ++d)
    if (part.direction[d] != 0)
      row.entries.emplace_back(layout_.at(part.particle, d), part.direction[d]);
  if (layout_.components != 3) return;
  const Vector arm = part.arm - offset_in_body(part.particle);
  if (const double moment = cross(arm, part.direction)[2]; moment != 0)
    row.entries.emplace_back(layout_.at(part.particle, 2), moment);
}

std::vector<HeldRow> HeldMotion::rows() const {
  std::vector<HeldRow> rows;
  const auto& bodies = particles_.bodies.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) add_body_rows(bodies[b], b, rows);
  for (std::size_t l = 0; l < in_rows_.size(); ++l) {
    const auto& link = in_rows_[l];
    for (const auto& equation : link.rows) {
      HeldRow row;
      row.is_turned = is_turned_[l] != 0;
      row.name = name_of(link, links_, particles_);
      add_entries(equation.first, row);
      add_entries(equation.second, row);
      row.image_rate = image_rate(equation, particles_.cell);
      row.stiffness = equation.stiffness;
      row.extension = equation.extension;
      if (!(row.stiffness > 0)) row.rate = -equation.value / times_.h;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

UnitMotion HeldMotion::motion_of_body(std::size_t body, std::span<const double> velocities) const {
  UnitMotion motion;
  const auto& of = particles_.bodies.bodies[body];
  for (std::size_t m = 0; m < of.members.size(); ++m) {
    const double weight = weights_[body][m];
    for (std::size_t d = 0; d < 2; ++d)
      motion.displacement[d] +=
          weight * (velocities[layout_.at(of.members[m], d)] + image_velocities_[body][m][d]);
    motion.turn[2] += weight * velocities[layout_.at(of.members[m], 2)];
  }
  return motion;
}

/// Displacement and turn in the step of the image of a unit that a part of a row means.
UnitMotion HeldMotion::motion_of(const RowPart& part, std::span<const double> velocities) const {
  UnitMotion motion;
  const auto particle = part.particle;
  if (particle < 0) return motion;
  const auto of_unit = periods_in_unit(particles_, particle);
  if (const auto body = particles_.bodies.body_of(particle); body >= 0) {
    motion = motion_of_body(index_of(body), velocities);
  } else {
    for (std::size_t d = 0; d < layout_.directions(); ++d)
      motion.displacement[d] = velocities[layout_.at(particle, d)];
    if (layout_.components == 3) motion.turn[2] = velocities[layout_.at(particle, 2)];
  }
  motion.displacement =
      motion.displacement + velocity_of_image(particles_.cell, Periods{part.image[0] - of_unit[0],
                                                                       part.image[1] - of_unit[1]});
  return {times_.h * motion.displacement, times_.h * motion.turn};
}

std::vector<double> HeldMotion::missing(std::span<const double> velocities,
                                        std::span<const double> row_forces,
                                        std::span<const double> thetas) const {
  std::vector<double> changes(body_rows_, 0.0);
  for (std::size_t l = 0; l < equations_.size(); ++l) {
    const auto& link = equations_[l];
    const auto& row = link.rows.front();
    const auto first = motion_of(row.first, velocities), second = motion_of(row.second, velocities);
    if (is_exact(link)) {
      for (const double off : values_after(link, links_, particles_, times_, first, second))
        changes.push_back(-off / times_.h);
    } else if (link.kind == LinkEquations::Kind::kSpring && is_turned_[l] != 0) {
      const auto r = changes.size();
      const double theta = thetas[r], h = times_.h;
      const double grown = extension_after(link, links_, particles_, first, second) - row.extension;
      changes.push_back(-(row.extension / theta + grown + row_forces[r] / (theta * row.stiffness)) /
                        h);
    } else {
      changes.resize(changes.size() + link.rows.size(), 0.0);
    }
  }
  return changes;
}

/// The sum of a row for these velocities, with that of the images.
double HeldMotion::sum_of(const LinkRow& row, std::span<const double> velocities) const {
  const auto part = [&](const RowPart& of) {
    const auto motion = motion_of(of, velocities);
    return of.is_turn ? motion.turn[2]
                      : dot(of.direction, motion.displacement + cross(motion.turn, of.arm));
  };
  return (part(row.first) + part(row.second)) / times_.h;
}

std::vector<double> HeldMotion::missing_at_end(std::span<const double> velocities,
                                               std::span<const double> at_end) const {
  // Rounding must not carry the time beyond a corner of the length.
  const double end = times_.end - 1e-9 * times_.h;
  std::vector<double> changes(body_rows_, 0.0);
  for (const auto& link : equations_) {
    const auto& row = link.rows.front();
    const auto first = motion_of(row.first, velocities), second = motion_of(row.second, velocities);
    const auto turned = turned_equations(link, links_, particles_, first, second);
    double rate = 0;
    if (link.kind == LinkEquations::Kind::kArm)
      rate = rate_at(links_.arms[link.number].length, end);
    else if (link.kind == LinkEquations::Kind::kSpring)
      rate = (extension_after(link, links_, particles_, first, second) - row.extension) / times_.h;
    else if (link.kind == LinkEquations::Kind::kTorsion)
      rate = second.turn[2] / times_.h;
    for (const auto& of : turned.rows) changes.push_back(rate - sum_of(of, at_end));
  }
  return changes;
}

std::vector<double> HeldMotion::with_finite_turns(std::span<const double> velocities) const {
  std::vector<double> result(velocities.begin(), velocities.end());
  const auto& bodies = particles_.bodies.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto motion = motion_of_body(b, velocities);
    for (std::size_t m = 0; m < bodies[b].members.size(); ++m) {
      const auto member = bodies[b].members[m];
      const Vector moved = displacement_at(times_.h * motion.displacement, times_.h * motion.turn,
                                           present_offset(bodies[b], m, 2), 2);
      for (std::size_t d = 0; d < 2; ++d)
        result[layout_.at(member, d)] = moved[d] / times_.h - image_velocities_[b][m][d];
      result[layout_.at(member, 2)] = motion.turn[2];
    }
  }
  return result;
}

void HeldMotion::make_rigid(std::span<double> velocities) const {
  const auto& bodies = particles_.bodies.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto motion = motion_of_body(b, velocities);
    for (std::size_t m = 0; m < bodies[b].members.size(); ++m) {
      const auto member = bodies[b].members[m];
      const Vector v = motion.displacement + cross(motion.turn, present_offset(bodies[b], m, 2));
      for (std::size_t d = 0; d < 2; ++d)
        velocities[layout_.at(member, d)] = v[d] - image_velocities_[b][m][d];
      velocities[layout_.at(member, 2)] = motion.turn[2];
    }
  }
}

double HeldMotion::rate_of_arm(std::size_t k, std::span<const double> velocities) const {
  const auto arm = std::ranges::find_if(in_rows_, [&](const LinkEquations& link) {
    return link.kind == LinkEquations::Kind::kArm && link.number == k;
  });
  return sum_of(arm->rows.front(), velocities);
}

std::vector<double> HeldMotion::link_forces(std::span<const double> row_forces) const {
  std::vector<double> forces(links_.force_count(particles_.dimension), 0.0);
  std::size_t r = body_rows_;
  for (const auto& link : equations_)
    for (std::size_t k = 0; k < link.rows.size(); ++k)
      forces[link.first_force + k] = row_forces[r++];
  return forces;
}

}  // namespace viscontact::particles
