// Chords at which overlapping discs of a rigid body are cut.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "viscontact/particles/setting/fluid.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {

struct Chord {
  std::size_t other = 0;  ///< number of the disc that overlaps it
  // The ends of the chord, at which the circles meet. The arc from `from` to `to`,
  // counter-clockwise, is inside the other disc.
  std::array<double, 2> from{},  ///< end at which the arc begins [L]
      to{};                      ///< end at which the arc ends [L]
  double middle = 0;             ///< angle from the x axis to the middle of this arc [rad]
  double half = 0;               ///< half of the angle of this arc [rad], > 0 and < pi
  double area = 0;               ///< area of the part of the disc beyond the chord [L^2], > 0
  /// Angle between the circles in the fluid outside both, where they meet [rad], > 0 and < pi. The
  /// less the discs overlap, the smaller it is.
  double wedge = 0;
};

/// The chord at which disc `other` cuts disc k; std::nullopt if their circles touch or do not meet.
/// Periodic images are not considered. If k and `other` are exchanged, the chord has the same two
/// ends, bit for bit.
std::optional<Chord> chord_of(const Particles& particles, std::size_t k, std::size_t other);

/// The chords at which other discs of its rigid body cut disc k, in the order of their `middle`,
/// without chords whose arc is within the arc of another chord; none for shapes that are not
/// round, and with RigidConstraint::kPenalty, with which discs may not overlap.
std::vector<Chord> chords_of(const Fluid& fluid, const Particles& particles, std::size_t k);

/// For each particle the sum of Chord::area over its chords_of() [L^2], for Fluid::cut_areas; empty
/// if all sums are 0.
std::vector<double> cut_areas_of(const Fluid& fluid, const Particles& particles);

}  // namespace viscontact::particles
