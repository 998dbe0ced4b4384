// The polygon of a membrane without a fluid, docs/physics.md (8.9) to (8.12): distances between
// beads, area, and bending, and its equations in a time step as those of links
// (links/link_rows.hpp, which uses them). Only sources of particles/ and tests include it, because
// users of the library need no Eigen. Lengths, masses and times are in the units of the case. An
// array of positions has x of all beads of one membrane and then y of all. Nothing is checked or
// thrown. A change must keep the order of the equations, which is that of State::link_forces.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "viscontact/particles/links/link_rows.hpp"
#include "viscontact/particles/membranes/membrane.hpp"
#include "viscontact/particles/membranes/membrane_curve.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// Positions of the beads of a membrane. In a periodic domain each bead is taken at its image that
/// is nearest to the bead before it.
Eigen::VectorXd necklace_of(const Membrane& membrane, const Particles& particles);

/// The distances of neighbours, entry k that of beads k and k + 1 [L].
Eigen::VectorXd distances_of(const Eigen::VectorXd& necklace);

/// The area inside the polygon [L^2], > 0 if it is counter-clockwise.
double area_of(const Eigen::VectorXd& necklace);
/// The derivatives of area_of(), as many numbers as positions [L].
Eigen::VectorXd area_gradient(const Eigen::VectorXd& necklace);

/// The angles by which the polygon turns at the beads, each in (-pi, pi] [rad].
Eigen::VectorXd turns_of(const Eigen::VectorXd& necklace);

/// The bending energy divided by the rigidity kappa: the sum over beads of turn^2/(2 length), where
/// the length of a bead is the mean of its two distances in `lengths` [1/L].
double bending_energy(const Eigen::VectorXd& necklace, const Eigen::VectorXd& lengths);

/// Moves the beads as little as possible until the distances are `lengths` [L] and the area is
/// `area` [L^2]. Returns false if Newton's method finds no such positions.
bool restore_necklace(const Eigen::VectorXd& lengths, double area, Eigen::VectorXd& necklace);

/// Measures a membrane without a fluid in the state of these particles.
MembraneMeasures measure_necklace(const Membrane& membrane, const Particles& particles);

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
