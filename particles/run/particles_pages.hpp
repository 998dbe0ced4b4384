// Writes the page, the picture and the HDF5 file of a run of many particles from the files of the
// run, in the units of the case. The commands `particles` and `report` call it. A file that is
// missing, damaged or cannot be written throws Error(kBadInput), a program without libhdf5
// Error(kWrongUsage). A change must keep that frames of earlier versions can be drawn, and the
// names and layout of the data sets in the HDF5 file (docs/file-formats.md, "HDF5"), because users'
// scripts read them.
#pragma once

#include <filesystem>

#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::particles {

/// Writes particles.html and particles.svg from the frames (states at the output times) and flows
/// that a run of the case has written into `folder`. For a long run only every 2nd, 4th, ... frame
/// is used, so that the memory is bounded. `provenance` is stored in both files. Throws
/// Error(kBadInput), which names the file, if a file cannot be read or written or has other
/// particles than the case, or if there is no frame.
void write_pages(const ParticlesCase& c, const std::filesystem::path& folder,
                 const results::Provenance& provenance);

/// Does the same for a run that has ended or was interrupted: the files in `folder` say where the
/// case is. Throws Error(kBadInput) if a file is missing or damaged, or if the case or its file of
/// particles has changed since the run.
void report_particles(const std::filesystem::path& folder);

/// Throws Error(kWrongUsage), which says what to install, if this program was built without
/// libhdf5.
void require_hdf5();

/// Writes `folder`/particles.h5 from the frames that `folder`/particles.pvd lists, one after the
/// other, so that the memory of two frames is enough. At any time, also after a power cut, the
/// folder has the earlier file or the whole new one (write_file_by() in file.hpp). Throws
/// Error(kBadInput) if a frame is missing or damaged or the file cannot be written, and the error
/// of require_hdf5().
void write_hdf5(const ParticlesCase& c, const std::filesystem::path& folder,
                const results::Provenance& provenance);

}  // namespace viscontact::particles
