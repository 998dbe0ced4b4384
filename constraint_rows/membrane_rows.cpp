// The rows of a membrane without a fluid, docs/physics.md (8.9) to (8.12).
#include <cassert>
#include <cmath>
#include <utility>

#include "viscontact/constraint_rows/link_rows.hpp"
#include "viscontact/membranes/necklace.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {
namespace {

using Kind = LinkEquations::Kind;

/// The vector from bead `from` to the nearest image of bead `to` [L]; numbers count modulo that of
/// beads.
Vector apart(const Membrane& membrane, const Particles& p, std::int32_t from, std::int32_t to) {
  return nearest_image(
      p.cell, p.position(index_of(membrane.bead(to))) - p.position(index_of(membrane.bead(from))));
}

/// The vector from bead k - 1 to bead k + 1 [L].
Vector across(const Membrane& membrane, const Particles& p, std::int32_t k) {
  return apart(membrane, p, k - 1, k) + apart(membrane, p, k, k + 1);
}

/// `v` turned by 90 degrees to the left.
Vector left_of(const Vector& v) { return {-v[1], v[0], 0}; }

/// In (-pi, pi] [rad].
double angle_between(const Vector& from, const Vector& to) {
  return std::atan2(from[0] * to[1] - from[1] * to[0], dot(from, to));
}

/// The inner product of `direction` and the displacement of bead k.
LinkPart part(const Membrane& membrane, std::int32_t k, const Vector& direction) {
  LinkPart of_bead;
  of_bead.particle = membrane.bead(k);
  of_bead.direction = direction;
  return of_bead;
}

LinkEquations equations(Kind kind, std::int32_t bead, LinkRow row) {
  LinkEquations one{kind};
  one.bead = bead;
  one.rows.push_back(std::move(row));
  return one;
}

LinkRow distance_row(const Membrane& membrane, const Particles& p, std::int32_t k) {
  const Vector d = apart(membrane, p, k, k + 1);
  const Vector along = (1 / norm(d)) * d;
  LinkRow row;
  row.parts = {part(membrane, k, -1 * along), part(membrane, k + 1, along)};
  row.value = norm(d) - membrane.lengths[static_cast<std::size_t>(k)];
  return row;
}

/// The bending spring at bead k, (8.12). Its extension [L] is the angle by which the polygon turns
/// at the bead, times the mean length l of its two sides, so that its stiffness is bending
/// rigidity/l^3 [M/T^2]. The bending viscosity opposes the change of the extension in the step.
LinkRow bend_row(const Membrane& membrane, const Particles& p, std::int32_t k,
                 const LinkTimes& times) {
  assert(membrane.resists_bending() && times.h > 0 && times.impulse_time > 0);
  const auto n = membrane.lengths.size(), i = static_cast<std::size_t>(k);
  const double length = (membrane.lengths[(i + n - 1) % n] + membrane.lengths[i]) / 2;
  const Vector before = apart(membrane, p, k - 1, k), after = apart(membrane, p, k, k + 1);
  const Vector of_before = (length / dot(before, before)) * left_of(before),
               of_after = (length / dot(after, after)) * left_of(after);
  LinkRow row;
  row.parts = {part(membrane, k - 1, of_before), part(membrane, k, -1 * (of_before + of_after)),
               part(membrane, k + 1, of_after)};
  row.extension = length * angle_between(before, after);
  row.stiffness = membrane.bending_rigidity / (length * length * length);
  double rate = 0;
  for (const auto& of_bead : row.parts)
    rate += dot(of_bead.direction, p.velocity(index_of(of_bead.particle)));
  const double beta = times.beta();
  const double elastic = times.impulse_time * row.stiffness,
               viscous = times.impulse_time * membrane.bending_viscosity /
                         (length * length * length * times.h);
  row.compliance = 1 / (beta * elastic + viscous);
  row.value =
      elastic * (row.extension - (times.is_first ? 0 : beta * times.h * rate)) * row.compliance;
  return row;
}

LinkRow turn_row(const Membrane& membrane, const Particles& p, std::int32_t k) {
  const Vector chord = across(membrane, p, k);
  const Vector of_ends = (1 / dot(chord, chord)) * left_of(chord);
  LinkRow row;
  row.parts = {part(membrane, k - 1, of_ends), part(membrane, k, {0, 0, 1}),
               part(membrane, k + 1, -1 * of_ends)};
  row.parts[1].is_turn = true;
  return row;
}

/// Division by the mean distance of neighbours gives all rows of distances and area the dimension
/// [L].
LinkRow area_row(const Membrane& membrane, const Particles& p) {
  const double length = membrane.perimeter / membrane.count();
  const auto necklace = necklace_of(membrane, p);
  const Eigen::VectorXd gradient = area_gradient(necklace) / length;
  LinkRow row;
  for (std::int32_t k = 0; k < membrane.count(); ++k)
    row.parts.push_back(part(membrane, k, {gradient(k), gradient(membrane.count() + k), 0}));
  row.value = (area_of(necklace) - membrane.area) / length;
  return row;
}

}  // namespace

std::vector<LinkEquations> membrane_equations(const Membrane& membrane, const Particles& particles,
                                              const LinkTimes& times) {
  assert(membrane.count() >= 3 && membrane.lengths.size() == membrane.beads.size());
  std::vector<LinkEquations> all;
  for (std::int32_t k = 0; k < membrane.count(); ++k)
    all.push_back(equations(Kind::kDistance, k, distance_row(membrane, particles, k)));
  for (std::int32_t k = 0; k < membrane.count(); ++k)
    all.push_back(equations(Kind::kTurn, k, turn_row(membrane, particles, k)));
  for (std::int32_t k = 0; k < membrane.count() && membrane.resists_bending(); ++k)
    all.push_back(equations(Kind::kBend, k, bend_row(membrane, particles, k, times)));
  if (membrane.keeps_area) all.push_back(equations(Kind::kArea, 0, area_row(membrane, particles)));
  return all;
}

double membrane_value_after(const LinkEquations& equations, const Membrane& membrane,
                            const Particles& particles, std::span<const UnitMotion> motions) {
  assert(!equations.is_spring() && motions.size() == equations.parts().size());
  const auto k = equations.bead;
  const auto by = [&](std::size_t i) { return motions[i].displacement; };
  if (equations.kind == Kind::kDistance)
    return norm(apart(membrane, particles, k, k + 1) + by(1) - by(0)) -
           membrane.lengths[static_cast<std::size_t>(k)];
  if (equations.kind == Kind::kTurn) {
    const Vector chord = across(membrane, particles, k);
    return motions[1].turn[2] - angle_between(chord, chord + by(2) - by(0));
  }
  auto necklace = necklace_of(membrane, particles);
  for (std::int32_t i = 0; i < membrane.count(); ++i) {
    necklace(i) += by(static_cast<std::size_t>(i))[0];
    necklace(membrane.count() + i) += by(static_cast<std::size_t>(i))[1];
  }
  return (area_of(necklace) - membrane.area) * membrane.count() / membrane.perimeter;
}

}  // namespace viscontact::particles
