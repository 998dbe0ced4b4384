// Random arrangements of equal discs that do not overlap, in the domain of a case. Lengths are in
// the unit of the case. Cases and sweeps of particles call it. A change must keep the arrangement
// of each seed bit for bit, because users repeat runs by their seeds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// What is asked of an arrangement.
struct Arrangement {
  std::size_t count = 0;    ///< number of discs, >= 1
  double radius = 0;        ///< r of each disc [L], > 0
  double smallest_gap = 0;  ///< least gap of two discs, and of a disc and a wall [L], >= 0
  /// Seed of the random numbers: the same seed gives the same arrangement, bit for bit.
  std::uint64_t seed = 1;
};

/// Area of a disc or a box [L^2]; 0 for any other domain.
double area_of(const Domain& domain);

/// The number of discs of this radius [L] whose area is nearest to `fraction` of the area of the
/// domain, which must be a disc or a box. At least 1. The fraction is in (0, 1).
std::size_t count_of(double fraction, double radius, const Domain& domain);

/// Places new discs in the domain, which must be a disc or a box; sides that are periodic are no
/// walls. Returns x and y of each new disc, in the order of their numbers.
///
/// The gaps between two discs, also across periodic sides, between a disc and a particle of
/// `present`, and between a disc and a wall are at least `smallest_gap`. The arrangement is a
/// sample of the equilibrium of hard discs with this gap (all arrangements are equally likely), as
/// far as a Monte Carlo simulation of a limited number of moves reaches it:
///
/// 1. Each disc is put at a random place where it has its gaps (random sequential addition, Widom
///    1966), or anywhere if 1000 tries fail.
/// 2. Discs that are too close are pushed apart until all gaps are large enough.
/// 3. Each disc is moved at random some hundred times. A move is kept if the gaps stay large enough
///    (Metropolis et al. 1953).
///
/// In a periodic box with gaps of 0.05 r, area fractions of 0.6 need less than a second for 1000
/// discs. The result depends on the arguments alone, bit for bit, with arithmetic of IEEE 754.
///
/// Throws Error(kBadInput) if the discs do not fit or no arrangement is found. The message has no
/// place; it names the number of discs and their area fraction.
std::vector<double> arrange(const Arrangement& asked, const Domain& domain,
                            const Particles& present);

}  // namespace viscontact::particles
