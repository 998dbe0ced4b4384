// The particles of a simulation: rigid discs or spheres that do not turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Flat arrays; particle k is entry k of each, and entries dimension * k, ... of positions and velocities.
struct Particles {
  int dimension = 2;               ///< 2: discs, 3: spheres
  std::vector<double> positions;   ///< of the centres [L]
  std::vector<double> velocities;  ///< [L/T]
  std::vector<double> radii;       ///< [L], > 0
  std::vector<double> masses;      ///< [M], > 0
  /// The name of each particle in files, >= 0, no two equal; empty: particle k is named k.
  std::vector<std::int32_t> ids{};

  std::size_t count() const { return radii.size(); }
  std::int32_t id(std::size_t k) const {
    return ids.empty() ? static_cast<std::int32_t>(k) : ids[k];
  }
  Vector position(std::size_t k) const { return point_of(positions.data(), k, dimension); }
  Vector velocity(std::size_t k) const { return point_of(velocities.data(), k, dimension); }
};

/// The radius that residuals and overlaps are measured by [L]; 1 without particles.
inline double mean_radius(const Particles& particles) {
  if (particles.count() == 0) return 1;
  double sum = 0;
  for (const double radius : particles.radii) sum += radius;
  return sum / static_cast<double>(particles.count());
}

}  // namespace viscontact::particles
