// What an earlier call of `particles` has left in its folder, and whether it can be gone on with.
#pragma once

#include <filesystem>
#include <optional>

#include "viscontact/case_file/particles_case.hpp"
#include "viscontact/particles/state.hpp"
#include "viscontact/pipeline/particles/particles_frames.hpp"
#include "viscontact/pipeline/particles/particles_record.hpp"

namespace viscontact {

/// Everything that a run needs to go on as if it had not been interrupted.
struct EarlierRun {
  particles::State state;
  StepRecord record;
  ParticleFrames frames;  ///< refers to the provenance that was given to find_earlier_run
};

/// When the frames of a case are due, in a run that began at `first_time`.
FrameTimes frame_times(const ParticlesCase& c, double first_time);

/// Throws Error(kBadInput) naming `restart` if the state is of other particles or planes than the case.
void check_same_particles(const particles::State& state, const ParticlesCase& c,
                          const std::filesystem::path& restart);

/// The run of the same inputs that is in the folder. If there is none, or if it cannot be gone on
/// with, nothing; the reason is then told to the user, unless the folder has no restart.bin.
std::optional<EarlierRun> find_earlier_run(const ParticlesCase& c,
                                           const std::filesystem::path& folder,
                                           const Provenance& provenance);

/// True if the run has come to its end and every file of it is there.
bool is_finished(const EarlierRun& run, const ParticlesCase& c,
                 const std::filesystem::path& folder);

/// Removes the frames of the folder that are not among those of `run`: what was written between the
/// last restart.bin and the end of the process, and the frame of the interrupt itself.
void remove_later_frames(const EarlierRun& run, const std::filesystem::path& folder);

/// True for a file name of the form particles_NNNNN.vtp.
bool is_named_as_frame(const std::filesystem::path& path);

/// The names of all files of a run but its frames.
inline constexpr const char* kParticleResults[] = {
    "particles.pvd",      "particles.html", "particles.svg", "final_particles.csv",
    "final_contacts.csv", "steps.csv",      "restart.bin",   "run.json"};

}  // namespace viscontact
