// Species: kinds of discs or spheres with random radii. particles/case draws the particles of
// random arrangements from them, and source.hpp those that are added while a simulation runs.
// Lengths and masses are in the units of the case file. Nothing is checked or thrown here;
// particles/case checks the values. A change must keep the radii of each seed bit for bit, because
// users repeat runs by their seeds, and hash_of(), because restart files store its values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/common/splitmix.hpp"

namespace viscontact::particles {

/// How the radii of a species are distributed.
struct RadiusDistribution {
  /// The distributions.
  enum class Kind {
    kList,      ///< the radii of `list`, one after the other, then again from the first
    kUniform,   ///< every radius from `from` to `to` is equally likely
    kLognormal  ///< the logarithm of the radius is normally distributed
  };
  Kind kind = Kind::kList;     ///< which of these distributions
  std::vector<double> list{};  ///< of kList [L], each > 0; not empty
  double from = 0,             ///< least radius of kUniform [L], > 0
      to = 0;                  ///< largest radius of kUniform [L], > `from`
  /// Median radius of kLognormal [L], > 0. The mean radius is median exp(sigma^2/2).
  double median = 0,
         sigma = 0;  ///< standard deviation of the logarithm of the radius, of kLognormal, 0 to 1
};

/// Particles of one kind.
struct Species {
  RadiusDistribution radius;  ///< of each particle
  double share = 1;           ///< > 0; the numbers of particles are in the ratio of the shares
  double mass = 0;            ///< of each particle [M], >= 0; used if `density` is 0
  /// Mass over the area of a disc [M/L^2] or volume of a sphere [M/L^3]; 0: `mass` is used.
  double density = 0;
};

/// A particle that was drawn from a species.
struct DrawnParticle {
  double radius = 0;  ///< [L], > 0
  double mass = 0;    ///< [M], >= 0
  /// True if both are equal.
  bool operator==(const DrawnParticle&) const = default;
};

/// Draws particles of several species one after the other. Among the first n particles, for every
/// n, the number of particles of each species is its share of n, rounded up or down.
class DrawnSpecies {
 public:
  /// `dimension` is 2 for discs and 3 for spheres; `species` must not be empty (not checked, next()
  /// would read beyond its end); any seed.
  DrawnSpecies(std::vector<Species> species, int dimension, std::uint64_t seed);

  DrawnParticle next();  ///< the next particle; the sequence has no end

 private:
  std::vector<Species> species_;
  std::vector<std::size_t> counts_;  // particles of each species so far
  int dimension_;
  SplitMix64 random_;
};

/// The next `count` >= 0 particles of a sequence.
std::vector<DrawnParticle> drawn(DrawnSpecies species, std::size_t count);

/// The next particles of a sequence, as many as bring the sum of their areas (dimension 2) or
/// volumes (3) nearest to `size` [L^2, L^3], but at least 1 and at most `largest_count` >= 1.
std::vector<DrawnParticle> drawn_to_size(DrawnSpecies species, int dimension, double size,
                                         std::size_t largest_count);

/// A hash of all numbers on which the radii and masses that a seed gives depend.
std::uint64_t hash_of(const std::vector<Species>& species);

}  // namespace viscontact::particles
