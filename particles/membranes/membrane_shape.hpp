// Shapes in which membranes begin, and geometry of polygons for checks. Lengths are in the unit of
// the case. Used by membrane_keys.cpp and membrane_checks.cpp. A change must keep the places of the
// beads, on which the results of a case depend.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/particles/membranes/membrane.hpp"
#include "viscontact/particles/particles.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Centres of the beads of an ellipse about `centre` [L] with the beads, perimeter and area of the
/// membrane, two numbers for each; its long axis has the direction `angle` [rad]. The beads are at
/// equal distances along the ellipse, and are then moved slightly so that lengths and area are
/// exact: those of the curve, or those of the polygon if the membrane has `lengths`. Returns
/// nothing if so few beads cannot have this shape. Needs area <= perimeter^2/(4 pi).
std::optional<std::vector<double>> ellipse_of(const Membrane& membrane, const Vector& centre,
                                              double angle);

/// Gives a membrane without a fluid the distances and the area that its particles have, and brings
/// its beads in the order counter-clockwise.
void shape_polygon(Membrane& membrane, const Particles& particles);

/// Gives a membrane in a fluid the perimeter and the area of the curve through its particles,
/// brings its beads in the order counter-clockwise, and moves them to equal distances. Returns the
/// largest component of a displacement [L], or infinity if there are no such places.
double shape_curve(Membrane& membrane, Particles& particles);

/// The largest area of a polygon whose sides have these lengths [L^2]: that of the polygon whose
/// corners are on a circle. Each length [L] must be > 0 and less than the sum of the others.
double largest_area(std::span<const double> lengths);

/// The corners of the polygon through the beads, two numbers for each [L]. In a periodic domain
/// each corner is the image of its bead that is nearest to the corner before it.
std::vector<double> corners_of(const Membrane& membrane, const Particles& particles);

// In the following, a closed polygon is given by two numbers for each corner [L].

/// True if a point is inside a polygon.
bool is_inside(const std::array<double, 2>& x, std::span<const double> polygon);
/// True if sides of two polygons cross.
bool do_cross(std::span<const double> first, std::span<const double> second);
/// True if one of two polygons that do not cross is inside the other.
bool do_contain(std::span<const double> first, std::span<const double> second);
/// True if two sides of a polygon that are no neighbours cross.
bool crosses_itself(std::span<const double> polygon);

}  // namespace viscontact::particles
