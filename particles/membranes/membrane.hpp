// Membranes in a fluid, as a case describes them. A membrane is a closed necklace of particles, its
// beads. The curve through them bends; it does not change its length, nor that of any of its parts,
// nor the area inside (docs/physics.md, section 8). Lengths, masses and times are in the units of
// the case; in the plane masses and forces are per unit length of the third dimension.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {

struct Setting;
struct State;

/// A membrane of a case. Its beads are particles whose numbers follow each other, in the order
/// counter-clockwise around the area inside. The curve goes through their centres by trigonometric
/// interpolation over the number of the bead.
struct Membrane {
  std::int32_t first = 0;   ///< number of its first bead, >= 0
  std::int32_t beads = 48;  ///< number of its beads, >= kLeastBeads
  /// kappa of (kappa/2) integral of curvature^2 ds [M L^2/T^2], > 0; M is no mass per unit length.
  double bending_rigidity = 1;
  /// Viscosity of the fluid inside over that of the fluid outside [1], > 0.
  double viscosity_ratio = 1;
  double perimeter = 0;  ///< kept, with equal lengths between beads [L], > 0
  double area = 0;       ///< kept, of the fluid inside [L^2], > 0
};

/// With fewer beads the interpolation does not resolve an ellipse of reduced area 0.9.
inline constexpr std::int32_t kLeastBeads = 12;

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

/// Measures a membrane by the centres and the velocities of all particles, two numbers for each. In
/// a periodic domain the centre is that of the image in which its first bead is.
MembraneMeasures measure(const Membrane& membrane, const PeriodicCell& cell,
                         std::span<const double> positions, std::span<const double> velocities);

/// The rows of membranes.csv of all membranes of a state:
/// time,id,x,y,inclination,area,perimeter,membrane_speed,tank_treading_frequency.
std::string membrane_rows(const Setting& setting, const State& state,
                          std::span<const double> force_errors);
/// The names of these columns after time and id.
inline constexpr const char* kMembraneColumns =
    "x,y,inclination,area,perimeter,membrane_speed,tank_treading_frequency";

}  // namespace viscontact::particles
