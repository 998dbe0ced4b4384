// The polygon of a membrane without a fluid, docs/physics.md (8.9) to (8.12): distances between
// beads, area, and bending. For sources of this folder and tests: it needs Eigen. Lengths are in
// the unit of the case. An array of positions has x of all beads of one membrane and then y of all.
#pragma once

#include <Eigen/Core>

#include "viscontact/particles/membranes/membrane.hpp"
#include "viscontact/particles/membranes/membrane_curve.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// Positions of the beads of a membrane: in a periodic domain those images of the particles of
/// which each is the nearest to the one before it.
Eigen::VectorXd necklace_of(const Membrane& membrane, const Particles& particles);

/// The distances of neighbours, entry k that of beads k and k + 1 [L].
Eigen::VectorXd distances_of(const Eigen::VectorXd& necklace);

/// The area inside the polygon [L^2], > 0 if it is counter-clockwise.
double area_of(const Eigen::VectorXd& necklace);
/// The derivatives of area_of(), as many numbers as positions [L].
Eigen::VectorXd area_gradient(const Eigen::VectorXd& necklace);

/// The angles by which the polygon turns at the beads, each in (-pi, pi] [rad].
Eigen::VectorXd turns_of(const Eigen::VectorXd& necklace);

/// The bending energy over kappa, the sum over beads of turn^2/(2 length), where the length of a
/// bead is the mean of its two distances in `lengths` [1/L].
double bending_energy(const Eigen::VectorXd& necklace, const Eigen::VectorXd& lengths);

/// Moves the beads as little as possible until the distances are `lengths` and the area is `area`.
/// Returns false if Newton's method finds no such positions.
bool restore_necklace(const Eigen::VectorXd& lengths, double area, Eigen::VectorXd& necklace);

/// Measures a membrane without a fluid in the state of these particles.
MembraneMeasures measure_necklace(const Membrane& membrane, const Particles& particles);

}  // namespace viscontact::particles
