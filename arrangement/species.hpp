// Particles with random radii from species, which are kinds of particles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/common/splitmix.hpp"
#include "viscontact/particles/setting/source.hpp"

namespace viscontact::particles {

struct DrawnParticle {
  double radius = 0;  ///< [L], > 0
  double mass = 0;    ///< [M], >= 0
  bool operator==(const DrawnParticle&) const = default;
};

/// Draws particles of several species one after the other. Among the first n particles, for every
/// n, the number of particles of each species is its share of n, rounded up or down. The radii of
/// each seed are the same to the last bit, because users repeat runs by their seeds.
class DrawnSpecies {
 public:
  /// `dimension` is 2 for discs and 3 for spheres; there is at least one species.
  DrawnSpecies(std::vector<Species> species, int dimension, std::uint64_t seed);

  DrawnParticle next();  ///< the sequence has no end

 private:
  std::vector<Species> species_;
  std::vector<std::size_t> counts_;  // particles of each species so far
  int dimension_;
  SplitMix64 random_;
};

/// The next `count` particles of the sequence.
std::vector<DrawnParticle> drawn(DrawnSpecies species, std::size_t count);

/// The next particles of the sequence, as many as bring the sum of their areas (dimension 2) or
/// volumes (dimension 3) nearest to `size` [L^2, L^3], but at least 1 and at most `largest_count`.
std::vector<DrawnParticle> drawn_to_size(DrawnSpecies species, int dimension, double size,
                                         std::size_t largest_count);

/// A hash of all numbers of `species`, which determine, with the seed and the dimension, the radii
/// and masses that are drawn. Restart files store it, so that a run that continues can see whether
/// its species are the same.
std::uint64_t hash_of(const std::vector<Species>& species);

}  // namespace viscontact::particles
