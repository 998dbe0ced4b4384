// Rows of contacts. Both arms of a contact end at one point, so that opposite impulses do not
// change the angular momentum of the pair.
#include "viscontact/constraint_rows/contact_rows.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "viscontact/particles/contact/shaped_contacts.hpp"

namespace viscontact::particles {

template <int D>
RigidUnit<D> unit_of_particle(double mobility, double turn_mobility, const double* displacement,
                              const double* turn) {
  assert(mobility >= 0 && turn_mobility >= 0);
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  RigidUnit<D> unit;
  unit.mobility = mobility;
  unit.inverse_mobility = 1 / mobility;
  for (std::size_t i = 0; i < d; ++i) unit.free[i] = displacement[i];
  for (std::size_t i = 0; i < r; ++i) {
    unit.free[d + i] = turn[i];
    unit.turn_mobility[i * r + i] = turn_mobility;
    unit.inverse_turn_mobility[i * r + i] = 1 / turn_mobility;
  }
  return unit;
}

template <int D>
RigidUnit<D> unit_of_body(const BodyStep& free) {
  assert(free.mobility > 0);
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  RigidUnit<D> unit;
  unit.mobility = free.mobility;
  unit.inverse_mobility = 1 / free.mobility;
  for (std::size_t i = 0; i < d; ++i) unit.free[i] = free.displacement[i];
  // A disc turns about z only, the last of the three axes of BodyStep.
  for (std::size_t i = 0; i < r; ++i) {
    unit.free[d + i] = free.turn[3 - r + i];
    for (std::size_t k = 0; k < r; ++k) {
      const std::size_t at = 3 * (3 - r + i) + 3 - r + k;
      unit.turn_mobility[i * r + k] = free.turn_mobility[at];
      unit.inverse_turn_mobility[i * r + k] = free.inverse_turn_mobility[at];
    }
  }
  return unit;
}

template RigidUnit<2> unit_of_particle<2>(double, double, const double*, const double*);
template RigidUnit<3> unit_of_particle<3>(double, double, const double*, const double*);
template RigidUnit<2> unit_of_body<2>(const BodyStep&);
template RigidUnit<3> unit_of_body<3>(const BodyStep&);

namespace {

/// Unit vectors that complete `normal` to a right-handed basis. They depend continuously on the
/// normal, except where another component of a normal in space becomes the smallest one.
template <int D>
std::array<Vector, static_cast<std::size_t>(D - 1)> tangent_basis(const Vector& normal) {
  if constexpr (D == 2) {
    return {Vector{-normal[1], normal[0], 0}};
  } else {
    std::size_t least = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (std::abs(normal[d]) < std::abs(normal[least])) least = d;
    Vector axis{};
    axis[least] = 1;
    const Vector across = cross(normal, axis);
    const Vector first = (1 / norm(across)) * across;
    return {first, cross(normal, first)};
  }
}

template <int D>
Vector normal_of(const Contact<D>& contact) {
  Vector normal{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(D); ++d) normal[d] = contact.normal[d];
  return normal;
}

}  // namespace

template <int D>
ContactTangents<D> tangents_of(const Contact<D>& contact, const Particles& particles,
                               std::span<const Plane> obstacles, double begin, double end) {
  assert(contact.first >= 0 || static_cast<std::size_t>(contact.obstacle) < obstacles.size());
  ContactTangents<D> tangents;
  const auto j = index_of(contact.second);
  const Vector normal = normal_of(contact);
  tangents.directions = tangent_basis<D>(normal);
  const auto circles = circles_of(contact, particles);
  tangents.centres = circles.centres;
  const double r_j = circles.radii[1];
  tangents.second_arm = r_j;
  if (contact.first >= 0) {
    // The arms are in the ratio of the radii and add up to the distance of the centres, also if the
    // gap is not 0. Opposite impulses at their common end do not change the angular momentum.
    const double r_i = circles.radii[0];
    assert(r_i + r_j > 0);
    const double distance = r_i + r_j + contact.gap - contact.tolerated;
    tangents.first_arm = r_i * (distance / (r_i + r_j));
    tangents.second_arm = r_j * (distance / (r_i + r_j));
  } else {
    const auto& obstacle = obstacles[static_cast<std::size_t>(contact.obstacle)];
    const Vector point = particles.position(j) + circles.centres[1] - (r_j + contact.gap) * normal;
    tangents.surface = obstacle.displacement(point, begin, end);
  }
  return tangents;
}

template <int D>
void add_contact_row(const Contact<D>& contact, const ContactTangents<D>& tangents,
                     const ContactSide& first, const ContactSide& second, std::size_t k,
                     double impulse, ConstraintProblem<D>& problem) {
  assert(k < static_cast<std::size_t>(D));
  const Vector normal = normal_of(contact);
  const Vector direction = k == 0 ? normal : tangents.directions[k - 1];
  double offset = k == 0 ? contact.gap : 0 - dot(direction, tangents.surface);
  std::array<RowPart<D>, 2> parts;
  std::size_t count = 0;
  const auto add = [&](const ContactSide& side, const Vector& along, const Vector& arm) {
    if (side.unit >= 0)
      parts[count++] = {side.unit, displacement_row<D>(along, arm)};
    else
      offset += dot(along, side.displacement + cross(side.turn, arm));
  };
  add(second, direction, second.offset + tangents.centres[1] - tangents.second_arm * normal);
  const bool is_along_plane = contact.loaded_plane >= 0 && k > 0;
  add(first, is_along_plane ? Vector{} : -1 * direction,
      first.offset + tangents.centres[0] + tangents.first_arm * normal);
  problem.add_row(offset, std::span(parts).first(count), impulse);
}

template ContactTangents<2> tangents_of<2>(const Contact<2>&, const Particles&,
                                           std::span<const Plane>, double, double);
template ContactTangents<3> tangents_of<3>(const Contact<3>&, const Particles&,
                                           std::span<const Plane>, double, double);
template void add_contact_row<2>(const Contact<2>&, const ContactTangents<2>&, const ContactSide&,
                                 const ContactSide&, std::size_t, double, ConstraintProblem<2>&);
template void add_contact_row<3>(const Contact<3>&, const ContactTangents<3>&, const ContactSide&,
                                 const ContactSide&, std::size_t, double, ConstraintProblem<3>&);

}  // namespace viscontact::particles
