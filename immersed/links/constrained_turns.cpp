// Geometric rows: how forces of links, bodies and films turn with the motion, docs/physics.md
// (6.15).
#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/constraint_rows/tension.hpp"
#include "viscontact/immersed/links/constrained_motion.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

/// Vector from the first to the second particle of an arm or spring [L].
Vector apart_of(const Particles& p, const std::vector<LinkPart>& ends) {
  return nearest_image(
      p.cell, p.position(index_of(ends[1].particle)) - p.position(index_of(ends[0].particle)));
}

bool has_ends(const LinkEquations& link) {
  return link.kind == LinkEquations::Kind::kArm || link.kind == LinkEquations::Kind::kSpring;
}

}  // namespace

VelocityConstraint ConstrainedMotion::row_across(const LinkEquations& link, double length) const {
  const auto& ends = link.parts();
  const auto across = rows_across(ends[0], ends[1], length * ends[1].direction, 1, 2).front();
  VelocityConstraint row;
  row.is_geometric = true;
  row.accelerates = link_time(link) >= 0;
  for (const auto& part : across.parts) add_entries(part, row);
  row.image_rate = image_rate(across, particles_.cell);
  return row;
}

std::vector<ConstrainedMotion::Turn> ConstrainedMotion::turns_of_links(
    std::span<const double> before) const {
  std::vector<Turn> turns;
  std::size_t r = body_rows_;
  for (std::size_t l = 0; l < in_rows_.size(); ++l) {
    const auto& link = in_rows_[l];
    const double length = has_ends(link) ? norm(apart_of(particles_, link.parts())) : 0;
    if (length > 0) {
      auto row = row_across(link, length);
      row.of_forces = {{r, -1 / length}};
      row.extension = -std::max(0.0, link_time(link)) * sum_of(row, before);
      turns.push_back({{Turn::kLink, static_cast<std::int32_t>(l), 0, 0}, std::move(row)});
    }
    r += link.rows.size();
  }
  return turns;
}

std::vector<ConstrainedMotion::Turn> ConstrainedMotion::turns_of_units(
    const ForcesOfStep& step, std::span<const double> before) const {
  const auto& bodies = particles_.bodies;
  std::vector<Turn> turns;
  const auto turn_of = [&](std::int32_t particle) -> VelocityConstraint& {
    const auto body = bodies.body_of(particle);
    const auto first = body < 0 ? particle : bodies.bodies[index_of(body)].members.front();
    const Turn::Key key{Turn::kUnit, first, 0, 0};
    const auto found = std::ranges::find(turns, key, &Turn::key);
    if (found != turns.end()) return found->row;
    VelocityConstraint row;
    row.is_geometric = true;
    row.accelerates = link_time(first) >= 0;
    row.entries = {{layout_.at(first, 2), 1}};
    row.extension = -std::max(0.0, link_time(first)) * before[layout_.at(first, 2)];
    turns.push_back({key, std::move(row)});
    return turns.back().row;
  };
  std::size_t r = body_rows_;
  for (const auto& link : in_rows_)
    for (const auto& row : link.rows) {
      for (const auto& part : row.parts)
        if (!part.is_turn && norm(part.arm) > 0)
          turn_of(part.particle).of_forces.emplace_back(r, dot(part.direction, part.arm));
      ++r;
    }
  const auto add = [&](std::int32_t particle, const Vector& force) {
    if (particle < 0 || bodies.body_of(particle) < 0) return;
    turn_of(particle).stiffness += dot(force, offset_in_body(particles_, particle));
  };
  for (const auto& body : bodies.bodies)
    for (const auto member : body.members) {
      const auto i = layout_.at(member, 0);
      add(member, {step.on_particles[i], step.on_particles[i + 1], 0});
    }
  for (const auto& contact : step.contacts) {
    const double force = contact.impulse / times_.h;
    if (contact.is_stop() || force == 0) continue;
    const Vector push{force * contact.normal[0], force * contact.normal[1], 0};
    add(contact.second, push);
    add(contact.first, -1 * push);
  }
  return turns;
}

std::vector<ConstrainedMotion::Turn> ConstrainedMotion::turns_of_films(
    const ForcesOfStep& step) const {
  std::vector<Turn> turns;
  for (const auto& contact : step.contacts) {
    const bool is_of_discs = contact.first >= 0 && contact.levers[0] == 0 && contact.levers[1] == 0;
    if (!is_of_discs || !(contact.impulse < 0)) continue;
    const auto apart = separation<2>(particles_, contact.first, contact.second, contact.image);
    const double length = std::hypot(apart[0], apart[1]);
    if (!(length > 0)) continue;
    const auto part_of = [&](std::int32_t particle) {
      return LinkPart{particle, {}, offset_in_body(particles_, particle)};
    };
    const auto across =
        rows_across(part_of(contact.first), part_of(contact.second), {apart[0], apart[1], 0}, 1, 2)
            .front();
    VelocityConstraint row;
    row.is_geometric = true;
    row.accelerates = link_time(contact.first) >= 0 || link_time(contact.second) >= 0;
    row.stiffness = -contact.impulse / times_.h / length;
    for (const auto& part : across.parts) add_entries(part, row);
    if (contact.image != 0)
      row.image_rate =
          dot(across.parts[1].direction, velocity_of_image(particles_.cell, contact.image));
    turns.push_back({{Turn::kFilm, contact.first, contact.second, contact.image}, std::move(row)});
  }
  return turns;
}

