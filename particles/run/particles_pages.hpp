// The page and the picture of a run of many particles, which are made from the files of the run, in
// the units of the case. The commands `particles` and `report` call it. A change must keep that
// frames of earlier versions can be drawn.
#pragma once

#include <filesystem>

#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::particles {

/// Writes particles.html and particles.svg from the frames and flows that a run of the case has
/// written into `folder`, if need be from every 2nd, 4th, ... frame, so that memory is bounded.
/// Throws Error(kBadInput), which names the file, if a file cannot be read or written or has other
/// particles.
void write_pages(const ParticlesCase& c, const std::filesystem::path& folder,
                 const results::Provenance& provenance);

/// As write_pages(), for a run that has ended or was interrupted. `folder` has its frames and says
/// where the case is. The case and its file of particles must not have changed since. Throws
/// Error(kBadInput) if a file is missing or damaged.
void report_particles(const std::filesystem::path& folder);

}  // namespace viscontact::particles
