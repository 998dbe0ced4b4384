// Measures, initial shapes and checks of membranes, docs/physics.md, section 8.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/links/membrane.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

struct Particles;
struct Setting;
struct State;

/// The membranes of the fluid, or without a fluid those of the links.
const std::vector<Membrane>& membranes_of(const Setting& setting);

/// The numbers that membranes.csv has for a membrane at one time.
struct MembraneMeasures {
  double x = 0,               ///< x of the centre of the area inside [L]
      y = 0;                  ///< y of this centre [L]
  double inclination = 0;     ///< angle of the long axis of the area to x, in (-pi/2, pi/2] [rad]
  double area = 0;            ///< area inside [L^2], > 0 if beads go around counter-clockwise
  double perimeter = 0;       ///< length of the closed line [L], > 0
  double membrane_speed = 0;  ///< mean speed of beads relative to their mean velocity [L/T], >= 0
  /// Frequency with which the membrane runs around the area inside, relative to the long axis of
  /// this area [1/T]; > 0 if it runs counter-clockwise, 0 if membrane_speed is 0.
  double tank_treading_frequency = 0;
};

/// Measures a membrane. In a periodic domain it is the closed line that begins at the position of
/// its first bead, and its centre may be outside the domain.
MembraneMeasures measure(const Membrane& membrane, const Particles& particles);

/// Checks membranes whose particles come from a restart file. Throws Error(kBadInput) if a
/// perimeter, or an area that is kept, differs from that of the case by more than the fraction 1e-6
/// of it, or if a distance of neighbours differs by more than 1e-6 of the mean distance.
void check_shapes(std::span<const Membrane> membranes, const Particles& particles);

/// Sets Particles::neighbours for membranes without a fluid: for each particle the numbers of the
/// two beads next to it, or {-1, -1} if it is no bead; empty if there are no membranes.
void join_neighbours(std::span<const Membrane> membranes, Particles& particles);

/// Centres of the beads of a membrane that begins as an ellipse about `centre` [L] whose long axis
/// has the direction `angle` [rad], two numbers for each bead [L]. The number of beads, perimeter
/// and area are those of `membrane`; the area is at most perimeter^2/(4 pi). The beads are put at
/// equal distances along the ellipse, and then moved slightly so that lengths and area are exact.
/// Returns std::nullopt if the beads are too few for this shape.
std::optional<std::vector<double>> ellipse_of(const Membrane& membrane, const Vector& centre,
                                              double angle);

/// Sets lengths, perimeter and area of a membrane without a fluid to those of the polygon through
/// its particles, and reverses the order of its beads if it is clockwise.
void shape_polygon(Membrane& membrane, const Particles& particles);

/// The same in a fluid: sets perimeter and area to those of the curve through the particles,
/// reverses the order of the beads if it is clockwise, and moves them to equal distances along the
/// curve. Returns the largest component of a displacement [L]; if no such places are found,
/// infinity, and no bead moves.
double shape_curve(Membrane& membrane, Particles& particles);

/// The largest area [L^2] of a polygon with sides of these lengths, whose corners are then on a
/// circle. Each length [L] is > 0 and less than the sum of the others.
double largest_area(std::span<const double> lengths);

/// The corners of the polygon through the beads, two numbers for each [L]. In a periodic domain
/// each bead is taken at its image that is nearest to the corner before it.
std::vector<double> corners_of(const Membrane& membrane, const Particles& particles);

// The following functions take a closed polygon as an array of two numbers, x and y, for each
// corner [L].

/// True if a point [L] is inside a polygon. Points on its sides may count as either.
bool is_inside(const std::array<double, 2>& x, std::span<const double> polygon);
/// True if a side of one polygon crosses a side of the other.
bool do_cross(std::span<const double> first, std::span<const double> second);
/// True if one of two polygons that do not cross is inside the other.
bool do_contain(std::span<const double> first, std::span<const double> second);
/// True if two sides of a polygon that have no common corner cross.
bool crosses_itself(std::span<const double> polygon);

}  // namespace viscontact::particles
