// The pair distribution of the spheres of a suspension, from the frames of a run.
#pragma once

#include <vector>

#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particle_runs/io/playback.hpp"
#include "viscontact/particle_runs/io/rheology_file.hpp"

namespace viscontact::particles {

/// The mean over the frames from average_from on, without that of the start, or of the only frame.
/// Empty if the case has no box, or fewer than two spheres.
std::vector<PairDistributionRow> pair_distribution(const ParticlesCase& c,
                                                   const Playback& playback);

}  // namespace viscontact::particles
