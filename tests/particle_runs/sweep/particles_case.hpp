// A small case of many particles for tests of sweeps.
#pragma once

#include <string>

namespace viscontact {

/// The text of a case with a few steps of discs that move through a periodic box and meet. `more`
/// is added at the end.
inline std::string small_particles_case(const std::string& more = "") {
  return R"(title = "Discs in a box"
[space]
dimension = 2
gravity = [0.0, -20.0]
[domain]
box = { from = [0.0, 0.0], to = [10.0, 8.0], periodic = [true, false] }
[viscous_contact]
time_step = 0.05
end_time = 0.5
gamma_min = -1.0
[arrangement]
area_fraction = 0.3
radius = 0.5
mass = 1.0
seed = 5
)" + more;
}

}  // namespace viscontact
