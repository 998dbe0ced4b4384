// Random arrangements of discs or spheres without overlaps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {

/// The particles that are to be placed, and the gaps that they must have.
struct Arrangement {
  std::vector<double> radii;  ///< of the particles [L], > 0; at least one
  double smallest_gap = 0;    ///< between two particles, or a particle and a wall [L], >= 0
  /// The same seed gives the same arrangement, bit for bit.
  std::uint64_t seed = 1;
};

/// Sum of the areas [L^2] of the particles if `dimension` is 2, or of their volumes [L^3] if it is
/// 3.
double size_of(const Arrangement& asked, int dimension);

/// Places new particles in the domain, a disc or a box, on the free side of all `planes`, which
/// count as walls. They are spheres if the box has three dimensions, otherwise discs. The particles
/// in `present` stay where they are, whatever gaps they have. Returns the coordinates of the new
/// centres [L], 2 or 3 for each particle, in the order of `asked.radii`.
///
/// All gaps of a new particle, to other particles (also across periodic sides) and to walls, are at
/// least `smallest_gap`. The arrangement is a sample of the equilibrium of hard discs or spheres
/// with this gap, as far as a Monte Carlo simulation of a limited number of moves reaches it:
///
/// 1. The particles are put, the largest first, at random places where their gaps are large enough
///    (random sequential addition, Widom 1966). A particle for which 1000 tries fail is put at any
///    random place.
/// 2. Particles that are too close are pushed apart until all gaps are large enough.
/// 3. Each particle is moved at random, on average 500 times, or 20 to 500 times if there are more
///    than 40 000 particles. A move is kept if the gaps stay large enough (Metropolis et al. 1953).
///
/// 1000 equal discs in a periodic box, with gaps of 0.05 radii and an area fraction of 0.6, take
/// less than a second. On every machine with IEEE 754 arithmetic the same arguments give the same
/// bits, because users repeat runs by their seeds.
///
/// Throws Error(kBadInput) if the particles do not fit, or if step 2 fails for ten random
/// arrangements of step 1, which can happen although an arrangement with these gaps exists; the
/// caller adds file and line to the message. Throws std::bad_variant_access if `domain` is neither
/// a disc nor a box.
std::vector<double> arrange(const Arrangement& asked, const Domain& domain,
                            const Particles& present, std::span<const PlanePosition> planes = {});

}  // namespace viscontact::particles
