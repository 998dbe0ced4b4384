// The polygon (necklace) through the particles (beads) of a membrane without a fluid,
// docs/physics.md (8.9) to (8.12): its distances, area and bending, and its equations in a time
// step, in the form of the equations of links. Lengths, masses and times are in any consistent
// units. An array of positions has x of all N >= 3 beads of one membrane and then y of all [L].
// Nothing is checked or thrown. links/link_rows.cpp and the sources of this folder use it. No
// header that users of the library include may include it, because they need no Eigen. A change
// must keep the order of the equations, which is that of State::link_forces.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "viscontact/particles/links/link_rows.hpp"
#include "viscontact/particles/membranes/membrane.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// Positions of the beads of a membrane, 2 N numbers [L]. In a periodic domain each bead is taken
/// at its image that is nearest to the bead before it.
Eigen::VectorXd necklace_of(const Membrane& membrane, const Particles& particles);

/// The distances >= 0 of neighbours, N numbers [L]: entry k is that of beads k and k + 1.
Eigen::VectorXd distances_of(const Eigen::VectorXd& necklace);

/// The area inside the polygon [L^2], > 0 if it is counter-clockwise.
double area_of(const Eigen::VectorXd& necklace);
/// The derivatives of area_of() with respect to the positions, 2 N numbers [L].
Eigen::VectorXd area_gradient(const Eigen::VectorXd& necklace);

/// The angles by which the polygon turns (> 0: left) at the N beads, each in (-pi, pi] [rad].
Eigen::VectorXd turns_of(const Eigen::VectorXd& necklace);

/// The bending energy over the bending rigidity [1/L], >= 0: the sum over beads of turn^2/(2
/// length), where the length of a bead is the mean of its two distances in `lengths` (N numbers
/// [L], > 0).
double bending_energy(const Eigen::VectorXd& necklace, const Eigen::VectorXd& lengths);

/// Moves the beads as little as possible until the distances are `lengths` (N numbers [L]) and the
/// area is `area` [L^2], to 1e-13 of the mean distance and its square. Returns false if Newton's
/// method finds no such positions in 50 rounds; `necklace` is then undefined.
bool restore_necklace(const Eigen::VectorXd& lengths, double area, Eigen::VectorXd& necklace);

/// Measures a membrane without a fluid with the positions and velocities of these particles; the
/// speed and the frequency are 0 if all beads have one velocity.
MembraneMeasures measure_necklace(const Membrane& membrane, const Particles& particles);

/// The equations of a membrane, in the order of its forces in State::link_forces: N for the
/// distances of neighbours, N for the turns of the beads with the membrane, N for the bending
/// springs of the beads if it resists bending, and one for the area if it is kept. The caller,
/// link_equations(), sets `number` and `first_force`.
std::vector<LinkEquations> membrane_equations(const Membrane& membrane, const Particles& particles,
                                              const LinkTimes& times);

/// Value of the row of a distance, a turn or the area after these motions of the beads, which are
/// in the order of the row's parts: the excess of the distance [L], of the turn [rad], or of the
/// area over the mean distance [L].
double membrane_value_after(const LinkEquations& equations, const Membrane& membrane,
                            const Particles& particles, std::span<const UnitMotion> motions);

}  // namespace viscontact::particles
