// Computes the rows, linear conditions on the velocities of particles in a fluid, that make bodies
// rigid and hold links: hinges, arms, springs and torsion springs. A unit is a rigid body, or a
// particle without a body. Velocities are in [L/T, 1/T], 3 numbers for each particle, or 1 on an
// axis; forces of rows, one for each row, are in [M L/T^2, M L^2/T^2]; the length of the step
// is > 0 [T]. Nothing is checked or thrown. fluid_simulation.cpp, fluid_links.cpp and
// fluid_acceptance.cpp use it. A change must keep bodies exactly rigid, and the order of the rows:
// bodies first, then links.
#include "viscontact/particles/fluid/held_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viscontact/common/matrices/decompositions.hpp"
#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::particles {
namespace {

/// True for a hinge or an arm, which must hold exactly after a step.
bool is_exact(const LinkEquations& link) {
  return link.kind == LinkEquations::Kind::kHinge || link.kind == LinkEquations::Kind::kArm;
}

}  // namespace

/// Makes the equations of the links at the present places. The weights of the members of a body are
/// their shares of its mass, or equal shares if the body has no mass. `link_times` is empty, or has
/// one time [T] for each particle, which link_time() explains.
HeldMotion::HeldMotion(const Links& links, const Particles& particles, const LinkTimes& times,
                       std::span<const double> link_times)
    : links_(links),
      particles_(particles),
      times_(times),
      layout_{motion_components(particles.dimension)},
      equations_(link_equations(links, particles, times)),
      in_rows_(equations_),
      link_times_(link_times.begin(), link_times.end()) {
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

/// The time [T] in the step at which links act on a particle. A number < 0 means that the particle
/// does not accelerate: it has no mass, or its motion is given.
double HeldMotion::link_time(std::int32_t particle) const {
  return link_times_.empty() ? -1 : link_times_[index_of(particle)];
}

/// The time in the step at which a link acts [T], the latest of those of its particles; -1 if none
/// of them accelerates.
double HeldMotion::link_time(const LinkEquations& link) const {
  double latest = -1;
  for (const auto& part : link.parts()) latest = std::max(latest, link_time(part.particle));
  return latest;
}

std::vector<double> HeldMotion::velocities_before() const {
  std::vector<double> velocities(particles_.count() * layout_.components);
  const auto n = layout_.directions();
  for (std::size_t k = 0; k < particles_.count(); ++k) {
    for (std::size_t d = 0; d < n; ++d)
      velocities[k * layout_.components + d] = particles_.velocities[k * n + d];
    if (layout_.components == 3) velocities[k * 3 + 2] = particles_.angular_velocities[k];
  }
  return velocities;
}

/// Sets in_rows_: the equations of each link with the directions that they have when its units have
/// moved with the velocities at the beginning of the step for the time link_time().
void HeldMotion::turn_rows() {
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

/// Adds the rows of the rigid body with this number, three for each member but the first. The rows
/// demand that the member has the velocities [L/T, 1/T] of the rigid motion of the first member.
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
      row.accelerates = link_time(first) >= 0;
      row.entries = {{layout_.at(member, d), 1}, {layout_.at(first, d), -1}};
      // The rotation of the body adds the angular velocity times the vector `apart`, turned by 90
      // degrees, to the velocity of the member.
      if (d < 2) {
        row.entries.emplace_back(layout_.at(first, 2), d == 0 ? apart[1] : -apart[0]);
        row.image_rate = of_images[m][d] - of_images[0][d];
      }
      rows.push_back(std::move(row));
    }
  }
}

