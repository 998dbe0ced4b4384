// Velocities of walls that depend on time, and sizes of particles (fluid.hpp).
#include "viscontact/particles/fluid.hpp"

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

double Fluid::size_of(int dimension, std::size_t k, double radius) const {
  if (is_ellipse(k)) return std::numbers::pi * semi_axes[k][0] * semi_axes[k][1];
  return size_of_particle(dimension, radius);
}

}  // namespace viscontact::particles
