// Quantities of the fluid that depend on time.
#include "viscontact/particles/setting/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscontact::particles {

namespace {

/// The factor of a velocity or pressure gradient that oscillates; 1 if `period` is 0.
double pulsation(double period, double amplitude, double time) {
  return period > 0 ? 1 + amplitude * std::sin(2 * std::numbers::pi * time / period) : 1;
}

}  // namespace

std::array<double, 2> WallVelocity::at(double time, double from, double to) const {
  auto velocity = value;
  if (!pieces.pieces.empty()) {
    const auto now = to > from ? pieces.mean(from, to) : pieces.value(time);
    velocity = {now[0], now[1]};
  }
  for (auto& component : velocity) component *= pulsation(period, amplitude, time);
  return velocity;
}

std::array<double, 2> Fluid::pressure_gradient_at(double time) const {
  const double factor = pulsation(gradient_period, gradient_amplitude, time);
  return {factor * pressure_gradient[0], factor * pressure_gradient[1]};
}

bool Fluid::are_of_one_membrane(std::int32_t first, std::int32_t second) const {
  return std::ranges::any_of(membranes, [&](const Membrane& membrane) {
    return membrane.has(first) && membrane.has(second);
  });
}

}  // namespace viscontact::particles
