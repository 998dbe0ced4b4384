// A check of the state at the start of a case of many particles.
#pragma once

#include <vector>

#include "viscontact/case_file/particles_case.hpp"

namespace viscontact::case_file {

/// Throws the Error(kBadInput) of read_particles_case() if the solver cannot begin with this state:
/// overlaps, particles behind a plane or too far away, and radii that are too small. `lines` are
/// the line numbers of the particles of the CSV file, which are the first ones.
void check_start(const ParticlesCase& c, const std::vector<int>& lines);

}  // namespace viscontact::case_file
