// The geometric stiffness of forces that links exert, docs/physics.md (5.21).
#pragma once

#include <span>
#include <vector>

#include "viscontact/particles/links/link_rows.hpp"
#include "viscontact/particles/links/links.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// Rows of the geometric stiffness of two opposite forces along the line between two points, which
/// `apart`, not 0, leads from the point of `first` to that of `second` [L]. The points are pulled
/// together with the force `tension` [M L/T^2], < 0 if they are pushed apart. A row is a spring that
/// is not extended at the present places: its part `stiffness` is > 0, `value` and `compliance`
/// are 0. The first rows, only with a tension > 0, are displacements across the line [L]. Then
/// follow those of the turns of both units, (rows_of_turn()).
std::vector<LinkRow> rows_across(const LinkPart& first, const LinkPart& second, const Vector& apart,
                                 double tension, int dimension);

/// Rows of the positive part of the geometric stiffness (F a) I - (F a^T + a F^T)/2 of a force F on
/// the point of `part`, whose arm is a: turns [rad] about at most two axes at right angles. Each row
/// has one part, with LinkPart::is_turn and this arm. None without an arm.
std::vector<LinkRow> rows_of_turn(const LinkPart& part, const Vector& force, int dimension);

/// Rows of the geometric stiffness of a hinge, spring, arm or distance of a membrane, whose rows
/// have the present places and these `forces` [M L/T^2]; none for other links.
std::vector<LinkRow> rows_of_tension(const LinkEquations& link, std::span<const double> forces,
                                     const Particles& particles);

/// Rate at which the value of a row changes with the present velocities [L/T, 1/T].
double rate_of(const LinkRow& row, const Particles& particles);

}  // namespace viscontact::particles
