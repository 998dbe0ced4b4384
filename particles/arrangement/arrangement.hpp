// Random arrangements of discs or spheres that do not overlap, in a disc or a box. Lengths are in
// the unit of the case file. particles/case places the particles of a case file with it, and
// particles/sweep reports their area fraction. Particles for which no places are found throw
// Error(kBadInput). Radii and gaps are not checked. A change must keep the arrangement of each seed
// bit for bit, because users repeat runs by their seeds.
#pragma once

#include <cstdint>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// The particles that are to be placed, and the gaps that they must have.
struct Arrangement {
  std::vector<double> radii;  ///< of the particles [L], > 0; at least one (not checked)
  double smallest_gap = 0;    ///< between two particles, and between one and a wall [L], >= 0
  /// Seed of the random numbers: the same seed gives the same arrangement, bit for bit.
  std::uint64_t seed = 1;
};

/// Sum of the areas (dimension 2) [L^2] or volumes (3) [L^3] of the particles of an arrangement.
double size_of(const Arrangement& asked, int dimension);

/// Places new particles in the domain, which must be a disc or a box; periodic sides are no walls.
/// They are spheres if the box has three dimensions, otherwise discs. `present` are the particles
/// that are in the domain already and stay where they are; gaps among them are not checked. Returns
/// the coordinates of the new centres [L], 2 or 3 for each particle, in the order of `asked.radii`.
///
/// All gaps of a new particle, to other particles (also across periodic sides) and to walls, are at
/// least `smallest_gap`. The arrangement is a sample of the equilibrium of hard discs or spheres
/// with this gap (all arrangements are equally likely), as far as a Monte Carlo simulation of a
/// limited number of moves reaches it:
///
/// 1. Each particle, the largest first, is put at a random place where its gaps are large enough
///    (random sequential addition, Widom 1966), or at any random place if 1000 tries fail.
/// 2. Particles that are too close are pushed apart until all gaps are large enough.
/// 3. Each particle is moved at random, on average 500 times, or 20 to 500 times if there are more
///    than 40 000. A move is kept if the gaps stay large enough (Metropolis et al. 1953).
///
/// 1000 equal discs in a periodic box, with gaps of 0.05 radii and an area fraction of 0.6, take
/// less than a second. On every machine with IEEE 754 arithmetic the same arguments give the same
/// bits.
///
/// Throws Error(kBadInput) if the particles do not fit, or if step 2 fails for ten random
/// beginnings, which can happen although an arrangement exists. The message has the number of
/// particles and their area or volume fraction; the caller adds file and line. Throws
/// std::bad_variant_access if `domain` is neither a disc nor a box.
std::vector<double> arrange(const Arrangement& asked, const Domain& domain,
                            const Particles& present);

}  // namespace viscontact::particles
