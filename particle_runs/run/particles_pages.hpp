// The page, the picture and the HDF5 and XYZ files of a run, made from its files.
#pragma once

#include <filesystem>

#include "viscontact/particle_runs/case/particles_case.hpp"
#include "viscontact/particle_runs/run/particle_regime.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::particles {

/// The folder of the run of contact alone that belongs to the run in `folder`
/// (ParticlesCase::compares), and its case.
std::filesystem::path compared_folder(const std::filesystem::path& folder);
ParticlesCase compared_case(const ParticlesCase& c);

/// Writes particles.html and particles.svg from the frames (states at the output times) and flows
/// that a run of the case `c` has written into `folder`; with lubrication also rheology.svg and
/// pair_distribution.csv. If all frames need more than 256 MiB of
/// memory, only every 2nd, 4th, ... frame and the last one are used. `provenance`, the record of
/// inputs and command, is stored in both files. The page shows `regime` in words. A radius that is
/// not between 1e-37 and 3e38 [L] only causes a warning, because nothing can be drawn. Throws
/// Error(kBadInput), which names the file, if a file cannot be read or written or has other
/// particles than the case, or if there is no frame.
void write_pages(const ParticlesCase& c, const std::filesystem::path& folder,
                 const results::Provenance& provenance, const ParticleRegime& regime);

/// Writes particles.html and particles.svg for a run that has ended or was interrupted. The path of
/// the case is read from particles.pvd in `folder`. Throws the errors of write_pages(), and
/// Error(kBadInput) if the case or its file of particles is missing, wrong or has changed since the
/// run, or if Viscontact did not write the page or picture that would be replaced.
void report_particles(const std::filesystem::path& folder);

/// Throws Error(kWrongUsage), which says what to install, if the module hdf5 cannot be loaded.
void require_hdf5();

/// Writes `folder`/particles.h5 (docs/file-formats.md, "HDF5") from the frames that
/// `folder`/particles.pvd lists, in the units of the case, with the memory of two frames. At any
/// time, also after a power cut, the folder has the earlier file or the whole new one
/// (write_file_by() in file.hpp). Throws Error(kBadInput) if a frame is missing or damaged, if
/// there is no frame, or if the file cannot be written, and the error of require_hdf5().
void write_hdf5(const ParticlesCase& c, const std::filesystem::path& folder,
                const results::Provenance& provenance);

/// Writes `folder`/particles.xyz, all frames as extended XYZ (docs/file-formats.md), as
/// write_hdf5() writes its file and with its errors of frames and files.
void write_xyz(const ParticlesCase& c, const std::filesystem::path& folder,
               const results::Provenance& provenance);

}  // namespace viscontact::particles
