// The files in the folder of a run of many particles: their names, which of them a run may replace,
// and removing those of an earlier run. Runs, logs and pages use it. A change must keep the names,
// which users' scripts read.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "viscontact/particles/case/particles_case.hpp"

namespace viscontact::particles {

/// The names of all files that a run may have, except those of its frames, in the order in which
/// they are removed. restart.bin is the first, because a run cannot continue from the others
/// without it.
inline constexpr auto kParticleResults = std::to_array<const char*>(
    {"restart.bin", "particles.pvd", "particles.html",      "particles.svg",
     "run.json",    "steps.csv",     "final_particles.csv", "final_contacts.csv",
     "motion.csv",  "contacts.csv",  "walls.csv",           "stress.csv",
     "flow.pvd",    "bodies.csv",    "hinges.csv",          "springs.csv",
     "arms.csv",    "membranes.csv", "links.pvd",           "rebounds.csv",
     "probes.csv",  "particles.h5"});

/// A kind of file with one file for each frame: what stands in its names before and after the
/// number.
struct FrameKind {
  const char* begin;  ///< also the name of the list of these files, without ".pvd"
  const char* end;    ///< with the dot
};
inline constexpr FrameKind kFrameFile{"particles", ".vtp"}, kFlowFile{"flow", ".vtu"},
    kLinksFile{"links", ".vtp"};

/// The name of the file of frame `number`, from 0: particles_NNNNN.vtp.
std::string frame_name(const FrameKind& kind, std::uint64_t number);

/// Throws Error(kBadInput) if a file in the folder has the name of a result or of a frame but
/// Viscontact did not write it.
void check_results(const std::filesystem::path& folder);

/// Throws Error(kBadInput) if a run into `folder` would overwrite one of its inputs: the case, its
/// file of particles, or `restart`, the file of another run (empty: none).
void check_inputs_stay(const ParticlesCase& c, const std::filesystem::path& restart,
                       const std::filesystem::path& folder);

/// Removes all results and frames, so that the folder never contains files of two runs.
void remove_results(const std::filesystem::path& folder);

/// Removes the files of all frames but the first `frames`, all flows but the first `flows`, and
/// files that a killed process has not finished.
void remove_later_frames(const std::filesystem::path& folder, std::uint64_t frames,
                         std::uint64_t flows);

}  // namespace viscontact::particles
