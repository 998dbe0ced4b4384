// The polygon (necklace) through the beads of a membrane without a fluid, docs/physics.md (8.9) to
// (8.12). Users' programs compile without Eigen, so that no public header may include this one.
#pragma once

#include <Eigen/Core>

#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {

/// Positions of the N beads of a membrane, x of all and then y of all, 2 N numbers [L]. In a
/// periodic domain each bead is taken at its image that is nearest to the bead before it.
Eigen::VectorXd necklace_of(const Membrane& membrane, const Particles& particles);

/// The distances of neighbours, N numbers [L]: entry k is the distance of beads k and k + 1, and
/// the last entry that of the last and the first bead.
Eigen::VectorXd distances_of(const Eigen::VectorXd& necklace);

/// The area inside the polygon [L^2], > 0 if it is counter-clockwise.
double area_of(const Eigen::VectorXd& necklace);
/// The derivatives of area_of() with respect to the positions, 2 N numbers [L].
Eigen::VectorXd area_gradient(const Eigen::VectorXd& necklace);

/// The angles by which the polygon turns (> 0: left) at the N beads, each in (-pi, pi] [rad].
Eigen::VectorXd turns_of(const Eigen::VectorXd& necklace);

/// The bending energy divided by the bending rigidity [1/L], the sum over beads of turn^2/(2
/// length), where the length of a bead is the mean of its two distances in `lengths` (N numbers
/// [L], > 0).
double bending_energy(const Eigen::VectorXd& necklace, const Eigen::VectorXd& lengths);

/// Moves the beads as little as possible until the distances are `lengths` (N numbers [L]) and the
/// area is `area` [L^2], with errors of about 1e-13 of the mean distance and of its square. Returns
/// false if Newton's method finds no such positions in 50 rounds; `necklace` is then undefined.
bool restore_necklace(const Eigen::VectorXd& lengths, double area, Eigen::VectorXd& necklace);

/// The membrane speed and the tank-treading frequency are 0 if all beads have the same velocity.
MembraneMeasures measure_necklace(const Membrane& membrane, const Particles& particles);

}  // namespace viscontact::particles
