// Rows of rigid bodies and links, docs/physics.md (6.7).
#include "viscontact/immersed/links/constrained_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

/// Such a link must hold exactly after a step.
bool is_exact(const LinkEquations& link) {
  return link.kind == LinkEquations::Kind::kHinge || link.kind == LinkEquations::Kind::kArm;
}

}  // namespace

ConstrainedMotion::ConstrainedMotion(const Links& links, const Particles& particles,
                                     const LinkTimes& times, std::span<const double> link_times)
    : links_(links),
      particles_(particles),
      times_(times),
      layout_{motion_components(particles.dimension)},
      equations_(link_equations(links, particles, times)),
      in_rows_(equations_),
      link_times_(link_times.begin(), link_times.end()) {
  assert(times.h > 0);
  assert(link_times.empty() || link_times.size() == particles.count());
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
  turn_rows();
}

double ConstrainedMotion::link_time(std::int32_t particle) const {
  return link_times_.empty() ? -1 : link_times_[index_of(particle)];
}

double ConstrainedMotion::link_time(const LinkEquations& link) const {
  double latest = -1;
  for (const auto& part : link.parts()) latest = std::max(latest, link_time(part.particle));
  return latest;
}

std::vector<double> ConstrainedMotion::velocities_before() const {
  std::vector<double> velocities(particles_.count() * layout_.components);
  const auto n = layout_.directions();
  for (std::size_t k = 0; k < particles_.count(); ++k) {
    for (std::size_t d = 0; d < n; ++d)
      velocities[k * layout_.components + d] = particles_.velocities[k * n + d];
    if (layout_.components == 3) velocities[k * 3 + 2] = particles_.angular_velocities[k];
  }
  return velocities;
}

void ConstrainedMotion::turn_rows() {
  if (link_times_.empty()) return;
  const auto velocities = velocities_before();
  for (std::size_t l = 0; l < equations_.size(); ++l) {
    const double share = link_time(equations_[l]) / times_.h;
    if (!(share > 0)) continue;
    auto motions = motions_of(equations_[l], velocities);
    for (auto& motion : motions) motion = {share * motion.displacement, share * motion.turn};
    in_rows_[l] = turned_equations(equations_[l], links_, particles_, motions);
  }
}

void ConstrainedMotion::add_body_rows(const RigidBody& body, std::size_t number,
                                      std::vector<VelocityConstraint>& rows) const {
  const auto first = body.members.front();
  const Vector start = present_offset(body, 0, particles_.dimension);
  const auto& of_images = image_velocities_[number];
  for (std::size_t m = 1; m < body.members.size(); ++m) {
    const auto member = body.members[m];
    const Vector apart = present_offset(body, m, particles_.dimension) - start;
    for (std::size_t d = 0; d < 3; ++d) {
      VelocityConstraint row;
      row.name = fmt::format("body {}", number);
      row.accelerates = link_time(first) >= 0;
      row.entries = {{layout_.at(member, d), 1}, {layout_.at(first, d), -1}};
      // The rotation adds the angular velocity times the vector `apart`, turned by 90 degrees, to
      // the velocity of the member.
      if (d < 2) {
        row.entries.emplace_back(layout_.at(first, 2), d == 0 ? apart[1] : -apart[0]);
        row.image_rate = of_images[m][d] - of_images[0][d];
      }
      rows.push_back(std::move(row));
    }
  }
}

void ConstrainedMotion::add_entries(const LinkPart& part, VelocityConstraint& row) const {
  if (part.is_turn) {
    row.entries.emplace_back(layout_.at(part.particle, 2), 1);
    return;
  }
  for (std::size_t d = 0; d < layout_.directions(); ++d)
    if (part.direction[d] != 0)
      row.entries.emplace_back(layout_.at(part.particle, d), part.direction[d]);
  if (layout_.components != 3) return;
  const Vector arm = part.arm - offset_in_body(particles_, part.particle);
  if (const double moment = cross(arm, part.direction)[2]; moment != 0)
    row.entries.emplace_back(layout_.at(part.particle, 2), moment);
}

std::vector<VelocityConstraint> ConstrainedMotion::rows() const { return rows_of(in_rows_); }

double ConstrainedMotion::rate_of(const LinkEquations& link, const LinkRow& row) const {
  // Without inertia of the fluid the velocities are those of the whole step, and the rate also
  // removes the error that the place or length has at its beginning. In a fluid with inertia
  // (rate_to > rate_from) they are those at the beginning of the step, and a correction of places
  // must not change the momentum of the fluid.
  if (!(times_.rate_to > times_.rate_from)) return -row.value / times_.h;
  if (link.kind != LinkEquations::Kind::kArm) return 0;
  const auto& length = links_.arms[link.number].length;
  return (length_at(length, times_.rate_to) - length_at(length, times_.rate_from)) /
         (times_.rate_to - times_.rate_from);
}

