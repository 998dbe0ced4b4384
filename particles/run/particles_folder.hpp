// The files in the folder of a run of many particles: their names, which of them a run may replace,
// and removing those of an earlier run.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/particles/run/particles_frames.hpp"

namespace viscontact::particles {

/// The names of all files of each run, except its frames.
inline constexpr auto kParticleResults = std::to_array<const char*>(
    {"particles.pvd", "particles.html", "particles.svg", "final_particles.csv",
     "final_contacts.csv", "steps.csv", "restart.bin", "run.json"});

/// The names of further files of a run with a fluid.
inline constexpr auto kFluidResults =
    std::to_array<const char*>({"motion.csv", "contacts.csv", "flow.pvd"});

/// The names of further files of a run with rigid bodies, links or restitution.
inline constexpr auto kLinkResults = std::to_array<const char*>(
    {"bodies.csv", "hinges.csv", "springs.csv", "arms.csv", "links.pvd", "rebounds.csv"});

/// Throws Error(kBadInput) if a file in the folder has the name of a result or of a frame but
/// Viscontact did not write it.
void check_results(const std::filesystem::path& folder);

/// Throws Error(kBadInput) if a run into `folder` would overwrite one of its inputs: the case, its
/// file of particles, or `restart`, the file of another run (empty: none).
void check_inputs_stay(const ParticlesCase& c, const std::filesystem::path& restart,
                       const std::filesystem::path& folder);

/// Removes all results and frames, so that the folder never contains files of two runs.
void remove_results(const std::filesystem::path& folder);

/// Removes the frames in the folder that are not among `frames`, and their flows.
void remove_other_frames(const std::vector<FrameFile>& frames, const std::filesystem::path& folder);

}  // namespace viscontact::particles
