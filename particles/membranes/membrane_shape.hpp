// Shapes in which membranes begin. Lengths are in the unit of the case.
#pragma once

#include <optional>
#include <vector>

#include "viscontact/particles/membranes/membrane.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Centres of the beads of an ellipse about `centre` [L] with the beads, perimeter and area of the
/// membrane, two numbers for each; its long axis has the direction `angle` [rad]. The beads are at
/// equal distances along the ellipse, and are moved a little so that lengths and area are exact.
/// Nothing if so few beads cannot have this shape. area <= perimeter^2/(4 pi).
std::optional<std::vector<double>> ellipse_of(const Membrane& membrane, const Vector& centre,
                                              double angle);

/// True if two closed polygons, two numbers for each corner, cross each other, or if one is inside
/// the other.
bool do_meet(std::span<const double> first, std::span<const double> second);

}  // namespace viscontact::particles