std::vector<VelocityConstraint> ConstrainedMotion::rows_of(
    const std::vector<LinkEquations>& equations) const {
  std::vector<VelocityConstraint> rows;
  const auto& bodies = particles_.bodies.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) add_body_rows(bodies[b], b, rows);
  for (const auto& link : equations) {
    for (const auto& equation : link.rows) {
      VelocityConstraint row;
      row.accelerates = link_time(link) >= 0;
      row.name = name_of(link, links_, particles_);
      for (const auto& part : equation.parts) add_entries(part, row);
      row.image_rate = image_rate(equation, particles_.cell);
      row.stiffness = equation.stiffness;
      row.extension = equation.extension;
      if (!(row.stiffness > 0)) row.rate = rate_of(link, equation);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

UnitMotion ConstrainedMotion::motion_of_body(std::size_t body,
                                             std::span<const double> velocities) const {
  assert(body < weights_.size());
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

UnitMotion ConstrainedMotion::motion_of(const LinkPart& part,
                                        std::span<const double> velocities) const {
  UnitMotion motion;
  const auto particle = part.particle;
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

std::vector<UnitMotion> ConstrainedMotion::motions_of(const LinkEquations& link,
                                                      std::span<const double> velocities) const {
  std::vector<UnitMotion> motions;
  for (const auto& part : link.parts()) motions.push_back(motion_of(part, velocities));
  return motions;
}

std::vector<double> ConstrainedMotion::missing(std::span<const double> velocities,
                                               std::span<const double> row_forces,
                                               std::span<const double> thetas,
                                               std::span<const double> stiffnesses) const {
  assert(thetas.size() == stiffnesses.size() && row_forces.size() >= thetas.size());
  std::vector<double> changes(body_rows_, 0.0);
  for (std::size_t l = 0; l < equations_.size(); ++l) {
    const auto& link = equations_[l];
    const auto& row = link.rows.front();
    const auto motions = motions_of(link, velocities);
    if (is_exact(link)) {
      for (const double off : values_after(link, links_, particles_, times_, motions))
        changes.push_back(-off / times_.h);
    } else if (link.kind == LinkEquations::Kind::kSpring && link_time(link) >= 0) {
      const auto r = changes.size();
      const double theta = thetas[r], h = times_.h;
      const double grown = extension_after(link, links_, particles_, motions) - row.extension;
      changes.push_back(-(row.extension / theta + grown + row_forces[r] / (theta * row.stiffness)) /
                        h);
    } else {
      changes.resize(changes.size() + link.rows.size(), 0.0);
    }
  }
  for (const auto& turn : turns_) {
    const auto r = changes.size();
    changes.push_back(0);
    if (!turn.row.accelerates || !(stiffnesses[r] > 0)) continue;
    changes.back() =
        -(turn.row.extension / thetas[r] + row_forces[r] / (thetas[r] * stiffnesses[r])) /
            times_.h -
        sum_of(turn.row, velocities);
  }
  return changes;
}

double ConstrainedMotion::sum_of(const LinkRow& row, std::span<const double> velocities) const {
  double sum = 0;
  for (const auto& part : row.parts) sum += value_of(part, motion_of(part, velocities));
  return sum / times_.h;
}

std::vector<double> ConstrainedMotion::hold_at_end(std::span<const double> velocities,
                                                   std::span<const double> mobility,
                                                   const std::vector<char>& is_stiff,
                                                   std::span<double> at_end) const {
  assert(mobility.size() == at_end.size() && velocities.size() == at_end.size());
  // The rate of an arm's length may jump at the end of the step. It is therefore taken slightly
  // earlier, by 1e-9 of the step, more than the rounding error of the time.
  const double end = times_.end - 1e-9 * times_.h;
  std::vector<LinkEquations> turned;
  std::vector<double> rates(body_rows_, 0.0);
  for (const auto& link : equations_) {
    const auto& row = link.rows.front();
    const auto motions = motions_of(link, velocities);
    turned.push_back(turned_equations(link, links_, particles_, motions));
    double rate = 0;
    if (link.kind == LinkEquations::Kind::kArm)
      rate = rate_at(links_.arms[link.number].length, end);
    else if (link.kind == LinkEquations::Kind::kSpring)
      rate = (extension_after(link, links_, particles_, motions) - row.extension) / times_.h;
    else if (link.kind == LinkEquations::Kind::kTorsion)
      rate = motions.front().turn[2] / times_.h;
    rates.resize(rates.size() + link.rows.size(), rate);
  }
  auto rows = rows_of(turned);
  turn_to_end(turned, velocities, rows, rates);
  assert(is_stiff.size() >= rows.size());
  std::vector<std::size_t> chosen;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (!rows[r].is_spring() || is_stiff[r] != 0) chosen.push_back(r);
  std::vector<double> forces(rows.size());
  if (chosen.empty()) return forces;
  const auto n = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(mobility.size()));  // A W^(1/2)
  Eigen::VectorXd right(n);
  for (Eigen::Index c = 0; c < n; ++c) {
    const auto& row = rows[chosen[static_cast<std::size_t>(c)]];
    right[c] = rates[chosen[static_cast<std::size_t>(c)]] - row.image_rate;
    for (const auto& [component, coefficient] : row.entries) {
      matrix(c, static_cast<Eigen::Index>(component)) +=
          coefficient * std::sqrt(mobility[component]);
      right[c] -= coefficient * at_end[component];
    }
    // Rows are scaled to the norm 1, so that those of lengths and of angles have the same size.
    if (const double norm = matrix.row(c).norm(); norm > 0) {
      matrix.row(c) /= norm;
      right[c] /= norm;
    }
  }
  // W is the diagonal matrix of `mobility`, and x is W^(-1/2) times the change of the velocities.
  // The rows require matrix x = right, and x is the shortest solution. The forces f obey matrix^T f
  // = x; those of redundant rows are the smallest ones. A row counts as redundant if it follows
  // from the others up to kRank, which is far above rounding errors.
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factor;
  constexpr double kRank = 1e-10;
  factor.setThreshold(kRank);
  factor.compute(matrix);
  const Eigen::VectorXd change = factor.solve(right);
  for (std::size_t i = 0; i < mobility.size(); ++i)
    at_end[i] += std::sqrt(mobility[i]) * change[static_cast<Eigen::Index>(i)];
  factor.compute(matrix.transpose());
  const Eigen::VectorXd of_chosen = factor.solve(change);
  for (Eigen::Index c = 0; c < n; ++c) {
    const auto& row = rows[chosen[static_cast<std::size_t>(c)]];
    // Without a mass that accelerates, the change of velocities at the end of the step takes no
    // impulse, so that the force that makes this change is no part of the mean force of the step.
    if (!row.accelerates) continue;
    double square = 0;
    for (const auto& [component, coefficient] : row.entries)
      square += coefficient * coefficient * mobility[component];
    if (square > 0) forces[chosen[static_cast<std::size_t>(c)]] = of_chosen[c] / std::sqrt(square);
  }
  return forces;
}

std::vector<double> ConstrainedMotion::with_finite_turns(std::span<const double> velocities) const {
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

void ConstrainedMotion::make_rigid(std::span<double> velocities) const {
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

void ConstrainedMotion::keep_torques(std::span<const double> velocities,
                                     std::span<const double> of_fluid,
                                     std::span<const double> stiffnesses,
                                     std::span<double> forces) const {
  assert(stiffnesses.size() >= turns_.size() && of_fluid.size() == forces.size());
  const auto& bodies = particles_.bodies.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto first = bodies[b].members.front();
    const bool accelerates = link_time(first) >= 0;
    const auto turn_of = turn_of_unit(first);
    const auto base = stiffnesses.size() - turns_.size();
    const bool is_turned = turn_of < turns_.size() && stiffnesses[base + turn_of] > 0;
    if (!accelerates && !is_turned) continue;
    const auto& turning = accelerates ? of_fluid : std::span<const double>(forces);
    double change = 0;
    const Vector turn = times_.h * motion_of_body(b, velocities).turn;
    for (std::size_t m = 0; m < bodies[b].members.size(); ++m) {
      const Vector further = displacement_at({}, turn, present_offset(bodies[b], m, 2), 2);
      const auto i = layout_.at(bodies[b].members[m], 0);
      change += cross(further, {turning[i], turning[i + 1], 0})[2];
    }
    forces[layout_.at(first, 2)] -= change;
  }
}

std::size_t ConstrainedMotion::arm(std::size_t k) const {
  const auto found = std::ranges::find_if(equations_, [&](const LinkEquations& link) {
    return link.kind == LinkEquations::Kind::kArm && link.number == k;
  });
  assert(found != equations_.end());
  return static_cast<std::size_t>(found - equations_.begin());
}

double ConstrainedMotion::rate_of_arm(std::size_t k, std::span<const double> velocities) const {
  return sum_of(in_rows_[arm(k)].rows.front(), velocities);
}

double ConstrainedMotion::rate_of_arm_at_end(std::size_t k, std::span<const double> moved,
                                             std::span<const double> velocities) const {
  const auto& link = equations_[arm(k)];
  const auto turned = turned_equations(link, links_, particles_, motions_of(link, moved));
  return sum_of(turned.rows.front(), velocities);
}

std::vector<double> ConstrainedMotion::row_forces(std::span<const double> link_forces) const {
  if (link_forces.empty()) return {};
  assert(link_forces.size() == links_.force_count(particles_.dimension));
  std::vector<double> forces(body_rows_, 0.0);
  for (const auto& link : equations_)
    for (std::size_t k = 0; k < link.rows.size(); ++k)
      forces.push_back(link_forces[link.first_force + k]);
  return forces;
}

std::vector<double> ConstrainedMotion::link_forces(std::span<const double> row_forces) const {
  std::vector<double> forces(links_.force_count(particles_.dimension), 0.0);
  std::size_t r = body_rows_;
  for (const auto& link : equations_)
    for (std::size_t k = 0; k < link.rows.size(); ++k)
      forces[link.first_force + k] = row_forces[r++];
  return forces;
}

}  // namespace viscontact::particles