void ConstrainedMotion::add_turns(const ForcesOfStep& step) {
  if (layout_.components != 3) return;
  assert(step.on_particles.size() == step.mobility.size());
  const auto before = velocities_before();
  auto candidates = turns_of_links(before);
  for (auto& turns : {turns_of_units(step, before), turns_of_films(step)})
    candidates.insert(candidates.end(), turns.begin(), turns.end());
  for (auto& turn : turns_)
    if (turn.key[0] != Turn::kLink) turn.row.stiffness = 0;
  const auto find = [&](const Turn::Key& key) {
    return std::ranges::find(turns_, key, &Turn::key);
  };
  pushing_ = 0;
  for (auto& candidate : candidates) {
    double stiffness = candidate.row.stiffness, mobility = 0;
    for (const auto& [row, coefficient] : candidate.row.of_forces)
      if (row < step.of_rows.size()) stiffness += coefficient * step.of_rows[row];
    for (const auto& [component, coefficient] : candidate.row.entries)
      mobility += coefficient * coefficient * step.mobility[component];
    if (candidate.key[0] == Turn::kLink)
      pushing_ = std::max(pushing_, -times_.h * stiffness * mobility);
    if (const auto found = find(candidate.key); found != turns_.end()) {
      found->row.stiffness = candidate.row.stiffness;
      continue;
    }
    // The solver lets a row act where its z is large enough. The mobilities of discs in the widest
    // containers are some 10 times those of `step`, and neighbouring links double them, but the
    // motion is stable up to z = 1.
    constexpr double kLeast = 0.05;
    if (times_.h * stiffness * mobility > kLeast) turns_.push_back(std::move(candidate));
  }
  // The forces of links count as forces of the step where their turning is a row. Both ways of
  // turning a link must then be rows.
  for (auto& candidate : candidates) {
    if (candidate.key[0] != Turn::kLink || find(candidate.key) != turns_.end()) continue;
    const auto& parts = in_rows_[index_of(candidate.key[1])].parts();
    if (std::ranges::any_of(parts, [&](const LinkPart& part) {
          return turn_of_unit(part.particle) < turns_.size();
        }))
      turns_.push_back(std::move(candidate));
  }
}

std::size_t ConstrainedMotion::turn_of_unit(std::int32_t particle) const {
  const auto body = particles_.bodies.body_of(particle);
  const auto first = body < 0 ? particle : particles_.bodies.bodies[index_of(body)].members.front();
  return static_cast<std::size_t>(
      std::ranges::find(turns_, Turn::Key{Turn::kUnit, first, 0, 0}, &Turn::key) - turns_.begin());
}

std::vector<VelocityConstraint> ConstrainedMotion::geometric_rows() const {
  std::vector<VelocityConstraint> rows;
  for (const auto& turn : turns_) rows.push_back(turn.row);
  return rows;
}

void ConstrainedMotion::turn_to_end(std::span<const LinkEquations> turned,
                                    std::span<const double> velocities,
                                    std::vector<VelocityConstraint>& rows,
                                    std::vector<double>& rates) const {
  for (const auto& turn : turns_) {
    if (turn.key[0] != Turn::kLink) {
      rows.push_back(turn.row);
      rates.push_back(sum_of(turn.row, velocities));
      continue;
    }
    const auto l = index_of(turn.key[1]);
    const Vector from = equations_[l].parts()[1].direction, to = turned[l].parts()[1].direction;
    const double length = norm(apart_of(particles_, equations_[l].parts()));
    rows.push_back(row_across(turned[l], length));
    rates.push_back(length * std::atan2(cross(from, to)[2], dot(from, to)) / times_.h);
  }
}

double ConstrainedMotion::sum_of(const VelocityConstraint& row,
                                 std::span<const double> velocities) {
  double sum = row.image_rate;
  for (const auto& [component, coefficient] : row.entries)
    sum += coefficient * velocities[component];
  return sum;
}

double ConstrainedMotion::power_of_turning(std::size_t k, std::span<const double> row_forces,
                                           std::span<const double> velocities) const {
  assert(row_forces.size() >= turns_.size());
  const auto base = row_forces.size() - turns_.size();
  const Turn::Key key{Turn::kLink, static_cast<std::int32_t>(arm(k)), 0, 0};
  for (std::size_t t = 0; t < turns_.size(); ++t)
    if (turns_[t].key == key) return row_forces[base + t] * sum_of(turns_[t].row, velocities);
  return 0;
}

}  // namespace viscontact::particles
