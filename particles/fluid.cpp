// Velocities of walls that depend on time, and sizes and moments of inertia of particles
// (fluid.hpp), in the units of the case. Nothing is checked or thrown. A change must keep the mean
// over a step exact, so that walls move as far as the case says.
#include "viscontact/particles/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

std::array<double, 2> WallVelocity::at(double time, double from, double to) const {
  auto velocity = value;
  if (!pieces.pieces.empty()) {
    const auto now = to > from ? pieces.mean(from, to) : pieces.value(time);
    velocity = {now[0], now[1]};
  }
  if (period > 0) {
    const double factor = 1 + amplitude * std::sin(2 * std::numbers::pi * time / period);
    for (auto& component : velocity) component *= factor;
  }
  return velocity;
}

bool Fluid::are_of_one_membrane(std::int32_t first, std::int32_t second) const {
  return std::ranges::any_of(membranes, [&](const Membrane& membrane) {
    return membrane.has(first) && membrane.has(second);
  });
}

double Fluid::size_of(int dimension, std::size_t k, double radius) const {
  return is_ellipse(k) ? size_of_ellipse(semi_axes[k]) : size_of_particle(dimension, radius);
}

double Fluid::homogeneous_inertia_of(std::size_t k, double mass, double radius) const {
  return is_ellipse(k) ? homogeneous_inertia_of_ellipse(mass, semi_axes[k])
                       : homogeneous_inertia(2, mass, radius);
}

}  // namespace viscontact::particles
