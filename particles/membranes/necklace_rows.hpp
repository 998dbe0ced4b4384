// The equations of a membrane without a fluid in a time step, docs/physics.md (8.9) to (8.12), as
// those of links (links/link_rows.hpp, which uses them). Lengths, masses and times are in the units
// of the case. Nothing is checked or thrown. A change must keep the order of the equations, which
// is that of State::link_forces.
#pragma once

#include <span>
#include <vector>

#include "viscontact/particles/links/link_rows.hpp"

namespace viscontact::particles {

/// The equations of a membrane, in the order of its forces (Links::forces_of_membrane): the
/// distances of neighbours, the turns of the beads with the membrane, the bending springs of the
/// beads if it resists bending, and the area if it is kept. The caller, link_equations(), sets
/// `number` and `first_force`.
std::vector<LinkEquations> membrane_equations(const Membrane& membrane, const Particles& particles,
                                              const LinkTimes& times);

/// Value of the row of a distance, a turn or an area after these motions of the beads, which are in
/// the order of the parts [L, rad].
double membrane_value_after(const LinkEquations& equations, const Membrane& membrane,
                            const Particles& particles, std::span<const UnitMotion> motions);

}  // namespace viscontact::particles
