// Draws discs or spheres with random radii from species, which are kinds of particles.
// particles/case draws the particles of random arrangements, and source.hpp those that are added
// while a simulation runs. Lengths and masses are in the units of the case file. Nothing is checked
// or thrown here: particles/case checks the values, and values out of range give numbers without
// meaning. A change must keep the radii of each seed bit for bit, because users repeat runs by
// their seeds, and hash_of(), because restart files store its values.
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
    kList,      ///< not random: the radii of `list` in order, then again from the first
    kUniform,   ///< every radius from `from` to `to` is equally likely
    kLognormal  ///< the logarithm of the radius is normally distributed
  };
  Kind kind = Kind::kList;     ///< which of these distributions
  std::vector<double> list{};  ///< of kList [L], each > 0; not empty
  double from = 0,             ///< least radius of kUniform [L], > 0
      to = 0;                  ///< largest radius of kUniform [L], > `from`
  /// Median radius of kLognormal [L], > 0. The mean radius is median exp(sigma^2/2).
  double median = 0,
         sigma = 0;  ///< of kLognormal: standard deviation of the logarithm [1], 0 to 1
};

/// Particles of one kind.
struct Species {
  RadiusDistribution radius;  ///< of each particle
  double share = 1;           ///< [1], > 0; numbers of particles are in the ratio of the shares
  double mass = 0;            ///< of each particle [M], >= 0; used if `density` is 0
  /// Mass over the area of a disc [M/L^2] or the volume of a sphere [M/L^3], >= 0. If it is 0,
  /// `mass` is used.
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
  /// `dimension` is 2 for discs and 3 for spheres; `seed` is any number. `species` must not be
  /// empty, which is not checked: next() would read beyond its end.
  DrawnSpecies(std::vector<Species> species, int dimension, std::uint64_t seed);

  DrawnParticle next();  ///< the next particle; the sequence has no end

 private:
  std::vector<Species> species_;
  std::vector<std::size_t> counts_;  // particles of each species so far
  int dimension_;
  SplitMix64 random_;
};

/// The next `count` >= 0 particles of the sequence `species`.
std::vector<DrawnParticle> drawn(DrawnSpecies species, std::size_t count);

/// The next particles of the sequence `species`, as many as bring the sum of their areas (dimension
/// 2) or volumes (dimension 3) nearest to `size` [L^2, L^3], > 0, but at least 1 and at most
/// `largest_count` >= 1.
std::vector<DrawnParticle> drawn_to_size(DrawnSpecies species, int dimension, double size,
                                         std::size_t largest_count);

/// A hash of all numbers of `species`. With the seed and the dimension, they determine the radii
/// and masses that are drawn.
std::uint64_t hash_of(const std::vector<Species>& species);

}  // namespace viscontact::particles
