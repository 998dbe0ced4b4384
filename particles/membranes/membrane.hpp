// Membranes, as a case describes them. A membrane is a closed necklace of particles, its beads,
// that bends and does not change its length, nor that of any of its parts, nor the area inside. In
// a fluid it is the curve through the centres of the beads, without a fluid the polygon
// (docs/physics.md, section 8). Lengths, masses and times are in the units of the case; in a fluid
// masses and forces are per unit length of the third dimension. Cases, links/, fluid.hpp and the
// files of a run use it. A change must keep the columns of membranes.csv.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

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
  double perimeter = 0;  ///< is kept; in a fluid beads are equally spaced on it [L], > 0
  double area = 0;       ///< area inside at the start, kept if `keeps_area` [L^2], > 0
  // In a fluid:
  /// Viscosity of the fluid inside over that of the fluid outside [1], > 0.
  double viscosity_ratio = 1;
  // Without a fluid:
  /// Moment per rate of change of the curvature, which opposes the change [M L^3/T], >= 0.
  double bending_viscosity = 0;
  bool keeps_area = true;  ///< false: only the lengths are kept; always true in a fluid
  /// The distances that neighbours keep [L], > 0: entry k is that of beads k and k + 1. Empty in a
  /// fluid.
  std::vector<double> lengths;

  /// True if bending takes a force.
  bool resists_bending() const { return bending_rigidity > 0 || bending_viscosity > 0; }
  /// Sets its beads: the `count` particles from number `first` on.
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

/// Least number of beads in a fluid. With fewer beads the interpolation does not resolve an ellipse
/// of the reduced area 4 pi area/perimeter^2 = 0.9.
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

}  // namespace viscontact::particles
