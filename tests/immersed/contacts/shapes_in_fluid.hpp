// Particles of any shape in a fluid, in a box whose floor is at y = 0.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/immersed/stand_in_fluid.hpp"
#include "viscontact/particles/shapes/shape_contacts.hpp"

namespace viscontact::particles {

constexpr double kGap = 0.02;  // the threshold gap

/// No particles yet, in a box of the width 20. `density` is that of the fluid.
inline InFluid with_shapes(double h, double density = 0) {
  auto system = in_fluid(2, 20, h, kGap);
  system.setting.fluid->density = density;
  return system;
}

/// The gap of particle 0.
inline double gap_to_floor(const FluidSimulation& simulation) {
  return gap(PlanePosition{{0, 0, 0}, {0, 1, 0}}, simulation.state().particles.placed_shape(0));
}

/// The sum of the forces on all walls in a step of the length h.
inline double force_of_walls(const FluidSimulation& simulation, double h) {
  double force = 0;
  for (const auto& pair : simulation.state().walls) force += pair.impulse / h;
  return force;
}

/// Expects that particle 0 lands on the floor before `end`, is held there by its smooth film, and
/// never sinks below the threshold gap; the gap may have the error `allowed`. Returns the largest
/// turn of a step.
inline double largest_turn_of_landing(FluidSimulation& simulation, double end, double allowed) {
  const double h = simulation.setting().time_step;
  bool has_landed = false;
  double largest_turn = 0;
  while (simulation.state().time < end - h / 2) {
    EXPECT_TRUE(simulation.step(100).converged);
    const double gap = gap_to_floor(simulation);
    EXPECT_GT(gap, kGap - allowed) << simulation.state().time;
    has_landed = has_landed || gap < kGap + allowed;
    if (has_landed) {
      EXPECT_LT(gap, kGap + allowed) << simulation.state().time;
    }
    largest_turn =
        std::max(largest_turn, h * std::abs(simulation.state().particles.angular_velocities[0]));
  }
  EXPECT_TRUE(has_landed);
  return largest_turn;
}

}  // namespace viscontact::particles
