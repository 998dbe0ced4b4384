// Makes the units of a constraint problem (rigid_units.hpp).
#include "viscontact/particles/constraints/rigid_units.hpp"

namespace viscontact::particles {

template <int D>
RigidUnit<D> unit_of_particle(double mobility, double turn_mobility, const double* displacement,
                              const double* turn) {
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
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  RigidUnit<D> unit;
  unit.mobility = free.mobility;
  unit.inverse_mobility = 1 / free.mobility;
  for (std::size_t i = 0; i < d; ++i) unit.free[i] = free.displacement[i];
  // A disc turns about z, the last axis.
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

}  // namespace viscontact::particles
