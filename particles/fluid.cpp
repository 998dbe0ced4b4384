// Velocities of walls that depend on time (fluid.hpp).
#include "viscontact/particles/fluid.hpp"

#include <cmath>
#include <numbers>

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

}  // namespace viscontact::particles
