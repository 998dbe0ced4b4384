// Species of particles with random radii, for arrangements and for particles that are poured in.
// Lengths, masses and times are in the units of the case; nothing is thrown. A change must keep the
// radii of each seed bit for bit, because users repeat runs by their seeds.
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
    kLognormal  ///< the logarithm is normally distributed
  };
  Kind kind = Kind::kList;     ///< which one
  std::vector<double> list{};  ///< of kList [L], each > 0; not empty
  double from = 0,             ///< least radius of kUniform [L], > 0
      to = 0;                  ///< largest radius of kUniform [L], > `from`
  /// Median radius of kLognormal [L], > 0. The mean radius is median exp(sigma^2/2).
  double median = 0,
         sigma = 0;  ///< standard deviation of log r, of kLognormal, > 0
};

/// Particles of one kind.
struct Species {
  RadiusDistribution radius;  ///< of each particle
  double share = 1;  ///< part of the number of particles, > 0, relative to the other shares
  double mass = 0;   ///< of each particle [M]; used if density is 0
  /// Mass over the area of a disc [M/L^2], or over the volume of a sphere [M/L^3]; 0: `mass`.
  double density = 0;
};

/// A particle of a species.
struct DrawnParticle {
  double radius = 0;  ///< [L]
  double mass = 0;    ///< [M]
  /// True if both are equal.
  bool operator==(const DrawnParticle&) const = default;
};

/// The particles of some species one after the other. Of the first n particles, for every n, each
/// species has its share of n, rounded up or down. The radii are the same bits on every machine.
class DrawnSpecies {
 public:
  /// `dimension` is 2 for discs and 3 for spheres; `species` is not empty.
  DrawnSpecies(std::vector<Species> species, int dimension, std::uint64_t seed);

  DrawnParticle next();  ///< the next particle

 private:
  std::vector<Species> species_;
  std::vector<std::size_t> counts_;  // particles of each species so far
  int dimension_;
  SplitMix64 random_;
};

/// The first `count` particles.
std::vector<DrawnParticle> drawn(DrawnSpecies species, std::size_t count);

/// The first particles, at least 1 and at most `largest_count`: as many as bring the sum of their
/// areas or volumes nearest to `size` [L^2, L^3].
std::vector<DrawnParticle> drawn_to_size(DrawnSpecies species, int dimension, double size,
                                         std::size_t largest_count);

/// A hash of everything in the species that decides the radii and masses that they give with one
/// seed.
std::uint64_t hash_of(const std::vector<Species>& species);

}  // namespace viscontact::particles
