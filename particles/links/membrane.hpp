// Membranes of a case, closed lines through particles (their beads) that keep the length of each
// part, docs/physics.md, section 8.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <vector>

namespace viscontact::particles {

/// A membrane, in the units of the case; in a fluid masses and forces are per length of the third
/// dimension. In a fluid the line is the trigonometric interpolation of the centres of the beads,
/// with bead k of N at the parameter 2 pi k/N; without a fluid it is a polygon.
struct Membrane {
  /// Numbers of the particles that are its beads, counter-clockwise around the area inside; at
  /// least kLeastBeads in a fluid, 4 without one.
  std::vector<std::int32_t> beads;
  /// The factor kappa of the bending energy, kappa/2 times the integral of curvature^2 along the
  /// line [M L^3/T^2], in a fluid per length [M L^2/T^2]; > 0 in a fluid, >= 0 without one.
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

  bool resists_bending() const { return bending_rigidity > 0 || bending_viscosity > 0; }
  /// Takes the particles `first` to `first` + `count` - 1 as its beads.
  void set_beads(std::int32_t first, std::int32_t count) {
    assert(first >= 0 && count >= 0);
    beads.resize(static_cast<std::size_t>(count));
    std::iota(beads.begin(), beads.end(), first);
  }
  std::int32_t count() const { return static_cast<std::int32_t>(beads.size()); }
  /// Number of the particle that is bead k, where k is any whole number, taken modulo count().
  std::int32_t bead(std::int32_t k) const {
    assert(!beads.empty());
    return beads[static_cast<std::size_t>(((k % count()) + count()) % count())];
  }
  bool has(std::int32_t particle) const {
    return std::ranges::find(beads, particle) != beads.end();
  }
};

/// Least number of beads in a fluid. With fewer beads the interpolation does not resolve an ellipse
/// of the reduced area 4 pi area/perimeter^2 = 0.9.
inline constexpr std::int32_t kLeastBeads = 12;

}  // namespace viscontact::particles
