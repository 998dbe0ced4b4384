// The case of the benchmark box2d: discs or spheres fall into a box. Lengths, masses and times are
// in one unit each. The times in bench/README.md are those of this case.
#pragma once

#include "viscontact/contact_dynamics/simulation.hpp"

namespace viscontact::particles {

/// `count` discs (dimension 2) or spheres (dimension 3) at rest on a lattice of spacing 2.1 that is
/// as wide as the box. Each is displaced at random by up to 0.05 along each axis. Radii r are
/// random from 0.8 to 1, and masses are r^2 or r^3.
State particles_in_box(int count, int dimension = 2);

/// A floor and two or four walls that enclose a square or cube of the width 2.1 ceil(count^(1/2))
/// or 2.1 ceil(count^(1/3)). Gravity is 1, the time step 0.05 and gamma_min -2.
Setting box(int count, int dimension = 2);

}  // namespace viscontact::particles
