// The run that an earlier call of `particles` left in its folder: whether it can be continued, and
// from which state. Lengths, masses and times are in the units of the case. A continued run must
// give the same files as a run that was never interrupted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/particles/run/particles_frames.hpp"
#include "viscontact/particles/run/particles_record.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// An interrupted or finished run: its last state, from which it can continue, and its files.
struct EarlierRun {
  State state;            ///< after its last saved step
  StepRecord record;      ///< of its steps up to this state
  ParticleFrames frames;  ///< keeps a reference to the provenance given to find_earlier_run
};

/// The times at which frames are written, in a run of the case that began at `first_time` [T].
FrameTimes frame_times(const ParticlesCase& c, double first_time);

/// The state at the start: that of the case, or that of the restart file `restart` (empty: none).
/// Throws Error(kBadInput) if the restart file has other particles than the case or contacts with
/// planes that the case does not have, or if it is not earlier than the end of the case.
State first_state(const ParticlesCase& c, const std::string& restart);

/// The run in the folder, if it was made from the same inputs by the same version; otherwise
/// nothing. If the folder has a restart.bin that cannot be used, a message says why.
std::optional<EarlierRun> find_earlier_run(const ParticlesCase& c,
                                           const std::filesystem::path& folder,
                                           const results::Provenance& provenance);

/// True if the run has reached the end time of the case and all its files exist.
bool is_finished(const EarlierRun& run, const ParticlesCase& c,
                 const std::filesystem::path& folder);

}  // namespace viscontact::particles
