// Membranes, as a case describes them, and the shapes in which they begin. A membrane is a closed
// necklace of particles, its beads, that bends and does not change its length, nor that of any of
// its parts, nor the area inside. In a fluid it is the curve through the centres of the beads,
// without a fluid the polygon (docs/physics.md, section 8). Lengths, masses and times are in the
// units of the case; in a fluid masses and forces are per unit length of the third dimension.
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

/// A membrane of a case. In a fluid its curve goes through the centres of the beads by
/// trigonometric interpolation over the place in `beads`.
struct Membrane {
  /// Numbers of the particles that are its beads, counter-clockwise around the area inside.
  std::vector<std::int32_t> beads;
  /// kappa of (kappa/2) integral of curvature^2 ds [M L^3/T^2], where M is a mass per unit length
  /// in a fluid; > 0 in a fluid, >= 0 without one.
  double bending_rigidity = 1;
  double perimeter = 0;  ///< kept; in a fluid with equal lengths between beads [L], > 0
  double area = 0;       ///< inside at the start, kept if `keeps_area` [L^2], > 0
  // In a fluid:
  /// Viscosity of the fluid inside over that of the fluid outside [1], > 0.
  double viscosity_ratio = 1;
  // Without a fluid:
  /// Moment against the rate at which the curvature changes [M L^3/T], >= 0.
  double bending_viscosity = 0;
  bool keeps_area = true;  ///< false: only the lengths are kept; always true in a fluid
  /// The distances that neighbours keep [L], > 0: entry k is that of beads k and k + 1. Empty in a
  /// fluid.
  std::vector<double> lengths;

  /// True if bending takes a force.
  bool resists_bending() const { return bending_rigidity > 0 || bending_viscosity > 0; }
  /// Makes `count` particles from number `first` on its beads.
  void set_beads(std::int32_t first, std::int32_t count) {
    beads.resize(static_cast<std::size_t>(count));
    std::iota(beads.begin(), beads.end(), first);
  }
  /// Number of its beads.
  std::int32_t count() const { return static_cast<std::int32_t>(beads.size()); }
  /// The particle that is bead k, where k counts around the membrane from 0 in both directions.
  std::int32_t bead(std::int32_t k) const {
    return beads[static_cast<std::size_t>(((k % count()) + count()) % count())];
  }
  /// True if a particle is one of its beads.
  bool has(std::int32_t particle) const {
    return std::ranges::find(beads, particle) != beads.end();
  }
};

/// With fewer beads the interpolation does not resolve an ellipse of reduced area 0.9.
inline constexpr std::int32_t kLeastBeads = 12;

/// The membranes of a case, in a fluid or without one.
const std::vector<Membrane>& membranes_of(const Setting& setting);

/// What a table says of a membrane at one time.
struct MembraneMeasures {
  double x = 0,               ///< x of the centre of the area inside [L]
      y = 0;                  ///< y of this centre [L]
  double inclination = 0;     ///< of the long axis of that area, in (-pi/2, pi/2] [rad]
  double area = 0;            ///< [L^2]
  double perimeter = 0;       ///< [L]
  double membrane_speed = 0;  ///< mean speed of the beads relative to their mean velocity [L/T]
  /// Turns of the membrane around the area inside relative to its long axis, counter-clockwise if
  /// > 0 [1/T].
  double tank_treading_frequency = 0;
};

/// Measures a membrane in the state of these particles. In a periodic domain the centre is that of
/// the image in which its first bead is.
MembraneMeasures measure(const Membrane& membrane, const Particles& particles);

/// Throws Error(kBadInput) if membranes of a state from a file have other perimeters or areas than
/// those of the case. In a run both are kept.
void check_shapes(std::span<const Membrane> membranes, const Particles& particles);

/// Sets Particles::neighbours for membranes without a fluid.
void join_neighbours(std::span<const Membrane> membranes, Particles& particles);

/// The rows of membranes.csv of all membranes of a state:
/// time,id,x,y,inclination,area,perimeter,membrane_speed,tank_treading_frequency.
std::string membrane_rows(const Setting& setting, const State& state,
                          std::span<const double> force_errors);
/// The names of these columns after time and id.
inline constexpr const char* kMembraneColumns =
    "x,y,inclination,area,perimeter,membrane_speed,tank_treading_frequency";

/// Centres of the beads of an ellipse about `centre` [L] with the beads, perimeter and area of the
/// membrane, two numbers for each; its long axis has the direction `angle` [rad]. The beads are at
/// equal distances along the ellipse, and are moved a little so that lengths and area are exact:
/// those of the curve, or those of the polygon if the membrane has `lengths`. Nothing if so few
/// beads cannot have this shape. area <= perimeter^2/(4 pi).
std::optional<std::vector<double>> ellipse_of(const Membrane& membrane, const Vector& centre,
                                              double angle);

/// Gives a membrane without a fluid the distances and the area that its particles have, and brings
/// its beads in the order counter-clockwise.
void shape_polygon(Membrane& membrane, const Particles& particles);

/// Gives a membrane in a fluid the perimeter and the area of the curve through its particles,
/// brings its beads in the order counter-clockwise, and moves them to equal distances. Returns the
/// largest component of a displacement [L], or infinity if there are no such places.
double shape_curve(Membrane& membrane, Particles& particles);

/// The largest area of a polygon with these distances of neighbours [L^2], that of the one whose
/// corners are on a circle. Of distances > 0 [L], each less than the sum of the others.
double largest_area(std::span<const double> lengths);

/// The corners of the polygon through the beads: those images of which each is the nearest to the
/// one before it.
std::vector<double> corners_of(const Membrane& membrane, const Particles& particles);

// Closed polygons are two numbers for each corner.

/// True if a point is inside a polygon.
bool is_inside(const std::array<double, 2>& x, std::span<const double> polygon);
/// True if sides of two polygons cross.
bool do_cross(std::span<const double> first, std::span<const double> second);
/// True if one of two polygons that do not cross is inside the other.
bool do_contain(std::span<const double> first, std::span<const double> second);
/// True if two sides of a polygon that are no neighbours cross.
bool crosses_itself(std::span<const double> polygon);

}  // namespace viscontact::particles
