// Geometric stiffness, docs/physics.md (5.21).
#include "viscontact/constraint_rows/tension.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "viscontact/particles/domain/periods.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

/// Unit vectors at right angles to `along` and to each other.
std::vector<Vector> directions_across(const Vector& along, int dimension) {
  if (dimension == 2) {
    const double length = norm(along);
    return {{-along[1] / length, along[0] / length, 0}};
  }
  std::size_t least = 0;
  for (std::size_t d = 1; d < 3; ++d)
    if (std::abs(along[d]) < std::abs(along[least])) least = d;
  Vector axis{};
  axis[least] = 1;
  const Vector across = cross(along, axis);
  const Vector first = (1 / norm(across)) * across, second = cross(along, first);
  return {first, (1 / norm(second)) * second};
}

}  // namespace

std::vector<AxisStiffness> stiffness_of_turns(std::span<const ForceAtArm> forces, int dimension) {
  assert(dimension == 2 || dimension == 3);
  double along = 0, largest = 0;
  for (const auto& [force, arm] : forces) {
    along += dot(force, arm);
    largest = std::max(largest, norm(force) * norm(arm));
  }
  if (!(largest > 0)) return {};
  std::vector<AxisStiffness> result;
  if (dimension == 2) {
    if (along > 0) result.push_back({{0, 0, 1}, along});
    return result;
  }
  Eigen::Matrix3d stiffness = along / largest * Eigen::Matrix3d::Identity();
  for (const auto& [force, arm] : forces) {
    const Eigen::Vector3d f(force.data()), a(arm.data());
    stiffness -= (f * a.transpose() + a * f.transpose()) / (2 * largest);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(stiffness);
  // An eigenvalue that is 0, as that of the line along the force, has rounding errors.
  constexpr double kRounding = 1e-12;
  for (int i = 2; i >= 0 && solver.eigenvalues()[i] > kRounding; --i) {
    const Eigen::Vector3d axis = solver.eigenvectors().col(i);
    result.push_back({{axis[0], axis[1], axis[2]}, largest * solver.eigenvalues()[i]});
  }
  return result;
}

std::vector<LinkRow> rows_of_turn(const LinkPart& part, const Vector& force, int dimension) {
  const std::array<ForceAtArm, 1> own = {{{force, part.arm}}};
  std::vector<LinkRow> rows;
  for (const auto& [axis, stiffness] : stiffness_of_turns(own, dimension)) {
    LinkRow row;
    row.parts = {{part.particle, axis, part.arm, true, part.image}};
    row.stiffness = stiffness;
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<LinkRow> rows_across(const LinkPart& first, const LinkPart& second, const Vector& apart,
                                 double tension, int dimension) {
  const double length = norm(apart);
  assert(length > 0);
  std::vector<LinkRow> rows;
  if (tension > 0)
    for (const auto& direction : directions_across((1 / length) * apart, dimension)) {
      LinkRow row;
      row.parts = {first, second};
      for (auto& part : row.parts) part.is_turn = false;
      row.parts[0].direction = -1 * direction;
      row.parts[1].direction = direction;
      row.stiffness = tension / length;
      row.length = length;
      rows.push_back(std::move(row));
    }
  const Vector pull = (tension / length) * apart;
  for (auto& row : rows_of_turn(first, pull, dimension)) rows.push_back(std::move(row));
  for (auto& row : rows_of_turn(second, -1 * pull, dimension)) rows.push_back(std::move(row));
  return rows;
}

std::vector<LinkRow> rows_of_tension(const LinkEquations& link, std::span<const double> forces,
                                     const Particles& particles) {
  using Kind = LinkEquations::Kind;
  const auto& parts = link.parts();
  assert(forces.size() == link.rows.size());
  if (link.kind == Kind::kHinge) {
    Vector force{};
    for (std::size_t d = 0; d < link.rows.size(); ++d)
      force = force + forces[d] * link.rows[d].parts.front().direction;
    return rows_of_turn(parts.front(), force, particles.dimension);
  }
  if (link.kind != Kind::kArm && link.kind != Kind::kSpring && link.kind != Kind::kDistance)
    return {};
  const Vector apart =
      nearest_image(particles.cell, particles.position(index_of(parts[1].particle)) -
                                        particles.position(index_of(parts[0].particle)));
  if (!(norm(apart) > 0)) return {};
  return rows_across(parts[0], parts[1], apart, -forces.front(), particles.dimension);
}

Matrix3 stiffness_in_step(const RigidBody& body, std::span<const ForceAtArm> forces,
                          const LinkTimes& times, int dimension) {
  Matrix3 sum{};
  const auto stiffnesses = stiffness_of_turns(forces, dimension);
  if (stiffnesses.empty()) return sum;
  const auto inertia = present_inertia(body, dimension);
  const auto inverse = dimension == 3 ? inverse_of(inertia) : Matrix3{};
  for (const auto& [axis, stiffness] : stiffnesses) {
    const double w = times.h * (dimension == 3 ? dot(axis, inverse * axis) : 1 / inertia[8]);
    const double acting =
        times.beta_across() * share_of_tension(times.impulse_time * stiffness * w) * stiffness;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) sum[3 * i + k] += acting * axis[i] * axis[k];
  }
  return sum;
}

double rate_of(const LinkRow& row, const Particles& particles) {
  double rate = image_rate(row, particles.cell);
  for (const auto& part : row.parts) {
    const auto k = index_of(part.particle);
    if (!part.is_turn) {
      rate += dot(part.direction, particles.velocity(k));
      continue;
    }
    const auto* spin = particles.angular_velocities.data();
    rate += particles.dimension == 3 ? dot(part.direction, point_of(spin, k, 3))
                                     : part.direction[2] * spin[k];
  }
  return rate;
}

}  // namespace viscontact::particles
