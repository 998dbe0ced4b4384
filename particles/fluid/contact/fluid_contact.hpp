// A contact of particles in a fluid, and the gap and force that it stands for. Lengths, masses and
// times are in the units of the case.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Two particles, or a particle and an obstacle, whose gap may close in this step.
struct FluidContact {
  std::int32_t first = -1;  ///< number of a particle; -1: an obstacle
  std::int32_t second = 0;  ///< number of a particle
  Vector normal{};          ///< unit normal from first to second
  double gap = 0;           ///< D - D_c at the beginning of the step [L]
  /// Velocity at which the gap opens because `second` is an image, which a mean flow moves relative
  /// to the particle [L/T]: the part along `normal` of velocity_of_image().
  double image_opening = 0;
  double gamma = 0;  ///< [M L/T], of discs [M/T], <= 0: the impulse is at least this
  /// h lambda, in the unit of gamma: before the solution a guess, then the solution.
  double impulse = 0;
  /// Change of the gap per impulse of this contact [T/M]; 0 as long as the contact takes no part.
  double w = 0;
};

/// The place of the components of motions, velocities or forces of a particle in an array.
struct MotionLayout {
  std::size_t components = 3;  ///< motion_components()
  /// Number of components of a contact's normal.
  std::size_t directions() const { return components == 1 ? 1 : 2; }
  /// Place of component `d` of particle `k`, both from 0.
  std::size_t at(std::int32_t k, std::size_t d) const {
    return static_cast<std::size_t>(k) * components + d;
  }
};

/// G v: the velocity at which the gap opens [L/T], for the velocities of all particles.
inline double opening(const FluidContact& contact, const double* velocities,
                      const MotionLayout& layout) {
  double sum = 0;
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    sum += contact.normal[d] * velocities[layout.at(contact.second, d)];
    if (contact.first >= 0) sum -= contact.normal[d] * velocities[layout.at(contact.first, d)];
  }
  return sum;
}

/// Linearised gap D - D_c + h G v at the end of a step of length h [L].
inline double gap_after(const FluidContact& contact, const double* velocities, double h,
                        const MotionLayout& layout) {
  return contact.gap + h * (contact.image_opening + opening(contact, velocities, layout));
}

/// The largest speed of a particle [L/T], without its turning, which changes no gap.
inline double fastest(std::span<const double> velocities, const MotionLayout& layout) {
  double largest = 0;
  for (std::size_t k = 0; k < velocities.size(); k += layout.components) {
    double square = 0;
    for (std::size_t d = 0; d < layout.directions(); ++d)
      square += velocities[k + d] * velocities[k + d];
    largest = std::max(largest, std::sqrt(square));
  }
  return largest;
}

/// Adds G^T force to the forces of all particles [M L/T^2]. A positive force pushes both apart.
inline void add_contact_force(const FluidContact& contact, double force, std::span<double> forces,
                              const MotionLayout& layout) {
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    forces[layout.at(contact.second, d)] += contact.normal[d] * force;
    if (contact.first >= 0) forces[layout.at(contact.first, d)] -= contact.normal[d] * force;
  }
}

}  // namespace viscontact::particles
