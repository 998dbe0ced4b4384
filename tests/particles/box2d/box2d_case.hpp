// The case of the benchmark box2d, for its test and for bench/box2d.cpp: discs fall into a box.
// Lengths, masses and times are in one unit each. A change makes the times of bench/README.md
// incomparable.
#pragma once

#include "viscontact/particles/simulation.hpp"

namespace viscontact::particles {

/// `count` discs at rest on a lattice of spacing 2.1, each displaced at random by up to 0.05 along
/// each axis. Radii are random from 0.8 to 1, and the mass of a disc is the square of its radius.
State box_of_discs(int count);

/// A floor and two walls, 2.1 ceil(sqrt count) apart, with gravity 1, time step 0.05 and gamma_min
/// = -2.
Setting box(int count);

}  // namespace viscontact::particles
