// Computes velocities of walls [L/T] and pressure gradients [M/(L^2 T^2)] that depend on time,
// areas [L^2] or, on an axis, volumes [L^3], and moments of inertia [M L^2] of particles, in the
// units of the case; in the plane M is a mass per length. Times are >= 0, radii and semi-axes
// [L] > 0, masses >= 0; a period of 0 means that the quantity does not oscillate. Particles are
// numbered from 0. Nothing is checked or thrown. A change must keep means of pieces over a step
// exact, so that as much fluid flows in as the case says. case/, fluid/, membranes/ and
// freefem_flow/ use this file.
#include "viscontact/particles/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

namespace {

/// The factor 1 + amplitude sin(2 pi time/period) of a velocity or pressure gradient; 1 if `period`
/// is 0. `amplitude` [1] is any number.
double pulsation(double period, double amplitude, double time) {
  return period > 0 ? 1 + amplitude * std::sin(2 * std::numbers::pi * time / period) : 1;
}

}  // namespace

/// The velocity of the wall [L/T] at `time`: x and y. If the velocity is a parabola along the wall,
/// the first number is the speed in its middle, and the second one is not used. If the velocity is
/// given in pieces of time and `to` > `from`, the mean of the pieces between both times takes the
/// place of the piece at `time`.
std::array<double, 2> WallVelocity::at(double time, double from, double to) const {
  auto velocity = value;
  if (!pieces.pieces.empty()) {
    const auto now = to > from ? pieces.mean(from, to) : pieces.value(time);
    velocity = {now[0], now[1]};
  }
  for (auto& component : velocity) component *= pulsation(period, amplitude, time);
  return velocity;
}

/// The uniform pressure gradient at `time`, x and y.
std::array<double, 2> Fluid::pressure_gradient_at(double time) const {
  const double factor = pulsation(gradient_period, gradient_amplitude, time);
  return {factor * pressure_gradient[0], factor * pressure_gradient[1]};
}

/// True if one membrane contains both particles.
bool Fluid::are_of_one_membrane(std::int32_t first, std::int32_t second) const {
  return std::ranges::any_of(membranes, [&](const Membrane& membrane) {
    return membrane.has(first) && membrane.has(second);
  });
}

/// The area [L^2] of particle `k` without the part that counts for another disc of its body, or, if
/// `dimension` is 1, the volume [L^3] of a sphere. `radius` [L] is used for discs and spheres only.
double Fluid::size_of(int dimension, std::size_t k, double radius) const {
  if (is_plate(k)) return size_of_plate(semi_axes[k]);
  if (is_ellipse(k)) return size_of_ellipse(semi_axes[k]);
  return size_of_particle(dimension, radius) - (cut_areas.empty() ? 0 : cut_areas[k]);
}

/// The moment of inertia [M L^2] of particle `k` in the plane, whose mass `mass` [M] is evenly
/// distributed. `radius` [L] is used for discs only.
double Fluid::homogeneous_inertia_of(std::size_t k, double mass, double radius) const {
  if (is_plate(k)) return homogeneous_inertia_of_plate(mass, semi_axes[k]);
  return is_ellipse(k) ? homogeneous_inertia_of_ellipse(mass, semi_axes[k])
                       : homogeneous_inertia(2, mass, radius);
}

}  // namespace viscontact::particles
