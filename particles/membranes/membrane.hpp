// Declares membranes as a case describes them, the shapes in which they begin, their measures for
// output, and geometry of polygons for checks. A membrane is a closed line through particles, its
// beads. It can bend, but the length of each of its parts and (by default) the area inside are
// kept. In a fluid the line is a smooth curve through the centres of the beads, without a fluid a
// polygon (docs/physics.md, section 8). Lengths, masses and times are in the units of the case; in
// a fluid masses and forces are per length of the third dimension. Only check_shapes() throws, and
// numbers of particles and sizes of arrays are not checked. case/, fluid/, io/, links/, run/ and
// freefem_flow/ use this file. A change must keep the columns of membranes.csv, and the places
// where beads begin, because the results of cases depend on them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

struct Particles;
struct Setting;
struct State;

/// A membrane of a case. In a fluid its curve is the trigonometric interpolation of the centres of
/// the beads: bead k of N is at the parameter 2 pi k/N of the curve.
struct Membrane {
  /// Numbers of the particles that are its beads, counter-clockwise around the area inside; at
  /// least kLeastBeads in a fluid, 4 without one (the reader of a case checks it).
  std::vector<std::int32_t> beads;
  /// The factor kappa of the bending energy, which is kappa/2 times the integral of curvature^2
  /// along the line [M L^3/T^2], in a fluid per length [M L^2/T^2]; > 0 in a fluid, >= 0 without
  /// one.
  double bending_rigidity = 1;
  double perimeter = 0;  ///< length of the closed line, which is kept [L], > 0
  double area = 0;       ///< area inside at the start, kept if `keeps_area` [L^2], > 0
  // The next member is used only in a fluid, and the three after it only without a fluid.
  /// Viscosity of the fluid inside over that of the fluid outside [1], > 0.
  double viscosity_ratio = 1;
  /// Moment that opposes a change of the curvature, over the rate of this change [M L^3/T], >= 0.
  double bending_viscosity = 0;
  bool keeps_area = true;  ///< false: the area may change; always true in a fluid
  /// The distances that neighbours keep [L], > 0: entry k is that of beads k and k + 1. Empty in a
  /// fluid, where beads keep equal distances along the curve.
  std::vector<double> lengths;

  /// True if the membrane resists bending.
  bool resists_bending() const { return bending_rigidity > 0 || bending_viscosity > 0; }
  /// Takes the particles `first` >= 0 to `first` + `count` - 1 as its beads; `count` >= 0.
  void set_beads(std::int32_t first, std::int32_t count) {
    beads.resize(static_cast<std::size_t>(count));
    std::iota(beads.begin(), beads.end(), first);
  }
  /// Number of its beads.
  std::int32_t count() const { return static_cast<std::int32_t>(beads.size()); }
  /// Number of the particle that is bead k, where k is any whole number, taken modulo count() > 0.
  std::int32_t bead(std::int32_t k) const {
    return beads[static_cast<std::size_t>(((k % count()) + count()) % count())];
  }
  /// True if a particle is one of its beads.
  bool has(std::int32_t particle) const {
    return std::ranges::find(beads, particle) != beads.end();
  }
};

/// Least number of beads in a fluid, which the reader of a case enforces. With fewer beads the
/// interpolation does not resolve an ellipse of the reduced area 4 pi area/perimeter^2 = 0.9. A
/// larger number may be chosen freely.
inline constexpr std::int32_t kLeastBeads = 12;

/// The membranes of a case, in a fluid or without one; empty if it has none. The result is a
/// reference into `setting`.
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
  /// this area [1/T]. It is > 0 if the membrane runs counter-clockwise, and 0 if membrane_speed is
  /// 0.
  double tank_treading_frequency = 0;
};

/// Measures a membrane with the positions and velocities of these particles. In a periodic domain
/// the membrane is measured as the closed line that begins at the position of its first bead, and
/// its centre may be outside the domain.
MembraneMeasures measure(const Membrane& membrane, const Particles& particles);

/// Checks membranes whose particles come from a restart file. Throws Error(kBadInput) if a
/// perimeter, or an area that is kept, differs from that of the case by more than the fraction 1e-6
/// of it, or if a distance of neighbours differs by more than 1e-6 of the mean distance. The
/// fraction is a free choice, far above the errors of a run.
void check_shapes(std::span<const Membrane> membranes, const Particles& particles);

/// Sets Particles::neighbours for membranes without a fluid. The array gets a pair of numbers for
/// each particle: those of the two beads next to it, or {-1, -1} if the particle is no bead. It
/// becomes empty if there are no membranes.
void join_neighbours(std::span<const Membrane> membranes, Particles& particles);

/// The rows of membranes.csv of all membranes of a state, one line each: the time [T], the number
/// of the membrane from 0, and the MembraneMeasures; empty without membranes. `force_errors` is not
/// used; it is there because functions of the same type write other tables of links (TimeTable).
std::string membrane_rows(const Setting& setting, const State& state,
                          std::span<const double> force_errors);
/// The names of the columns of membranes.csv after time and id.
inline constexpr const char* kMembraneColumns =
    "x,y,inclination,area,perimeter,membrane_speed,tank_treading_frequency";

/// Centres of the beads of a membrane that begins as an ellipse about `centre` [L] whose long axis
/// has the direction `angle` [rad], two numbers for each bead [L]. The number of beads, perimeter
/// and area are those of `membrane`; the area must be at most perimeter^2/(4 pi) (not checked). The
/// beads are put at equal distances along the ellipse, and then moved slightly so that lengths and
/// area are exact: those of the polygon if Membrane::lengths is not empty, otherwise those of the
/// curve. Returns std::nullopt if the beads are too few for this shape, so that no such places are
/// found.
std::optional<std::vector<double>> ellipse_of(const Membrane& membrane, const Vector& centre,
                                              double angle);

/// Sets lengths, perimeter and area of a membrane without a fluid to those of the polygon through
/// its particles, and reverses the order of its beads if it is clockwise.
void shape_polygon(Membrane& membrane, const Particles& particles);

/// Sets perimeter and area of a membrane in a fluid to those of the curve through its particles,
/// reverses the order of its beads if it is clockwise, and moves them to equal distances along the
/// curve. Returns the largest component of a displacement [L], >= 0. If no such places are found,
/// it returns infinity and moves no bead, but perimeter, area and order are set nevertheless.
double shape_curve(Membrane& membrane, Particles& particles);

/// The largest area [L^2] that a polygon with sides of these lengths can have. The polygon with
/// this area has its corners on a circle. There are at least 3 lengths, and each length [L] must be
/// > 0 and less than the sum of the others (not checked).
double largest_area(std::span<const double> lengths);

/// The corners of the polygon through the beads, two numbers for each [L]. In a periodic domain
/// each bead is taken at its image that is nearest to the corner before it.
std::vector<double> corners_of(const Membrane& membrane, const Particles& particles);

// The following functions take a closed polygon as an array of two numbers, x and y, for each
// corner [L]; there are at least three corners (not checked).

/// True if a point [L] is inside a polygon. Points on its sides may count as either.
bool is_inside(const std::array<double, 2>& x, std::span<const double> polygon);
/// True if a side of one polygon crosses a side of the other.
bool do_cross(std::span<const double> first, std::span<const double> second);
/// True if one of two polygons that do not cross is inside the other.
bool do_contain(std::span<const double> first, std::span<const double> second);
/// True if two sides of a polygon that have no common corner cross.
bool crosses_itself(std::span<const double> polygon);

}  // namespace viscontact::particles
