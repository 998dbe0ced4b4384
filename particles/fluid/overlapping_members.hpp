// Discs of a rigid body that overlap, in a fluid in the plane: the body is their union. Each disc
// is cut along the chords at which its circle meets those of the others, so that the cut discs
// cover the union once. Lengths are in the unit of the case. Checks of a case, sizes and the mesh
// use it. Nothing is checked or thrown. A change must keep that the cut discs together have the
// area of the union.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// How a disc is cut by one that overlaps it.
struct Chord {
  std::size_t other = 0;  ///< number of the disc that overlaps it
  // The ends of the chord, at which the circles meet. The arc from `from` to `to`, counter-clockwise,
  // is inside the other disc.
  std::array<double, 2> from{},  ///< first end [L]
      to{};                      ///< last end [L]
  double middle = 0;             ///< angle of the middle of this arc with the x axis [rad]
  double half = 0;               ///< half of the angle of this arc [rad], > 0 and < pi
  double area = 0;               ///< of the disc beyond the chord [L^2]
  /// Angle of the wedge of fluid where the circles meet [rad], > 0 and < pi: the smaller, the more
  /// shallow the overlap.
  double wedge = 0;
};

/// The chord at which the disc `other` cuts the disc k; none if their circles do not meet. Both must
/// not be images of each other. The ends of the chord are the same numbers for both discs.
std::optional<Chord> chord_of(const Particles& particles, std::size_t k, std::size_t other);

/// The chords at which discs of its body cut disc k in this fluid, by their angle `middle` from -pi to pi,
/// without those whose arc is within that of another one. None if particle k is an ellipse or plate,
/// which have no chords, and by penalty, where discs may not overlap.
std::vector<Chord> chords_of(const Fluid& fluid, const Particles& particles, std::size_t k);

/// Fluid::cut_areas for these particles [L^2]: of each one the sum of the areas beyond its chords.
std::vector<double> cut_areas_of(const Fluid& fluid, const Particles& particles);

}  // namespace viscontact::particles
