// The case of the benchmark box2d, for its test and for bench/box2d.cpp.
#pragma once

#include "viscontact/particles/simulation.hpp"

namespace viscontact::particles {

/// `count` discs on a lattice of spacing 2.1, jitter +-0.05, radii 0.8 to 1, m = r^2, at rest.
State box_of_discs(int count);

/// Floor and two walls, 2.1 ceil(sqrt count) apart; g = 1, h = 0.05, gamma_min = -2.
Setting box(int count);

}  // namespace viscontact::particles
