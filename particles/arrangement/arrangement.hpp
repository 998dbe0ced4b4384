// Random arrangements of discs or spheres that do not overlap, in the domain of a case. Lengths are
// in the unit of the case. Cases and sweeps of particles call it. A change must keep the
// arrangement of each seed bit for bit, because users repeat runs by their seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// The particles that are to be placed, and the gaps that they must have.
struct Arrangement {
  std::vector<double> radii;  ///< of the particles [L], > 0; at least one
  double smallest_gap = 0;    ///< least gap of two particles, and of one and a wall [L], >= 0
  /// Seed of the random numbers: the same seed gives the same arrangement, bit for bit.
  std::uint64_t seed = 1;
};

/// Area or volume of the particles of an arrangement [L^2, L^3].
double size_of(const Arrangement& asked, int dimension);

/// Places new particles in the domain, which must be a disc or a box; sides that are periodic are
/// no walls. They are spheres if the box has three dimensions, otherwise discs. Returns the
/// coordinates of each, in the order of `asked.radii`.
///
/// The gaps between two particles, also across periodic sides, between one and a particle of
/// `present`, and between one and a wall are at least `smallest_gap`. The arrangement is a sample
/// of the equilibrium of hard discs or spheres with this gap (all arrangements are equally likely),
/// as far as a Monte Carlo simulation of a limited number of moves reaches it:
///
/// 1. Each particle, the largest first, is put at a random place where it has its gaps (random
///    sequential addition, Widom 1966), or anywhere if 1000 tries fail.
/// 2. Particles that are too close are pushed apart until all gaps are large enough.
/// 3. Each particle is moved at random some hundred times. A move is kept if the gaps stay large
///    enough (Metropolis et al. 1953).
///
/// 1000 equal discs in a periodic box, with gaps of 0.05 radii and an area fraction of 0.6, take
/// less than a second. The result depends on the arguments alone, bit for bit, with arithmetic of
/// IEEE 754.
///
/// Throws Error(kBadInput) if the particles do not fit or no arrangement is found. The message
/// names the number of particles and their area or volume fraction, but no file and line, which the
/// caller knows.
std::vector<double> arrange(const Arrangement& asked, const Domain& domain,
                            const Particles& present);

}  // namespace viscontact::particles
