// The state at the start of a case of many particles. Lengths are in the unit of the case.
#pragma once

#include <vector>

#include "viscontact/case_file/particles_case.hpp"

namespace viscontact::case_file {

/// Throws the Error(kBadInput) of read_particles_case() for a start that the solver cannot take:
/// overlaps, particles behind a plane or too far away, and radii that are too small. `lines` are
/// the lines of the first particles in the particle file.
void check_start(const ParticlesCase& c, const std::vector<int>& lines);

}  // namespace viscontact::case_file
