// Sources, which add particles to a simulation while it runs, and their kinds of particles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// How the radii of a species are distributed.
struct RadiusDistribution {
  enum class Kind {
    kList,      ///< not random: the radii of `list` in order, then again from the first
    kUniform,   ///< every radius from `from` to `to` is equally likely
    kLognormal  ///< the logarithm of the radius is normally distributed
  };
  Kind kind = Kind::kList;
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

/// A box in which particles appear one after the other, at a constant rate. Due times and particles
/// of each seed are the same to the last bit, because users repeat runs by their seeds.
struct Source {
  std::vector<Species> species;   ///< kinds of particles, at least one, with masses > 0
  Vector from{};                  ///< lowest corner of the box in which centres are put [L]
  Vector to{};                    ///< highest corner of that box [L], >= `from` in each component
  Vector velocity{};              ///< of each particle when it is added [L/T]
  double rate = 0;                ///< [1/T], > 0
  double begin = 0;               ///< time of the first particle [T], >= 0
  double end = 0;                 ///< last time at which a particle is due [T], > `begin`
  std::size_t largest_count = 0;  ///< >= 1
  std::uint64_t seed = 1;         ///< of radii and places

  /// The number of particles that are due up to the time `time` [T]. It is 0 before `begin`, 1 at
  /// `begin`, grows by `rate` per time up to `largest_count`, and is constant after `end`.
  std::size_t due(double time) const;
};

}  // namespace viscontact::particles
