// Geometric stiffness, docs/physics.md (5.21).
#include "viscontact/particles/links/tension.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {
namespace {

/// Unit vectors at right angles to `along` and to each other: one in the plane, two in space.
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

LinkRow row_of_turn(const LinkPart& part, const Vector& axis, double stiffness) {
  LinkRow row;
  row.parts = {{part.particle, axis, part.arm, true, part.image}};
  row.stiffness = stiffness;
  return row;
}

}  // namespace

std::vector<LinkRow> rows_of_turn(const LinkPart& part, const Vector& force, int dimension) {
  const auto& arm = part.arm;
  const double along = dot(force, arm);
  const double largest = norm(force) * norm(arm);
  if (!(largest > 0)) return {};
  std::vector<LinkRow> rows;
  if (dimension == 2) {
    if (along > 0) rows.push_back(row_of_turn(part, {0, 0, 1}, along));
    return rows;
  }
  Eigen::Matrix3d stiffness;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(k);
      stiffness(i, k) =
          ((i == k ? along : 0) - (force[a] * arm[b] + force[b] * arm[a]) / 2) / largest;
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(stiffness);
  // An eigenvalue that is 0, as that of the line along the force, has rounding errors.
  constexpr double kRounding = 1e-12;
  for (int i = 2; i >= 0 && solver.eigenvalues()[i] > kRounding; --i) {
    const Eigen::Vector3d axis = solver.eigenvectors().col(i);
    rows.push_back(
        row_of_turn(part, {axis[0], axis[1], axis[2]}, largest * solver.eigenvalues()[i]));
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
