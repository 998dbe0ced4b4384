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

/// Gap [L] of particles in a domain of this `size` for which none is asked: a twentieth of the
/// smallest radius, or less where the particles are so dense that, with half of it around them,
/// they would cover more than the mean of what they cover and of what random packings cover.
double default_gap(std::span<const double> radii, int dimension, double size);

/// Places new particles in the domain, a disc or a box, on the free side of all `planes`, which
/// count as walls. They are spheres if the box has three dimensions, otherwise discs. The particles
/// in `present` stay where they are, whatever gaps they have. Returns the coordinates of the new
/// centres [L], 2 or 3 for each particle, in the order of `asked.radii`.
///
/// All gaps of a new particle, to other particles (also across periodic sides) and to walls, are at
/// least `smallest_gap`.
///
/// 1. The particles are put, the largest first, at random places where their gaps are large enough
///    (random sequential addition, Widom 1966). A particle for which 1000 tries fail is put at any
///    random place.
/// 2. Particles that are too close are pushed apart until all gaps are large enough. If this fails,
///    step 1 is repeated, up to ten times with 20 million pushes in all.
/// 3. If all that fails, the particles are put at random places anew and repel each other until
///    they have their gaps or jam, as relax() does it, in up to 30 beginnings.
/// 4. Each particle is moved at random, on average 500 times, or 20 to 500 times if there are more
///    than 40 000 particles. A move is kept if the gaps stay large enough (Metropolis et al. 1953).
///
/// Where the particles move freely the arrangement is a sample of the equilibrium of hard discs or
/// spheres with this gap, of equal spheres above 0.49 of the fluid that has not crystallised. Dense
/// particles keep their neighbours in step 4: above a volume fraction of about 0.55 (of spheres
/// that are larger by half of the gap; discs of several sizes: 0.78) the arrangement is a random
/// packing and no sample of an equilibrium. Packings of spheres are isotropic, and of 1000 equal
/// spheres at 0.63 fewer than 1 % are in crystals. Equal discs crystallise in step 4 above 0.7.
///
/// Step 2 ends up to volume fractions of 0.6 to 0.62, step 3 up to 0.635 (equal spheres), 0.64
/// (radii 1 and 1.4, half of the volume each) or 0.835 (such discs) in periodic boxes. 10 000
/// spheres take 3 s at 0.55 and 8 s at 0.62, 1000 spheres less than a second at 0.6 and 5 s if step
/// 3 is needed. On every machine with IEEE 754 arithmetic the same arguments give the same bits,
/// because users repeat runs by their seeds.
///
/// Throws Error(kBadInput) if the particles do not fit, or if no arrangement is found, which can
/// happen although one exists: the message says which fraction of the domain was reached. The
/// caller adds file and line to the message. Throws std::bad_variant_access if `domain` is neither
/// a disc nor a box.
std::vector<double> arrange(const Arrangement& asked, const Domain& domain,
                            const Particles& present, std::span<const PlanePosition> planes = {});

}  // namespace viscontact::particles