/// Adds what one unit contributes to the entries of a row: the coefficient 1 for a turn; otherwise
/// the direction [1] for the velocity of the particle, and the moment of the direction about the
/// centre of the particle [L] for its angular velocity.
void HeldMotion::add_entries(const LinkPart& part, HeldRow& row) const {
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

/// The rows of the step: bodies first, then links at the places of in_rows_.
std::vector<HeldRow> HeldMotion::rows() const { return rows_of(in_rows_); }

/// The rate that the row of a hinge or an arm prescribes [L/T]. Without inertia of the fluid the
/// velocities are those of the whole step, and the rate also removes the error that the place or
/// length has at its beginning. In a fluid with inertia (rate_to > rate_from) the velocities are
/// those at the beginning of the step. The rate is then 0, or, for an arm, the mean rate of its
/// length, because a correction of places must not change the momentum of the fluid.
double HeldMotion::rate_of(const LinkEquations& link, const LinkRow& row) const {
  if (!(times_.rate_to > times_.rate_from)) return -row.value / times_.h;
  if (link.kind != LinkEquations::Kind::kArm) return 0;
  const auto& length = links_.arms[link.number].length;
  return (length_at(length, times_.rate_to) - length_at(length, times_.rate_from)) /
         (times_.rate_to - times_.rate_from);
}

/// The rows of the bodies at their present places, and of the links in these equations.
std::vector<HeldRow> HeldMotion::rows_of(const std::vector<LinkEquations>& equations) const {
  std::vector<HeldRow> rows;
  const auto& bodies = particles_.bodies.bodies;
  for (std::size_t b = 0; b < bodies.size(); ++b) add_body_rows(bodies[b], b, rows);
  for (const auto& link : equations) {
    for (const auto& equation : link.rows) {
      HeldRow row;
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

/// Returns the mean velocity of the members of a body [L/T], as `displacement`, and their mean
/// angular velocity [1/T], as `turn`. The means have the weights of the constructor.
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

/// Displacement [L] and turn [rad] in the step of the unit of a part. In a sheared cell they
/// contain the motion of the periodic image that the part names.
UnitMotion HeldMotion::motion_of(const LinkPart& part, std::span<const double> velocities) const {
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

/// The motions of all units of a link in the step, in the order of the parts of its first row.
std::vector<UnitMotion> HeldMotion::motions_of(const LinkEquations& link,
                                               std::span<const double> velocities) const {
  std::vector<UnitMotion> motions;
  for (const auto& part : link.parts()) motions.push_back(motion_of(part, velocities));
  return motions;
}

/// Returns for each row the number [L/T, 1/T] by which its sum must change so that hinges and arms
/// hold after a step with `velocities`. For a spring with an end that accelerates, it is the error
/// of the law force = -stiffness (extension + theta growth), divided by -(theta h stiffness); the
/// force is that in `row_forces`, theta [1] that in `thetas`, and growth is the exact change of the
/// extension in the step. The number is 0 for rows of bodies and of all other springs.
std::vector<double> HeldMotion::missing(std::span<const double> velocities,
                                        std::span<const double> row_forces,
                                        std::span<const double> thetas,
                                        std::span<const double> stiffnesses) const {
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

/// The sum of the parts of a row for these velocities, with the motions of images [L/T, 1/T].
double HeldMotion::sum_of(const LinkRow& row, std::span<const double> velocities) const {
  double sum = 0;
  for (const auto& part : row.parts) sum += value_of(part, motion_of(part, velocities));
  return sum / times_.h;
}

/// Changes `at_end`, the velocities at the end of a step in which the particles moved with
/// `velocities`, until bodies are rigid and hinges and arms hold. The extension of a spring whose
/// entry of `is_stiff` is not 0 then grows with its mean rate in the step. `mobility` has for each
/// component of a particle the change of its velocity per force, >= 0 [T/M, T/(M L^2)]. Returns the
/// forces of the rows that make the change, but 0 for rows without a unit that accelerates and for
/// springs that are not stiff.
std::vector<double> HeldMotion::hold_at_end(std::span<const double> velocities,
                                            std::span<const double> mobility,
                                            const std::vector<char>& is_stiff,
                                            std::span<double> at_end) const {
  // The rate of an arm's length may jump at the end of the step. The rate is therefore taken
  // slightly earlier, by 1e-9 of the step, a free choice above the rounding error of the time.
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
  // from the others up to kRank, a free choice far above rounding errors.
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

/// Returns `velocities`, but for members of bodies their displacements in the step, in which the
/// body turns by a finite angle, divided by the length of the step [L/T, 1/T].
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

/// Replaces the velocities of the members of each body by those that the motion of motion_of_body()
/// has at the places of the members.
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

/// For each body that accelerates, subtracts from the torque on its first member in `forces` by how
/// much the torque of the forces `of_fluid` changes because the body turns in a step with
/// `velocities`. Both arrays have forces and torques of the particles on the fluid [M L/T^2, M
/// L^2/T^2], as many numbers as `velocities`.
void HeldMotion::keep_torques(std::span<const double> velocities, std::span<const double> of_fluid,
                              std::span<const double> stiffnesses, std::span<double> forces) const {
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

/// The place of arm number `k`, which must exist, in equations_.
std::size_t HeldMotion::arm(std::size_t k) const {
  const auto found = std::ranges::find_if(equations_, [&](const LinkEquations& link) {
    return link.kind == LinkEquations::Kind::kArm && link.number == k;
  });
  return static_cast<std::size_t>(found - equations_.begin());
}

/// Rate [L/T] at which arm `k` grows with `velocities`, in the direction that it has in its row.
double HeldMotion::rate_of_arm(std::size_t k, std::span<const double> velocities) const {
  return sum_of(in_rows_[arm(k)].rows.front(), velocities);
}

/// Rate [L/T] at which arm `k` grows with `velocities`, in the direction that it has after a step
/// in which the particles moved with `moved`.
double HeldMotion::rate_of_arm_at_end(std::size_t k, std::span<const double> moved,
                                      std::span<const double> velocities) const {
  const auto& link = equations_[arm(k)];
  const auto turned = turned_equations(link, links_, particles_, motions_of(link, moved));
  return sum_of(turned.rows.front(), velocities);
}

std::vector<double> HeldMotion::row_forces(std::span<const double> link_forces) const {
  if (link_forces.empty()) return {};
  std::vector<double> forces(body_rows_, 0.0);
  for (const auto& link : equations_)
    for (std::size_t k = 0; k < link.rows.size(); ++k)
      forces.push_back(link_forces[link.first_force + k]);
  return forces;
}

/// The entries of `row_forces` that belong to links, in the order of State::link_forces.
std::vector<double> HeldMotion::link_forces(std::span<const double> row_forces) const {
  std::vector<double> forces(links_.force_count(particles_.dimension), 0.0);
  std::size_t r = body_rows_;
  for (const auto& link : equations_)
    for (std::size_t k = 0; k < link.rows.size(); ++k)
      forces[link.first_force + k] = row_forces[r++];
  return forces;
}

}  // namespace viscontact::particles
