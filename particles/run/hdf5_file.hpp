// One HDF5 file of all frames of a run, for readers that do not use VTK (docs/file-formats.md,
// "HDF5"). Numbers are in the units of the case. libhdf5 is optional. A change must keep names and
// layout of the data sets, because users' scripts read them.
#pragma once

#include <filesystem>

#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::particles {

/// Throws Error(kWrongUsage), which says what to install, if this program was built without
/// libhdf5.
void require_hdf5();

/// Writes `folder`/particles.h5 from the frames that `folder`/particles.pvd lists, one after the
/// other, so that the memory of two frames is enough. At any time, also after a power cut, the
/// folder has an earlier file or the whole new one (write_file_by). Throws Error(kBadInput) if a
/// frame is missing or damaged, or if the file cannot be written, and the error of require_hdf5().
void write_hdf5(const ParticlesCase& c, const std::filesystem::path& folder,
                const results::Provenance& provenance);

}  // namespace viscontact::particles
