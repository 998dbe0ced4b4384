// Tangents and rows of contacts (contact_rows.hpp), in the units of the case. Nothing is thrown. A
// change must keep the angular momentum of a pair.
#include "viscontact/particles/constraints/contact_rows.hpp"

#include <array>
#include <cmath>

namespace viscontact::particles {
namespace {

/// Unit vectors that complete `normal` to a right-handed basis, without a jump unless the normal
/// changes its largest component.
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
  ContactTangents<D> tangents;
  const auto j = index_of(contact.second);
  const Vector normal = normal_of(contact);
  tangents.directions = tangent_basis<D>(normal);
  const double r_j = particles.radii[j];
  tangents.second_arm = r_j;
  if (contact.first >= 0) {
    // The arms add up to the distance of the centres, so that the impulses of the pair keep the
    // angular momentum also while the gap is open.
    const double r_i = particles.radii[index_of(contact.first)];
    const double distance = r_i + r_j + contact.gap - contact.tolerated;
    tangents.first_arm = r_i * (distance / (r_i + r_j));
    tangents.second_arm = r_j * (distance / (r_i + r_j));
  } else {
    const auto& obstacle = obstacles[static_cast<std::size_t>(contact.obstacle)];
    const Vector point = particles.position(j) - (r_j + contact.gap) * normal;
    tangents.surface = obstacle.displacement(point, begin, end);
  }
  return tangents;
}

template <int D>
void add_contact_row(const Contact<D>& contact, const ContactTangents<D>& tangents,
                     const ContactSide& first, const ContactSide& second, std::size_t k,
                     double impulse, ConstraintProblem<D>& problem) {
  const Vector normal = normal_of(contact);
  const Vector direction = k == 0 ? normal : tangents.directions[k - 1];
  const double offset = k == 0 ? contact.gap : 0 - dot(direction, tangents.surface);
  const RowPart<D> of_second{
      second.unit, displacement_row<D>(direction, second.offset - tangents.second_arm * normal)};
  if (first.unit < 0) {
    problem.add_row(offset, std::array{of_second}, impulse);
    return;
  }
  const RowPart<D> of_first{
      first.unit, displacement_row<D>(-1 * direction, first.offset + tangents.first_arm * normal)};
  problem.add_row(offset, std::array{of_second, of_first}, impulse);
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
